//! The chart of error against time: a point for each method that draws the picture, and a list of those that refuse it.

use cutaway::strategies::Method;
use cutaway_io::Document;
use cutaway_lab::experiment::Renderer;
use eframe::egui::accesskit::Role;
use eframe::egui::{
    Color32, Context, ProgressBar, Rect, ScrollArea, Sense, TextStyle, Ui, Vec2, WidgetInfo, Window,
};
use egui_plot::{GridMark, MarkerShape, Plot, PlotPoint, Points};

use crate::action::Action;
use crate::judge::Subject;
use crate::judge::survey::{Found, SurveyPoint, SurveyQuestion, Surveyed};
use crate::picture::chart::{
    labels_around, lines, lines_of_wrong, place_of_time, place_of_wrong, time_label, wrong_label,
};
use crate::picture::slot::{Painter, SlotSide};
use crate::ui::Viewer;

/// Width of a method's mark in the chart, in points.
const MARK_POINTS: f32 = 12.0;

/// Maximum height of the list of refusals, in points.
const LIST_POINTS: f32 = 120.0;

/// A survey that is in progress or has ended.
struct SurveyRun {
    /// The document of the measured picture, with its eye.
    document: Document,
    time_s: Option<f64>,
    size_px: [u32; 2],
    /// Number of methods to measure; `None` until the first is done.
    total: Option<usize>,
    is_cancelled: bool,
    entries: Vec<(Method, Found)>,
}

impl SurveyRun {
    fn is_running(&self) -> bool {
        !self.is_cancelled && self.total != Some(self.entries.len())
    }
}

/// The window of the chart.
#[derive(Default)]
pub(in crate::ui) struct ChartWindow {
    /// True if a new survey is requested.
    pub(in crate::ui) is_asked: bool,
    is_open: bool,
    asked: u64,
    measured: Option<SurveyRun>,
}

impl ChartWindow {
    /// Returns true while methods are pending.
    pub(in crate::ui) fn is_busy(&self) -> bool {
        self.is_asked || self.measured.as_ref().is_some_and(SurveyRun::is_running)
    }

    /// Results so far.
    pub(in crate::ui) fn entries(&self) -> &[(Method, Found)] {
        self.measured.as_ref().map_or(&[], |m| &m.entries)
    }

    /// Receives the result for a method.
    pub(in crate::ui) fn take_in(&mut self, id: u64, surveyed: Surveyed) {
        let measured = self.measured.as_mut().filter(|_| id == self.asked);
        if let Some(measured) = measured.filter(|m| !m.is_cancelled) {
            measured.total = Some(surveyed.total);
            measured.entries.push((surveyed.method, surveyed.found));
        }
    }
}

impl Viewer {
    /// Starts a survey if one is requested.
    pub(in crate::ui) fn survey(&mut self, ctx: &Context) {
        if !self.chart.is_asked || self.is_drawing() {
            return;
        }
        self.chart.is_asked = false;
        let Some(subject) = Subject::of(&self.state, self.size_px) else {
            return;
        };
        self.chart.is_open = true;
        self.chart.asked += 1;
        self.chart.measured = Some(SurveyRun {
            document: self.state.document().clone(),
            time_s: self.state.time_s(),
            size_px: self.size_px,
            total: None,
            is_cancelled: false,
            entries: Vec::new(),
        });
        let question = SurveyQuestion {
            id: self.chart.asked,
            subject,
        };
        self.judged.judge(ctx, &self.screen).survey(question);
    }

    /// The window of the chart.
    pub(in crate::ui) fn chart(&mut self, ctx: &Context, actions: &mut Vec<Action>) {
        let mut is_open = self.chart.is_open;
        let mut ends = false;
        let now = (self.state.document(), self.state.time_s(), self.size_px);
        let adapter = self.screen.gpu().name();
        if let Some(measured) = &self.chart.measured {
            let then = (&measured.document, measured.time_s, measured.size_px);
            Window::new("Error against time")
                .open(&mut is_open)
                .resizable(true)
                .default_size([620.0, 460.0])
                .show(ctx, |ui| {
                    ends = head(ui, measured, adapter, then != now);
                    let chosen = contents(ui, measured);
                    let by = chosen.map(|method| Painter::Named(Renderer::Method(method)));
                    actions.extend(by.map(|by| Action::Choose(SlotSide::B, by)));
                });
        }
        // Closing the window ends the survey.
        ends |= self.chart.is_open && !is_open;
        self.chart.is_open = is_open;
        if let Some(measured) = (self.chart.measured.as_mut()).filter(|m| ends && m.is_running()) {
            measured.is_cancelled = true;
            self.judged.judge(ctx, &self.screen).cancel_survey();
        }
    }
}

/// Shows the progress or the result. Returns true if the survey is to be cancelled.
fn head(ui: &mut Ui, measured: &SurveyRun, adapter: &str, is_old: bool) -> bool {
    let mut ends = false;
    let [width, height] = measured.size_px;
    let done = measured.entries.len();
    if measured.is_running() {
        ui.horizontal(|ui| {
            let share = measured.total.map_or(0.0, |all| done as f32 / all as f32);
            let said = match measured.total {
                Some(total) => format!("{done} of {total}"),
                None => "exact, and the first method".to_owned(),
            };
            ui.add(ProgressBar::new(share).text(said).desired_width(240.0));
            ends = ui.button("Cancel measuring").clicked();
        });
    } else if let Some(total) = measured.total.filter(|_| measured.is_cancelled) {
        ui.label(format!("Ended after {done} of {total} methods."));
    } else if measured.is_cancelled {
        ui.label("Ended before the first method.");
    }
    let points = measured.entries.iter().filter_map(point);
    let mut clocks = points.map(|(_, point)| point.is_device_time);
    let clock = match clocks.next() {
        Some(true) => "time on the device",
        Some(false) => "wall-clock time, as its timestamps are unreliable",
        None => "no time yet",
    };
    ui.label(format!("{width} x {height} on {adapter}; {clock}"));
    if is_old {
        ui.label("The scene or the view has changed since.");
    }
    ends
}

