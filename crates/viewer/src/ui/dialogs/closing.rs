//! Unsaved changes: a dialog asks before the window closes or another scene is opened. This module also maintains the list of recent files.

use std::path::PathBuf;

use cutaway::{Error, Result};
use eframe::egui::{Align2, Context, Ui, Vec2, ViewportCommand, Window};

use crate::action::Action;
use crate::storage::files::{self, FileKind};
use crate::storage::recent::Recent;
use crate::ui::Viewer;

/// Progress of closing the window, or of opening another scene in place of the present one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::ui) enum CloseProgress {
    /// Neither is in progress.
    #[default]
    Stays,
    /// The dialog asks about the unsaved changes.
    Asks,
    /// The window closes once the scene is saved under the requested name.
    Saves,
    /// Unsaved changes may be discarded.
    Agreed,
}

impl Viewer {
    /// Sets the file for the list of recent files.
    pub fn remember_in(&mut self, recent: Recent) {
        self.recent = Some(recent);
    }

    /// Carries out an action. If the action would replace a scene with unsaved changes, a dialog asks first.
    pub(in crate::ui) fn apply_or_ask(&mut self, action: Action) {
        let is_scene = |path: &PathBuf| files::kind(path).is_ok_and(|kind| kind == FileKind::Scene);
        let leaves = matches!(&action, Action::Take(paths) if paths.iter().any(is_scene));
        if leaves && self.state.has_unsaved_changes() {
            (self.closing, self.leaves_for) = (CloseProgress::Asks, Some(action));
        } else {
            self.apply(action);
        }
    }

    /// Shows the dialog about unsaved changes.
    pub(in crate::ui) fn guard_changes(&mut self, ctx: &Context) {
        let is_closed = ctx.input(|input| input.viewport().close_requested());
        let must_ask = is_closed && self.closing != CloseProgress::Agreed;
        if must_ask && self.state.has_unsaved_changes() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            (self.closing, self.leaves_for) = (CloseProgress::Asks, None);
        }
        match self.closing {
            CloseProgress::Asks => self.ask_before_closing(ctx),
            CloseProgress::Saves if !self.state.has_unsaved_changes() => self.close(ctx),
            // The naming dialog was cancelled.
            CloseProgress::Saves if self.asks.is_none() => self.closing = CloseProgress::Stays,
            _ => {}
        }
    }

    fn ask_before_closing(&mut self, ctx: &Context) {
        let window = Window::new("Unsaved changes").collapsible(false);
        let window = window
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, Vec2::ZERO);
        window.show(ctx, |ui| {
            ui.label("The scene was changed and is not saved.");
            ui.horizontal(|ui| {
                if ui.button("Save").clicked() {
                    self.save_and_close(ctx);
                }
                if ui.button("Discard").clicked() {
                    self.close(ctx);
                }
                if ui.button("Cancel").clicked() {
                    self.closing = CloseProgress::Stays;
                }
            });
        });
    }

    fn save_and_close(&mut self, ctx: &Context) {
        let path = self.state.document().path().to_owned();
        if path.as_os_str().is_empty() {
            self.closing = CloseProgress::Saves;
            self.ask_for_save();
            return;
        }
        self.state.apply(Action::Save(path));
        match self.state.has_unsaved_changes() {
            // Saving was refused, and a notice already gives the reason.
            true => self.closing = CloseProgress::Stays,
            false => self.close(ctx),
        }
    }

    fn close(&mut self, ctx: &Context) {
        if let Some(action) = self.leaves_for.take() {
            self.closing = CloseProgress::Stays;
            self.apply(action);
            return;
        }
        self.closing = CloseProgress::Agreed;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    /// Adds opened and saved files to the list.
    pub(in crate::ui) fn remember(&mut self, ctx: &Context) {
        let Some(recent) = &mut self.recent else {
            return;
        };
        let opened = self.state.take_opened();
        let added: Result<()> = opened.iter().try_for_each(|path| recent.add(path));
        if let Err(error) = added {
            self.toasts.add(ctx, error.into());
        }
    }

    /// Menu of recent files.
    pub(in crate::ui) fn recent_menu(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let paths: Vec<PathBuf> = match &self.recent {
            Some(recent) => recent.paths().to_vec(),
            None => return,
        };
        ui.menu_button("Recent", |ui| {
            if paths.is_empty() {
                ui.weak("no file yet");
            }
            for path in paths {
                if ui.button(path.display().to_string()).clicked() {
                    match path.exists() {
                        true => actions.push(Action::Take(vec![path])),
                        false => self.forget(&ui.ctx().clone(), &path),
                    }
                }
            }
        });
    }

    fn forget(&mut self, ctx: &Context, path: &std::path::Path) {
        let help = "it was removed from the list of recent files";
        let error = Error::file(path, "it is not there any more", help);
        self.toasts.add(ctx, error.into());
        if let Some(Err(error)) = self.recent.as_mut().map(|recent| recent.forget(path)) {
            self.toasts.add(ctx, error.into());
        }
    }
}
