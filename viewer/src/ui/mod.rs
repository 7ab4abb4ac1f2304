//! All of the window: panels around the picture. Panels read the [`State`] and say what is to be done; nothing but [`Viewer::show`] does
//! it.

mod compare;
mod judged;
mod keys;
mod properties;
mod scene;
mod toasts;
mod value;
mod viewport;

use std::path::{Path, PathBuf};
use std::time::Duration;

use cutaway::Result;
use cutaway::compare::Comparison;
use cutaway::experiment::Renderer;
use eframe::egui::{
    self, Button, CentralPanel, Context, Frame, Panel, TextEdit, ThemePreference, Ui, Window,
};
use egui_wgpu::RenderState;

use crate::action::Action;
use crate::camera::{CameraMove, STANDARD_VIEWS};
use crate::notice::Notice;
use crate::pace::{Pace, REST};
use crate::screen::Screen;
use crate::slot::{Layout, Side};
use crate::state::State;
use judged::Judged;
use keys::Does;
use toasts::Toasts;
use viewport::Held;

/// What was last drawn.
#[derive(Clone, Copy, PartialEq)]
struct Last {
    revision: u64,
    is_settled: bool,
    size_px: [u32; 2],
    renderers: [Option<Renderer>; 2],
    divisor: u32,
}

/// The window.
pub struct Viewer {
    state: State,
    screen: Screen,
    judged: Judged,
    toasts: Toasts,
    pace: Pace,
    last: Option<Last>,
    /// Which revision was last seen, and since when, on egui's clock in seconds.
    changed: (u64, f64),
    /// The revision that is prepared as a picture would be.
    settled: Option<u64>,
    held: Held,
    flickers: bool,
    shows_keys: bool,
    /// What is typed as the name of a file, where one is asked for.
    asks: Option<Asks>,
    size_px: [u32; 2],
}

/// A file that is asked for.
struct Asks {
    what: &'static str,
    typed: String,
    is_save: bool,
}

impl Viewer {
    /// Shows a state, on the device that egui draws with.
    ///
    /// # Errors
    ///
    /// A device with less than core WebGPU.
    pub fn on(host: &RenderState, state: State) -> Result<Self> {
        Ok(Self {
            state,
            screen: Screen::on(host)?,
            judged: Judged::default(),
            toasts: Toasts::default(),
            pace: Pace::default(),
            last: None,
            changed: (0, 0.0),
            settled: None,
            held: Held::default(),
            flickers: false,
            shows_keys: false,
            asks: None,
            size_px: [16, 16],
        })
    }

    /// What the window shows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The pictures.
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// The size of the picture of a slot, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// The errors of a slot against the reference, and by how much coarser than the picture they were taken, once they are known.
    pub fn errors(&self, side: Side) -> Option<(&Comparison, u32)> {
        self.judged.counts(side)
    }

    /// Whether something is still to come: a frame, or an answer of the judge.
    pub fn is_busy(&self) -> bool {
        let last = self.last.map(|l| (l.revision, l.is_settled, l.divisor));
        let whole = Some((self.state.revision(), true, 1));
        let is_drawn = self.state.shown().is_none() || last == whole;
        !is_drawn || self.screen.is_busy() || self.judged.is_busy()
    }

    /// Carries out an action, as a button would have it done.
    pub fn apply(&mut self, action: Action) {
        self.state.apply(action);
    }

