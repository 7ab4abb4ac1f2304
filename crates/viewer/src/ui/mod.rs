//! The whole window: panels around the picture. Panels read the [`State`] and return actions; only [`Viewer::show`] carries the actions
//! out.

#[cfg(not(target_arch = "wasm32"))]
mod desktop;
mod dialogs;
mod errands;
mod frames;
mod handles;
mod judged;
mod latest;
mod magnifier;
#[cfg(target_arch = "wasm32")]
mod page;
mod panels;
mod pointing;
mod viewport;

use cutaway::Result;
use cutaway::strategies::Method;
use cutaway_lab::compare::Comparison;
use cutaway_lab::experiment::Stopwatch;
use eframe::egui::{CentralPanel, Context, Frame, Panel, Ui};
use egui_wgpu::RenderState;

use crate::action::Action;
use crate::inspect::Inspector;
use crate::judge::JudgeFinding;
use crate::judge::cost::Cost;
use crate::judge::magnify::Magnified;
use crate::judge::survey::Found;
use crate::picture::pace::Pace;
use crate::picture::pick::Picked;
use crate::picture::screen::Screen;
use crate::picture::slot::SlotSide;
use crate::profile::{FrameCost, Profile};
use crate::state::State;
use crate::storage::opening::Opening;
#[cfg(not(target_arch = "wasm32"))]
use crate::storage::recent::Recent;
use crate::storage::watch::Watch;
use cutaway::error::Diagnostic;
#[cfg(not(target_arch = "wasm32"))]
use desktop::Outside;
use dialogs::naming::Asks;
use dialogs::toasts::Toasts;
use frames::LastFrame;
use judged::JudgeState;
use magnifier::Magnifier;
#[cfg(target_arch = "wasm32")]
use page::Outside;
use panels::cost::Costs;
use panels::defects::Badges;
use panels::survey::ChartWindow;
use panels::time::Strip;
use pointing::Pointing;
use viewport::Held;

/// The window.
pub struct Viewer {
    state: State,
    opening: Opening,
    screen: Screen,
    judged: JudgeState,
    toasts: Toasts,
    pace: Pace,
    last: Option<LastFrame>,
    /// The revision last seen, and when it was first seen, on egui's clock in seconds.
    changed: (u64, f64),
    /// The revision for which the scene was prepared as for an exported picture.
    preclassified: Option<u64>,
    held: Held,
    flickers: bool,
    plays: bool,
    strip: Strip,
    pointing: Pointing,
    magnifier: Magnifier,
    chart: ChartWindow,
    costs: Costs,
    /// Watches the scene's files, with the time of the last check.
    watch: (Watch, f64),
    outside: Outside,
    shows_keys: bool,
    asks: Option<Asks>,
    inspector: Inspector,
    badges: Badges,
    #[cfg(not(target_arch = "wasm32"))]
    closing: dialogs::closing::CloseProgress,
    /// Action to carry out once the changes are saved or discarded; `None` to close the window.
    #[cfg(not(target_arch = "wasm32"))]
    leaves_for: Option<Action>,
    #[cfg(not(target_arch = "wasm32"))]
    recent: Option<Recent>,
    size_px: [u32; 2],
    /// True if edges are antialiased while nothing moves.
    is_smooth: bool,
    /// Costs of earlier frames, if profiling is on, and the cost of the present frame.
    profile: Option<Profile>,
    cost: FrameCost,
}

impl Viewer {
    /// Creates a window for a state, on egui's device.
    ///
    /// # Errors
    ///
    /// The device does not support core WebGPU.
    pub fn on(host: &RenderState, state: State) -> Result<Self> {
        Ok(Self::with(Screen::on(host)?, state))
    }