fn point((method, found): &(Method, Found)) -> Option<(Method, &SurveyPoint)> {
    match found {
        Found::SurveyPoint(point) => Some((*method, point)),
        Found::Refused(_) => None,
    }
}

/// Shows the chart and the list of refusals. Returns the method whose mark was clicked.
fn contents(ui: &mut Ui, measured: &SurveyRun) -> Option<Method> {
    let refused: Vec<(&Method, &String)> = (measured.entries.iter())
        .filter_map(|(method, found)| match found {
            Found::Refused(why) => Some((method, why)),
            Found::SurveyPoint(_) => None,
        })
        .collect();
    let rows = ui.text_style_height(&TextStyle::Body) + ui.spacing().item_spacing.y;
    let below = match refused.len() {
        0 => 0.0,
        count => (rows * (count + 1) as f32).min(LIST_POINTS),
    };
    let height = (ui.available_height() - below).max(160.0);
    let points: Vec<(Method, &SurveyPoint)> = measured.entries.iter().filter_map(point).collect();
    let chosen = plot(ui, &points, height);
    if !refused.is_empty() {
        ui.separator();
        let list = ScrollArea::vertical().auto_shrink([false, true]);
        list.show(ui, |ui| {
            for (method, why) in refused {
                ui.label(format!("{method} refuses: {why}"));
            }
        });
    }
    chosen
}

fn plot(ui: &mut Ui, points: &[(Method, &SurveyPoint)], height: f32) -> Option<Method> {
    let mark = |(value, step_size): (f64, f64)| GridMark { value, step_size };
    let marks = move |all: Vec<(f64, f64)>| all.into_iter().map(mark).collect::<Vec<_>>();
    let color = |point: &SurveyPoint| match (point.overflow.is_some(), point.wrong_px) {
        (true, _) => Color32::from_rgb(200, 60, 60),
        (false, 0) => Color32::from_rgb(60, 160, 80),
        (false, _) => Color32::from_rgb(70, 120, 200),
    };
    let at = |point: &SurveyPoint| [place_of_time(point.time_ms), place_of_wrong(point.wrong_px)];
    let times = || points.iter().map(|(_, point)| at(point)[0]);
    let range = (times().reduce(f64::min), times().reduce(f64::max));
    let around = match range {
        (Some(least), Some(greatest)) => labels_around(least, greatest),
        _ => [0.0, 1.0],
    };
    let plot = Plot::new("error against time");
    let plot = around.into_iter().fold(plot, Plot::include_x);
    let shown = plot
        .height(height)
        .x_axis_label("a frame, ms")
        .y_axis_label("pixels decided wrong")
        .x_axis_formatter(|mark, _| time_label(mark.value))
        .y_axis_formatter(|mark, _| wrong_label(mark.value))
        .x_grid_spacer(move |input| marks(lines(input.bounds.0, input.bounds.1)))
        .y_grid_spacer(move |input| marks(lines_of_wrong(input.bounds.0, input.bounds.1)))
        .set_margin_fraction(Vec2::splat(0.12))
        .include_y(place_of_wrong(0))
        .include_y(1.0)
        .show_x(false)
        .show_y(false)
        .label_formatter(|_| None)
        .allow_scroll(false)
        .show(ui, |plot| {
            for (method, point) in points {
                let mark = Points::new(method.to_string(), at(point))
                    .shape(MarkerShape::Circle)
                    .radius(MARK_POINTS * 0.4)
                    .color(color(point))
                    .allow_hover(false);
                plot.points(mark);
            }
        });
    shown
        .response
        .accessible_name("Chart of error against time");
    let mut chosen = None;
    for (method, point) in points {
        let [x, y] = at(point);
        let middle = shown.transform.position_from_point(&PlotPoint::new(x, y));
        if !shown.transform.frame().contains(middle) {
            continue;
        }
        let place = Rect::from_center_size(middle, Vec2::splat(MARK_POINTS));
        let id = ui.scope_id().with(("method", method.to_string()));
        let response = ui.interact(place, id, Sense::click());
        let said = sentence(*method, point);
        let label = said.clone();
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label.clone()));
        if response
            .on_hover_text(format!("{said}\nclick: show in slot B"))
            .clicked()
        {
            chosen = Some(*method);
        }
    }
    chosen
}

fn sentence(method: Method, point: &SurveyPoint) -> String {
    let SurveyPoint {
        time_ms,
        wrong_px,
        unmarked_px,
        ..
    } = point;
    let unmarked = match wrong_px == unmarked_px {
        true => String::new(),
        false => format!(", {unmarked_px} of them unmarked"),
    };
    let overflow = point.overflow.as_ref();
    let overflow = overflow.map_or(String::new(), |what| format!("; overflowed: {what}"));
    format!("{method}: {time_ms:.2} ms, {wrong_px} px decided wrong{unmarked}{overflow}")
}
