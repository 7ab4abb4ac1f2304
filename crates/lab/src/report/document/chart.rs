//! A chart as SVG: marks with their spreads, lines, a Pareto front, and axes with ticks.
//!
//! If there are too many series for one drawing, they are split over several small drawings with the same axes. A series has the colour and
//! marker of its method, as everywhere in a report. In a single drawing, the name of a series is at its end if there is room, otherwise in
//! a list below. Each mark has a tooltip, and a text for assistive technology.

use std::collections::BTreeSet;

use maud::{Markup, html};

use super::axis::{Scale, apart};
use super::ends::{self, SeriesLabel};
use super::marker::{badge, color, marker, px};
use crate::report::look::Look;

/// A chart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chart {
    /// Subject of the chart.
    pub title: String,
    /// One line of text under the chart.
    pub note: Option<String>,
    /// The horizontal axis.
    pub x: ChartAxis,
    /// The vertical axis.
    pub y: ChartAxis,
    /// The drawings, all with the same axes.
    pub panels: Vec<Panel>,
}

/// One drawing.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panel {
    /// What distinguishes this drawing from the chart's other drawings.
    pub title: String,
    /// Series in the drawing.
    pub series: Vec<Series>,
    /// Points of the Pareto front, the cheapest first.
    pub front: Vec<[f64; 2]>,
}

/// An axis of a chart.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChartAxis {
    /// The quantity along the axis, with its unit.
    pub label: String,
    /// True if the axis is logarithmic.
    pub is_log: bool,
    /// Labels at the positions 0, 1, 2, ...; empty if the values are numbers.
    pub categories: Vec<String>,
}

/// Marks that share a name, a colour and a marker.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    pub name: String,
    pub look: Look,
    /// The marks, in the order in which a line joins them.
    pub marks: Vec<Mark>,
}

/// A mark.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mark {
    /// Position of the mark.
    pub at: [f64; 2],
    /// Spread of each coordinate to either side.
    pub spread: [f64; 2],
    /// Tooltip of the mark.
    pub title: String,
    /// True if the mark is doubtful, such as a frame that overflowed.
    pub is_doubtful: bool,
}

/// Size of a drawing and placement of its axes.
pub(super) struct ChartFrame {
    /// Size of the drawing.
    size: [f64; 2],
    /// Left, right, top and bottom of the axes.
    sides: [f64; 4],
    /// Minimum distance between tick labels along x.
    between_ticks: f64,
}

/// Layout of a single drawing, with room for names on the right.
const LARGE: ChartFrame = ChartFrame {
    size: [720.0, 400.0],
    sides: [64.0, 706.0, 14.0, 346.0],
    between_ticks: 34.0,
};

/// Layout of one of several drawings.
const SMALL: ChartFrame = ChartFrame {
    size: [360.0, 250.0],
    sides: [58.0, 350.0, 12.0, 204.0],
    between_ticks: 44.0,
};

/// Width of a letter in a name at the end of a line, in pixels.
const NAME_LETTER: f64 = 7.0;

impl Chart {
    fn marks(&self) -> impl Iterator<Item = &Mark> {
        let series = self.panels.iter().flat_map(|p| &p.series);
        series.flat_map(|s| &s.marks)
    }

    /// The distinct names of all series, with their looks.
    fn names(&self) -> Vec<(&str, Look)> {
        let mut names: Vec<(&str, Look)> = Vec::new();
        for series in self.panels.iter().flat_map(|p| &p.series) {
            if !names.iter().any(|(name, _)| *name == series.name) {
                names.push((&series.name, series.look));
            }
        }
        names
    }

    fn scales(&self, [left, right, top, bottom]: [f64; 4]) -> [Scale; 2] {
        let scale = |i: usize, axis: &ChartAxis, px: [f64; 2]| {
            let values: Vec<f64> = if axis.categories.is_empty() {
                // The axis includes the ends of spreads, but limits them so that they do not squeeze the rest of the chart.
                let ends = |m: &Mark| {
                    let (at, spread) = (m.at[i], m.spread[i].min(m.at[i] * 0.5));
                    [at, at - spread, at + spread]
                };
                self.marks().flat_map(ends).collect()
            } else {
                (0..axis.categories.len()).map(|c| c as f64).collect()
            };
            Scale::of(&values, axis.is_log, i == 1, px)
        };
        [
            scale(0, &self.x, [left, right]),
            scale(1, &self.y, [bottom, top]),
        ]
    }

