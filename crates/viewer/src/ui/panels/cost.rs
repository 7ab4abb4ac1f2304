//! The cost of a frame for each visible slot: its passes as bars and as a table, and the bytes of each clock.
//!
//! While the cost window is open, one question is sent for each picture once nothing moves; while it is closed, none.

use cutaway::plan::Clock;
use cutaway_lab::experiment::Renderer;
use eframe::egui::{
    Color32, Context, CornerRadius, Grid, Rect, ScrollArea, Sense, Ui, Vec2, Window, vec2,
};

use crate::judge::Subject;
use crate::judge::cost::{Cost, CostQuestion, PassCost};
use crate::picture::slot::SlotSide;
use crate::ui::Viewer;
use crate::ui::latest::Latest;

/// Height of a stacked bar, in points.
const BAR_POINTS: f32 = 18.0;

/// Width of the longest pass's bar, in points.
const LONGEST_POINTS: f32 = 120.0;

/// What a question is about; an equal one is not sent again.
#[derive(Clone, Copy, PartialEq)]
struct CostSubject {
    revision: u64,
    size_px: [u32; 2],
    renderers: [Option<Renderer>; 2],
}

/// The window of costs.
#[derive(Default)]
pub(in crate::ui) struct Costs {
    pub(in crate::ui) is_open: bool,
    latest: Latest<CostSubject>,
    /// For each slot, the answer with the id of its question.
    answers: [Option<(u64, Result<Cost, String>)>; 2],
}

impl Costs {
    /// Cost of a slot's frame; `None` until it is known.
    pub(in crate::ui) fn cost(&self, side: SlotSide) -> Option<&Cost> {
        self.answer(side)?.as_ref().ok()
    }

    fn answer(&self, side: SlotSide) -> Option<&Result<Cost, String>> {
        let (id, answer) = self.answers[side.index()].as_ref()?;
        (*id == self.latest.id()).then_some(answer)
    }

    /// Returns true while an answer is pending.
    pub(in crate::ui) fn is_busy(&self) -> bool {
        let Some(about) = self.latest.about() else {
            return false;
        };
        let is_seen = |side: &SlotSide| about.renderers[side.index()].is_some();
        let mut seen = SlotSide::BOTH.into_iter().filter(is_seen);
        seen.any(|side| self.answer(side).is_none())
    }

    /// Receives an answer.
    pub(in crate::ui) fn take_in(&mut self, id: u64, side: SlotSide, cost: Result<Cost, String>) {
        self.answers[side.index()] = Some((id, cost));
    }
}

impl Viewer {
    /// While costs are shown, asks for those of the visible picture.
    pub(in crate::ui) fn ask_costs(&mut self, ctx: &Context) {
        if !self.costs.is_open {
            self.costs.latest.forget();
            return;
        }
        let subject = Subject::of(&self.state, self.size_px);
        let (Some(subject), Some(last)) = (subject, self.last) else {
            return;
        };
        if self.is_drawing() {
            return;
        }
        let about = CostSubject {
            revision: self.state.revision(),
            size_px: self.size_px,
            renderers: last.renderers,
        };
        let Some(id) = self.costs.latest.ask(about) else {
            return;
        };
        let question = CostQuestion {
            id,
            subject,
            renderers: last.renderers,
        };
        self.judged.judge(ctx, &self.screen).cost(question);
    }

    /// The window of costs.
    pub(in crate::ui) fn costs(&mut self, ctx: &Context) {
        let mut is_open = self.costs.is_open;
        let window = Window::new("Cost").open(&mut is_open).resizable(true);
        let last = self.last;
        window.default_size([560.0, 560.0]).show(ctx, |ui| {
            ScrollArea::both().show(ui, |ui| {
                for side in self.state.layout().sides() {
                    let renderer = last.and_then(|l| l.renderers[side.index()]);
                    let name = renderer.map_or(String::new(), |r| r.to_string());
                    ui.heading(format!("{side}: {name}"));
                    if let Some(clocks) = self.screen.clocks(*side) {
                        ui.label(format!("the last frame ran on: {}", names(clocks)));
                    }
                    match self.costs.answer(*side) {
                        None => {
                            ui.spinner();
                        }
                        Some(Err(why)) => {
                            ui.label(why);
                        }
                        Some(Ok(cost)) => {
                            ui.push_id(side, |ui| contents(ui, cost));
                        }
                    }
                }
            });
        });
        self.costs.is_open = is_open;
    }
}

/// Description of a clock.
fn when(clock: Clock) -> &'static str {
    match clock {
        Clock::Solid => "once for a mesh",
        Clock::Cut => "for each change of a cut",
        Clock::Frame => "for each frame",
    }
}