    /// Creates a window for a state, with an existing screen.
    pub fn with(screen: Screen, state: State) -> Self {
        Self {
            state,
            opening: Opening::default(),
            screen,
            judged: JudgeState::default(),
            toasts: Toasts::default(),
            pace: Pace::default(),
            last: None,
            changed: (0, 0.0),
            preclassified: None,
            held: Held::default(),
            flickers: false,
            plays: false,
            strip: Strip::default(),
            pointing: Pointing::default(),
            magnifier: Magnifier::default(),
            chart: ChartWindow::default(),
            costs: Costs::default(),
            watch: (Watch::default(), 0.0),
            outside: Outside::default(),
            shows_keys: false,
            asks: None,
            inspector: Inspector::default(),
            badges: Badges::default(),
            #[cfg(not(target_arch = "wasm32"))]
            closing: dialogs::closing::CloseProgress::default(),
            #[cfg(not(target_arch = "wasm32"))]
            leaves_for: None,
            #[cfg(not(target_arch = "wasm32"))]
            recent: None,
            size_px: [16, 16],
            is_smooth: true,
            profile: None,
            cost: FrameCost::default(),
        }
    }

    /// Continues on another device after a device loss. Keeps the scene, its history, and the work in the
    /// background. Everything drawn on the lost device is redrawn.
    #[must_use]
    pub fn reopened_on(self, screen: Screen) -> Self {
        let mut reopened = Self {
            opening: self.opening,
            outside: self.outside,
            #[cfg(not(target_arch = "wasm32"))]
            recent: self.recent,
            is_smooth: self.is_smooth,
            profile: self.profile,
            ..Self::with(screen, self.state)
        };
        reopened.state.tell(Diagnostic::warning(
            "device-lost",
            "The graphics device was lost and has been reopened; the scene is intact.",
        ));
        reopened
    }

    /// The state that the window shows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The pictures of the slots.
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// Width and height of a slot's picture, in pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// The errors of a slot against the reference, and the resolution divisor at which they were computed; `None` until they are known.
    pub fn errors(&self, side: SlotSide) -> Option<(&Comparison, u32)> {
        self.judged.counts(side)
    }

    /// What is visible at the pixel under the pointer; `None` until it is known.
    pub fn picked(&self) -> Option<&Picked> {
        self.pointing.under_pointer()
    }

    /// The magnified pixel; `None` until it is known.
    pub fn magnified(&self) -> Option<&Magnified> {
        self.magnifier.magnified()
    }

    /// Survey results for the methods measured so far.
    pub fn surveyed(&self) -> &[(Method, Found)] {
        self.chart.entries()
    }

    /// Cost of a slot's frame; `None` while costs are not shown or not yet known.
    pub fn cost(&self, side: SlotSide) -> Option<&Cost> {
        self.costs.cost(side)
    }

    /// Returns true while something is pending: a frame, an answer from the judge, a requested pixel, a file being opened or
    /// exported, a mesh being inspected.
    pub fn is_busy(&self) -> bool {
        let is_judging = self.judged.is_busy()
            || self.magnifier.is_busy()
            || self.chart.is_busy()
            || self.costs.is_busy();
        let is_outside = self.outside.is_busy() || self.opening.is_busy();
        let is_asked = is_judging || self.screen.is_picking() || self.inspector.is_busy();
        self.is_drawing() || self.is_refining() || is_asked || is_outside
    }

    /// Carries out an action, as if a button had been pressed.
    pub fn apply(&mut self, action: Action) {
        match Opening::is_for(&action) {
            true => self.opening.ask(action),
            false => self.state.apply(action),
        }
    }

    /// Turns the smoothing of edges at rest on or off.
    pub fn smooth(&mut self, is_smooth: bool) {
        self.is_smooth = is_smooth;
    }

    /// Begins to record the costs of frames.
    pub fn begin_profile(&mut self) {
        self.profile = Some(Profile::default());
    }

    /// The frame costs recorded so far; `None` if profiling is off.
    pub fn profile(&self) -> Option<&Profile> {
        self.profile.as_ref()
    }

    /// Shows the whole window, and carries out the user's actions.
    pub fn show(&mut self, ui: &mut Ui) {
        let watch = Stopwatch::start();
        self.cost = FrameCost::default();
        self.show_all(ui);
        self.cost.whole_ms = watch.ms();
        if let Some(profile) = &mut self.profile {
            profile.add(self.cost);
        }
    }