    /// The drawings, and a legend for the series whose names are not in a drawing.
    pub(super) fn html(&self) -> Markup {
        let names = self.names();
        let [panel] = self.panels.as_slice() else {
            return html! {
                div.panels {
                    @for panel in &self.panels {
                        div.panel {
                            p.panel-title { (panel.title) }
                            (self.svg(panel, &SMALL, &names, &[]))
                        }
                    }
                }
                (legend(&names, &BTreeSet::new()))
            };
        };
        // Lines along a parameter end on the right; the names of other marks are wherever there is room.
        let longest = names.iter().map(|(name, _)| name.chars().count()).max();
        let [left, mut right, top, bottom] = LARGE.sides;
        if names.len() > 1 {
            right -= (longest.unwrap_or(0) as f64 * NAME_LETTER).min(200.0);
        }
        let frame = ChartFrame {
            sides: [left, right, top, bottom],
            ..LARGE
        };
        let endings = match names.len() {
            0 | 1 => Vec::new(),
            _ => self.endings(panel, &frame),
        };
        let named: BTreeSet<usize> = endings.iter().map(|e| e.series).collect();
        html! {
            div.scroll tabindex="0" role="region" aria-label="chart" { (self.svg(panel, &frame, &names, &endings)) }
            (legend(&names, &named))
        }
    }

    fn endings(&self, panel: &Panel, frame: &ChartFrame) -> Vec<SeriesLabel> {
        let scales = self.scales(frame.sides);
        let place = |m: &Mark| [0, 1].map(|i| scales[i].place(m.at[i]));
        let series = panel.series.iter();
        let placed = series.map(|s| (s.name.as_str(), s.marks.iter().map(place).collect()));
        let [left, _, _, bottom] = frame.sides;
        // Names must not cover the axis labels.
        let within = [left, frame.size[0], 0.0, bottom + 3.0];
        ends::placed(&placed.collect::<Vec<_>>(), within, NAME_LETTER)
    }

    fn svg(
        &self,
        panel: &Panel,
        frame: &ChartFrame,
        names: &[(&str, Look)],
        endings: &[SeriesLabel],
    ) -> Markup {
        let scales = self.scales(frame.sides);
        let place = |at: [f64; 2]| [0, 1].map(|i| scales[i].place(at[i]));
        let number = |series: &Series| names.iter().position(|(name, _)| *name == series.name);
        let title = match panel.title.as_str() {
            "" => self.title.clone(),
            title => format!("{}, {title}", self.title),
        };
        html! {
            svg viewBox={ "0 0 " (frame.size[0]) " " (frame.size[1]) } role="img" aria-label=(title) {
                (self.axes(frame, &scales))
                @if panel.front.len() > 1 {
                    polyline.front points=(points(panel.front.iter().map(|p| place(*p)))) {}
                }
                @for series in &panel.series {
                    g class=(color(series.look)) data-series=[number(series)] {
                        @if series.marks.len() > 1 {
                            polyline points=(points(series.marks.iter().map(|m| place(m.at)))) {}
                        }
                        @for mark in &series.marks { (drawn(mark, series.look, &scales)) "\n" }
                    }
                }
                @for ending in endings {
                    @let series = &panel.series[ending.series];
                    g class=(color(series.look)) data-series=[number(series)] {
                        @if let Some(from) = ending.lead {
                            polyline.lead points=(points([from, [ending.at[0] - 2.0, ending.at[1] - 4.0]].into_iter())) {}
                        }
                        text.ending x=(px(ending.at[0])) y=(px(ending.at[1])) { (series.name) }
                    }
                }
            }
        }
    }

    fn axes(&self, frame: &ChartFrame, scales: &[Scale; 2]) -> Markup {
        let [left, right, top, bottom] = frame.sides;
        let ticks = |i: usize, axis: &ChartAxis| -> Vec<(f64, String)> {
            if axis.categories.is_empty() {
                return scales[i].ticks();
            }
            let words = axis.categories.iter().enumerate();
            words.map(|(c, word)| (c as f64, word.clone())).collect()
        };
        let along_x = ticks(0, &self.x);
        let widest = along_x.iter().map(|(_, word)| word.chars().count()).max();
        let room = (right - left) / along_x.len().max(1) as f64;
        // Labels that are wider than the room between them are slanted.
        let is_slanted = !self.x.categories.is_empty()
            && widest.unwrap_or(0) as f64 * NAME_LETTER > room.max(frame.between_ticks);
        let middle = (top + bottom) * 0.5;
        let along_x = if is_slanted || !self.x.categories.is_empty() {
            along_x
        } else {
            apart(along_x, |v| scales[0].place(v), frame.between_ticks)
        };
        html! {
            g.axes {
                @for (value, word) in along_x {
                    @let x = scales[0].place(value);
                    line.grid x1=(px(x)) x2=(px(x)) y1=(top) y2=(bottom) {}
                    @if is_slanted {
                        text transform={ "translate(" (px(x + 4.0)) " " (bottom + 12.0) ") rotate(-24)" } text-anchor="end" { (word) }
                    } @else {
                        text x=(px(x)) y=(bottom + 18.0) text-anchor="middle" { (word) }
                    }
                }
                @for (value, word) in apart(ticks(1, &self.y), |v| scales[1].place(v), 15.0) {
                    @let y = scales[1].place(value);
                    line.grid x1=(left) x2=(right) y1=(px(y)) y2=(px(y)) {}
                    text x=(left - 8.0) y=(px(y + 4.0)) text-anchor="end" { (word) }
                }
                @if let Some(y) = scales[1].zero_px {
                    line.zero x1=(left) x2=(right) y1=(y) y2=(y) {}
                }
                text.label x=((left + right) * 0.5) y=(frame.size[1] - 8.0) text-anchor="middle" { (self.x.label) }
                text.label transform={ "translate(14 " (middle) ") rotate(-90)" } text-anchor="middle" { (self.y.label) }
            }
        }
    }
}