    /// All of the window.
    pub fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        self.take_drops(&ctx, &mut actions);
        self.keys(&ctx, &mut actions);
        Panel::top("menu").show(ui, |ui| self.menu(ui, &mut actions));
        // Of one height, whatever it says: the picture does not change its size with the counts.
        Panel::bottom("compare").exact_size(64.0).show(ui, |ui| {
            compare::show(ui, &self.state, (&self.screen, &self.judged), &mut actions);
        });
        Panel::left("scene").default_size(220.0).show(ui, |ui| {
            scene::show(ui, &self.state, &mut actions);
        });
        Panel::right("properties")
            // As wide as what it can hold: the picture does not change its size with the selection.
            .size_range(300.0..=600.0)
            .show(ui, |ui| {
                properties::show(ui, &self.state, &mut actions);
            });
        // What panels hold is let go with the pointer.
        if ctx.input(|input| input.pointer.any_released()) {
            actions.push(Action::Release);
        }
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            self.size_px = viewport::size_px(rect, self.state.layout(), ctx.pixels_per_point());
            self.judged.take_in(&ctx, &self.state, &mut self.screen);
            self.draw(&ctx);
            let pictures = (&self.screen, &self.judged);
            let pointer = (&mut self.held, self.flickers);
            viewport::show(ui, rect, &self.state, pictures, pointer, &mut actions);
        });
        if !actions.is_empty() {
            ctx.request_repaint();
        }
        for action in actions {
            self.state.apply(action);
        }
        let notices = self.state.notices();
        notices
            .into_iter()
            .for_each(|notice| self.toasts.add(&ctx, notice));
        self.dialogs(&ctx);
        self.toasts.show(&ctx);
        if self.changed.0 != self.state.revision() {
            ctx.request_repaint();
        }
    }

    /// Draws what has changed, as finely as there is time for.
    fn draw(&mut self, ctx: &Context) {
        match self.try_draw(ctx) {
            Ok(()) => {}
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    fn try_draw(&mut self, ctx: &Context) -> Result<()> {
        let (done, must_redraw) = self.screen.settle()?;
        if let Some((divisor, took_ms)) = done {
            self.pace.learn(divisor, took_ms);
        }
        if must_redraw {
            self.last = None;
        }
        let revision = self.state.revision();
        let now = ctx.input(|input| input.time);
        if self.changed.0 != revision {
            self.changed = (revision, now);
        }
        let rested = now - self.changed.1;
        let is_moving = self.last.is_some() && rested < REST.as_secs_f64();
        if !is_moving && self.settled != Some(revision) {
            self.state.settle();
            self.settled = Some(revision);
        }
        let Some(shown) = self.state.shown() else {
            return Ok(());
        };
        let is_settled = self.settled == Some(revision);
        let divisor = self.pace.divisor(is_moving);
        let view = shown.view(self.size_px);
        let mut renderers = [None; 2];
        for side in self.state.layout().sides() {
            let painter = self.state.painter(*side);
            let settled = painter.settle(self.screen.gpu(), &shown.at.model, &view);
            renderers[side.index()] = Some(settled);
        }
        let about = (self.size_px, renderers, is_settled);
        self.judged.ask(ctx, &self.state, &self.screen, about);
        let next = Last {
            revision,
            is_settled,
            size_px: self.size_px,
            renderers,
            divisor,
        };
        // A picture as fine or finer of the same is good enough.
        let is_drawn = self.last.is_some_and(|last| {
            last == Last {
                divisor: last.divisor,
                ..next
            } && last.divisor <= divisor
        });
        if !is_drawn && !self.screen.is_busy() {
            let wants_difference = self.state.layout() == Layout::Difference;
            let drawn = self
                .screen
                .draw(shown, renderers, self.size_px, divisor, wants_difference);
            self.last = Some(next);
            drawn?;
        }
        if self.screen.is_busy() || !is_drawn {
            ctx.request_repaint_after(Duration::from_millis(5));
        } else if !is_settled {
            ctx.request_repaint_after(REST);
        }
        Ok(())
    }

    fn take_drops(&self, ctx: &Context, actions: &mut Vec<Action>) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        let paths: Vec<PathBuf> = dropped
            .into_iter()
            .map(|file| file.path().to_owned())
            .collect();
        if !paths.is_empty() {
            actions.push(Action::Take(paths));
        }
    }

    fn keys(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let typing = ctx.egui_wants_keyboard_input();
        self.flickers = !typing && ctx.input(|input| input.key_down(keys::FLICKER));
        for does in keys::pressed(ctx) {
            match does {
                Does::Act(action) => actions.push(action),
                Does::Help => self.shows_keys = !self.shows_keys,
                Does::CopyCommand => self.copy_command(ctx),
                Does::Save => self.ask_for_save(),
                Does::Projection => actions.push(self.other_projection()),
                Does::Flicker => {}
            }
        }
    }

    fn other_projection(&self) -> Action {
        let shown = self.state.shown();
        let is_parallel = shown.is_some_and(|shown| shown.view([64, 64]).orthographic);
        Action::MoveCamera(CameraMove::Parallel(!is_parallel))
    }

    fn menu(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let [can_undo, can_redo] = self.state.can_undo_redo();
        ui.horizontal_wrapped(|ui| {
            ui.menu_button("File", |ui| {
                if ui.button("Open ...").clicked() {
                    self.asks = Some(Asks {
                        what: "Open a mesh, a scene or an image",
                        typed: String::new(),
                        is_save: false,
                    });
                }
                if ui.button("Save scene ...").clicked() {
                    self.ask_for_save();
                }
                if ui.button("Reload files").clicked() {
                    actions.push(Action::Reload);
                }
                if ui.button("Copy command").clicked() {
                    self.copy_command(&ui.ctx().clone());
                }
            });
            if ui.add_enabled(can_undo, Button::new("Undo")).clicked() {
                actions.push(Action::Undo);
            }
            if ui.add_enabled(can_redo, Button::new("Redo")).clicked() {
                actions.push(Action::Redo);
            }
            ui.menu_button("View", |ui| {
                for (name, to) in STANDARD_VIEWS {
                    if ui.button(name).clicked() {
                        actions.push(Action::MoveCamera(CameraMove::Stand(to)));
                    }
                }
                if ui.button("Show all").clicked() {
                    actions.push(Action::MoveCamera(CameraMove::Home));
                }
                if ui.button("Perspective or parallel").clicked() {
                    actions.push(self.other_projection());
                }
            });
            ui.menu_button("Theme", |ui| {
                // egui's own buttons have pictures that its fonts here lack.
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
            let mark = if self.state.is_changed() {
                " (changed)"
            } else {
                ""
            };
            ui.weak(format!("{name}{mark}"));
        });
    }

    fn ask_for_save(&mut self) {
        let path = self.state.document().path();
        let typed = match path.as_os_str().is_empty() {
            true => "scene.toml".to_owned(),
            false => path.display().to_string(),
        };
        self.asks = Some(Asks {
            what: "Save the scene",
            typed,
            is_save: true,
        });
    }

    fn copy_command(&mut self, ctx: &Context) {
        match self.state.command(self.size_px) {
            Ok(command) => {
                ctx.copy_text(command);
                self.toasts
                    .add(ctx, Notice::done("the command is in the clipboard"));
            }
            Err(error) => self.toasts.add(ctx, error.into()),
        }
    }

    /// Windows over the picture: the keys, and the name of a file.
    fn dialogs(&mut self, ctx: &Context) {
        let mut is_open = self.shows_keys;
        Window::new("Keys").open(&mut is_open).show(ctx, |ui| {
            egui::Grid::new("keys").num_columns(2).show(ui, |ui| {
                for binding in keys::bindings() {
                    ui.strong(ctx.format_shortcut(&binding.key));
                    ui.label(binding.help);
                    ui.end_row();
                }
            });
        });
        self.shows_keys = is_open;
        let Some(asks) = &mut self.asks else {
            return;
        };
        let mut answer = None;
        Window::new(asks.what).collapsible(false).show(ctx, |ui| {
            let field = ui.add(TextEdit::singleline(&mut asks.typed).desired_width(360.0));
            let field = field.accessible_name("File name");
            let has_entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
            ui.horizontal(|ui| {
                let word = if asks.is_save { "Save" } else { "Open" };
                if ui.button(word).clicked() || has_entered {
                    answer = Some(true);
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(false);
                }
            });
        });
        let Some(is_meant) = answer else {
            return;
        };
        if let Some(Asks { typed, is_save, .. }) = self.asks.take().filter(|_| is_meant) {
            let path = Path::new(typed.trim()).to_owned();
            self.state.apply(match is_save {
                true => Action::Save(path),
                false => Action::Take(vec![path]),
            });
        }
    }
}