    fn show_all(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let mut actions = Vec::new();
        self.run_errands(&ctx, &mut actions);
        self.inspect(&ctx);
        self.keys(&ctx, &mut actions);
        Panel::top("menu").show(ui, |ui| self.menu(ui, &mut actions));
        // Fixed height, so that the picture's size does not depend on the counts.
        Panel::bottom("compare").exact_size(84.0).show(ui, |ui| {
            let windows = (&mut self.chart.is_asked, &mut self.costs.is_open);
            let pictures = (&self.screen, &self.judged);
            panels::compare::show(ui, &self.state, pictures, windows, &mut actions);
            ui.label(self.pointing.sentence());
        });
        if self.state.shown().is_some_and(|s| s.timeline.moves()) {
            // Fixed size, so that the picture's size does not depend on the keys.
            let height = panels::time::height(&self.state);
            Panel::bottom("time").exact_size(height).show(ui, |ui| {
                let strip = (&mut self.plays, &mut self.strip);
                panels::time::show(ui, &self.state, strip, &mut actions);
            });
        }
        Panel::left("scene").default_size(220.0).show(ui, |ui| {
            panels::scene::show(ui, &self.state, &self.badges, &mut actions);
        });
        Panel::right("properties")
            // As wide as its widest content, so that the picture's size does not depend on the selection.
            .size_range(300.0..=600.0)
            .show(ui, |ui| {
                panels::properties::show(ui, &self.state, &mut actions);
            });
        // Releasing the pointer ends any gesture in a panel.
        if ctx.input(|input| input.pointer.any_released()) {
            actions.push(Action::Release);
        }
        CentralPanel::default()
            .frame(Frame::NONE.fill(ui.visuals().panel_fill))
            .show(ui, |ui| {
                let rect = ui.available_rect_before_wrap();
                self.size_px = viewport::size_px(rect, self.state.layout(), ctx.pixels_per_point());
                self.judged.take_in(&ctx, &self.state, &mut self.screen);
                self.take_findings(&ctx);
                self.draw(&ctx);
                let pictures = (&self.screen, &self.judged, &self.inspector);
                let pointer = (&mut self.held, self.flickers);
                let at = viewport::show(ui, rect, &self.state, pictures, pointer, &mut actions);
                self.point(&ctx, at);
            });
        self.ask_the_judge(&ctx);
        self.magnifier(&ctx);
        self.chart(&ctx, &mut actions);
        self.costs(&ctx);
        if !actions.is_empty() {
            ctx.request_repaint();
        }
        let watch = Stopwatch::start();
        for action in actions {
            #[cfg(not(target_arch = "wasm32"))]
            self.apply_or_ask(action);
            #[cfg(target_arch = "wasm32")]
            self.apply(action);
        }
        self.cost.scene_ms += watch.ms();
        self.dialogs(&ctx);
        self.open_files(&ctx);
        let notices = self.state.notices();
        notices
            .into_iter()
            .for_each(|notice| self.toasts.add(&ctx, notice));
        #[cfg(not(target_arch = "wasm32"))]
        self.remember(&ctx);
        #[cfg(not(target_arch = "wasm32"))]
        self.guard_changes(&ctx);
        self.toasts.show(&ctx);
        if self.changed.0 != self.state.revision() {
            ctx.request_repaint();
        }
    }

    /// Sends the questions of the magnifier, cost and survey windows to the judge.
    fn ask_the_judge(&mut self, ctx: &Context) {
        self.magnify(ctx);
        self.survey(ctx);
        self.ask_costs(ctx);
    }

    /// Hands the judge's findings other than errors to their windows.
    fn take_findings(&mut self, ctx: &Context) {
        for finding in self.judged.findings() {
            match finding {
                JudgeFinding::Magnified(id, magnified) => {
                    self.magnifier.take_in(ctx, id, magnified)
                }
                JudgeFinding::Surveyed(id, surveyed) => self.chart.take_in(id, surveyed),
                JudgeFinding::Cost(id, side, cost) => self.costs.take_in(id, side, cost),
            }
        }
    }
}