fn color(clock: Clock) -> Color32 {
    match clock {
        Clock::Solid => Color32::from_rgb(150, 120, 70),
        Clock::Cut => Color32::from_rgb(210, 120, 40),
        Clock::Frame => Color32::from_rgb(70, 120, 200),
    }
}

fn contents(ui: &mut Ui, cost: &Cost) {
    ui.label(match cost.is_device_time {
        true => "Time on the device.",
        false => "Wall-clock time, with a wait after each pass: device timestamps are unreliable.",
    });
    for clock in Clock::ALL {
        let passes: Vec<&PassCost> = cost.passes.iter().filter(|p| p.clock == clock).collect();
        let bytes = [cost.bytes.solid, cost.bytes.cut, cost.bytes.frame][clock as usize];
        if passes.is_empty() && bytes == 0 {
            continue;
        }
        let (time_ms, bytes) = (cost.time_ms(clock), size(bytes));
        let taken = match passes.len() {
            0 => bytes,
            1 => format!("1 pass, {time_ms:.2} ms, {bytes}"),
            count => format!("{count} passes, {time_ms:.2} ms, {bytes}"),
        };
        ui.label(format!("per {}, {}: {taken}", clock.name(), when(clock)));
        if !passes.is_empty() {
            stacked(ui, &passes, clock, time_ms);
        }
    }
    ui.label(format!("scene: {}", size(cost.scene_bytes)));
    if cost.bands > 1 {
        let bands = cost.bands;
        ui.label(format!(
            "Drawn in {bands} bands of rows; the bytes are those of the first band."
        ));
    }
    table(ui, &cost.passes);
}

/// Shows the passes of a clock as one bar, divided in proportion to their times.
fn stacked(ui: &mut Ui, passes: &[&PassCost], clock: Clock, all_ms: f64) {
    let width = ui.available_width().max(LONGEST_POINTS);
    let (rect, _) = ui.allocate_exact_size(vec2(width, BAR_POINTS), Sense::hover());
    let mut left = rect.left();
    for (index, pass) in passes.iter().enumerate() {
        let share = (pass.time_ms / all_ms.max(1e-9)) as f32;
        let part = Rect::from_min_size([left, rect.top()].into(), vec2(width * share, BAR_POINTS));
        left = part.right();
        let shade = if index % 2 == 0 { 1.0 } else { 0.7 };
        let fill = color(clock).gamma_multiply(shade);
        ui.painter().rect_filled(part, CornerRadius::ZERO, fill);
        let text = ui.painter().layout_no_wrap(
            pass.name.clone(),
            eframe::egui::FontId::proportional(11.0),
            Color32::WHITE,
        );
        if text.size().x + 4.0 < part.width() {
            let at = part.left_center() + Vec2::new(2.0, -text.size().y * 0.5);
            ui.painter().galley(at, text, Color32::WHITE);
        }
        let id = ui.scope_id().with(("pass", clock, index));
        let response = ui.interact(part, id, Sense::hover());
        response.on_hover_text(format!(
            "{}: {:.3} ms\n{}",
            pass.name, pass.time_ms, pass.reason
        ));
    }
}

fn table(ui: &mut Ui, passes: &[PassCost]) {
    let longest_ms = passes.iter().map(|p| p.time_ms).fold(1e-9, f64::max);
    let grid = Grid::new("passes").num_columns(4).striped(true);
    grid.show(ui, |ui| {
        for title in ["Pass", "Clock", "ms", "Writes"] {
            ui.weak(title);
        }
        ui.end_row();
        for pass in passes {
            ui.label(&pass.name).on_hover_text(&pass.reason);
            ui.label(pass.clock.name());
            ui.horizontal(|ui| {
                let width = LONGEST_POINTS * (pass.time_ms / longest_ms) as f32;
                let size = vec2(LONGEST_POINTS, BAR_POINTS * 0.6);
                let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                let bar = Rect::from_min_size(rect.min, vec2(width, rect.height()));
                let fill = color(pass.clock);
                ui.painter().rect_filled(bar, CornerRadius::ZERO, fill);
                ui.label(format!("{:.3}", pass.time_ms));
            });
            ui.label(size(pass.bytes));
            ui.end_row();
        }
    });
}

fn names(clocks: cutaway::gpu::ClockSet) -> String {
    let ran = Clock::ALL.into_iter().filter(|c| clocks.contains(*c));
    ran.map(Clock::name).collect::<Vec<_>>().join(", ")
}

/// A number of bytes as text, with a unit.
fn size(bytes: u64) -> String {
    match bytes {
        0..1024 => format!("{bytes} B"),
        1024..1_048_576 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        _ => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
    }
}