/// The legend: the series names with their markers, except names that are already in the drawing.
fn legend(names: &[(&str, Look)], named: &BTreeSet<usize>) -> Markup {
    let left = names.iter().enumerate();
    let left: Vec<_> = left.filter(|(index, _)| !named.contains(index)).collect();
    html! {
        @if !left.is_empty() {
            ul.legend {
                @for (index, (name, look)) in left {
                    li data-series=(index) { (badge(*look)) (name) }
                }
            }
        }
    }
}

fn points(all: impl Iterator<Item = [f64; 2]>) -> String {
    let words: Vec<String> = all.map(|at| at.map(px).join(",")).collect();
    words.join(" ")
}

fn drawn(mark: &Mark, look: Look, scales: &[Scale; 2]) -> Markup {
    let at = [0, 1].map(|i| scales[i].place(mark.at[i]));
    let ends = |i: usize| {
        [-1.0, 1.0].map(|side| {
            let mut end = at;
            end[i] = scales[i].place((mark.at[i] + side * mark.spread[i]).max(0.0));
            end.map(px)
        })
    };
    html! {
        g.mark tabindex="0" {
            title { (mark.title) }
            @for i in [0, 1].into_iter().filter(|i| mark.spread[*i] > 0.0) {
                @let [a, b] = ends(i);
                line x1=(a[0]) y1=(a[1]) x2=(b[0]) y2=(b[1]) {}
            }
            (marker(at, look.marker, mark.is_doubtful))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::look::look;

    fn series(name: &str, marks: &[[f64; 2]]) -> Series {
        let mark = |[x, y]: &[f64; 2]| Mark {
            at: [*x, *y],
            spread: [0.2, 0.0],
            title: format!("<{x}>"),
            is_doubtful: *y > 50.0,
        };
        Series {
            name: name.to_owned(),
            look: look(name),
            marks: marks.iter().map(mark).collect(),
        }
    }

    fn chart(panels: Vec<Panel>) -> Chart {
        Chart {
            title: "a & b".to_owned(),
            y: ChartAxis {
                is_log: true,
                ..ChartAxis::default()
            },
            panels,
            ..Chart::default()
        }
    }

    fn panel() -> Panel {
        let line = [[1.0, 100.0], [2.0, 10.0], [3.0, 0.0]];
        Panel {
            title: String::new(),
            series: vec![series("one", &line), series("<two>", &[[2.0, 20.0]])],
            front: line.into(),
        }
    }

    #[test]
    fn every_mark_is_drawn_with_its_title_and_spread() {
        let svg = chart(vec![panel()]).html().into_string();
        assert_eq!(svg.matches("class=\"mark\"").count(), 4);
        assert_eq!(svg.matches("<title>").count(), 4);
        assert_eq!(svg.matches("class=\"front\"").count(), 1);
        assert_eq!(svg.matches("class=\"hollow\"").count(), 1);
        assert_eq!(svg.matches("class=\"zero\"").count(), 1);
        assert!(
            svg.contains("&lt;2&gt;") && svg.contains("a &amp; b"),
            "{svg}"
        );
        assert!(svg.contains("&lt;two&gt;"), "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn every_series_is_named_once_at_its_end_or_below() {
        let alone = chart(vec![panel()]).html().into_string();
        for name in [">one<", ">&lt;two&gt;<"] {
            assert_eq!(alone.matches(name).count(), 1, "{name} in {alone}");
        }
        // Several drawings share one legend.
        let several = chart(vec![panel(), panel()]).html().into_string();
        assert_eq!(several.matches("<svg viewBox=\"0 0 360").count(), 2);
        assert_eq!(several.matches("<li data-series").count(), 2);
        assert!(!several.contains("class=\"ending\""), "{several}");
    }

    #[test]
    fn an_empty_chart_is_drawn() {
        let svg = chart(vec![Panel::default()]).html().into_string();
        assert!(!svg.contains("NaN") && svg.contains("</svg>"), "{svg}");
    }
}
