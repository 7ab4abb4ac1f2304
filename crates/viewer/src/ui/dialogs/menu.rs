//! The menus, the handling of keys, and the table of keys.

use cutaway::scene::STANDARD_VIEWS;
use eframe::egui::{Button, Context, Grid, ThemePreference, Ui, Window};

use super::keys::{self, Does};
use crate::action::Action;
use crate::picture::camera::CameraMove;
use crate::ui::Viewer;
use cutaway::error::Diagnostic;

impl Viewer {
    pub(in crate::ui) fn keys(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let typing = ctx.egui_wants_keyboard_input();
        self.flickers = !typing && ctx.input(|input| input.key_down(keys::FLICKER));
        for does in keys::pressed(ctx) {
            match does {
                Does::Act(action) => actions.push(action),
                Does::Help => self.shows_keys = !self.shows_keys,
                Does::CopyCommand => self.copy_command(ctx),
                Does::Save => self.ask_for_save(),
                Does::Projection => actions.push(self.other_projection()),
                Does::CutHere => self.cut_here(actions),
                Does::Play => self.plays = !self.plays,
                Does::Flicker => {}
            }
        }
    }

    fn other_projection(&self) -> Action {
        let shown = self.state.shown();
        let is_parallel = shown.is_some_and(|shown| shown.view([64, 64]).orthographic);
        Action::MoveCamera(CameraMove::Parallel(!is_parallel))
    }

    pub(in crate::ui) fn menu(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let [can_undo, can_redo] = self.state.can_undo_redo();
        ui.horizontal_wrapped(|ui| {
            ui.menu_button("File", |ui| self.file_menu(ui, actions));
            if ui.add_enabled(can_undo, Button::new("Undo")).clicked() {
                actions.push(Action::Undo);
            }
            if ui.add_enabled(can_redo, Button::new("Redo")).clicked() {
                actions.push(Action::Redo);
            }
            ui.menu_button("View", |ui| {
                for (name, to) in STANDARD_VIEWS {
                    let (first, others) = name.split_at(1);
                    if ui.button(first.to_uppercase() + others).clicked() {
                        actions.push(Action::MoveCamera(CameraMove::Stand(to)));
                    }
                }
                if ui.button("Show all").clicked() {
                    actions.push(Action::MoveCamera(CameraMove::Home));
                }
                ui.checkbox(&mut self.is_smooth, "Smooth edges at rest");
                if ui.button("Perspective or parallel").clicked() {
                    actions.push(self.other_projection());
                }
            });
            ui.menu_button("Theme", |ui| {
                // egui's own theme buttons use symbols that the fonts here lack.
                let mut theme = ui.options(|options| options.theme_preference);
                for (name, choice) in [
                    ("As the system", ThemePreference::System),
                    ("Light", ThemePreference::Light),
                    ("Dark", ThemePreference::Dark),
                ] {
                    ui.selectable_value(&mut theme, choice, name);
                }
                ui.ctx().set_theme(theme);
            });
            if ui.button("?").on_hover_text("Keys").clicked() {
                self.shows_keys = !self.shows_keys;
            }
            let name = match self.state.document().name() {
                name if name.is_empty() => "no scene".to_owned(),
                name => name,
            };
            let is_changed = self.state.is_changed();
            let mark = if is_changed { " (changed)" } else { "" };
            ui.weak(format!("{name}{mark}"));
            self.opening(ui);
            self.exporting(ui);
        });
    }

    fn file_menu(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        if ui.button("Open ...").clicked() {
            self.ask_for_files(&ui.ctx().clone());
        }
        #[cfg(not(target_arch = "wasm32"))]
        self.recent_menu(ui, actions);
        if ui.button("Save scene ...").clicked() {
            self.ask_for_save();
        }
        if ui.button("Export ...").clicked() {
            self.ask_for_export();
        }
        if ui.button("Reload files").clicked() {
            actions.push(Action::Reload);
        }
        if ui.button("Copy command").clicked() {
            self.copy_command(&ui.ctx().clone());
        }
        #[cfg(target_arch = "wasm32")]
        if ui.button("Copy link").clicked() {
            self.copy_link(&ui.ctx().clone());
        }
    }

    fn copy_command(&mut self, ctx: &Context) {
        match self.state.command(self.size_px) {
            Ok(command) => {
                ctx.copy_text(command);
                self.toasts.add(
                    ctx,
                    Diagnostic::note("copied", "the command is in the clipboard"),
                );
            }
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    pub(in crate::ui) fn dialogs(&mut self, ctx: &Context) {
        let mut is_open = self.shows_keys;
        Window::new("Keys").open(&mut is_open).show(ctx, |ui| {
            Grid::new("keys").num_columns(2).show(ui, |ui| {
                for binding in keys::bindings() {
                    ui.strong(ctx.format_shortcut(&binding.key));
                    ui.label(binding.help);
                    ui.end_row();
                }
            });
        });
        self.shows_keys = is_open;
        self.file_dialog(ctx);
    }
}
