//! A chart as SVG: marks with their spread, lines, a front, axes with ticks.
//!
//! Colours are classes of the page's style, so that they follow light and dark; a series has a colour and a shape, so that neither alone
//! tells it apart. Each mark says what it is when it is pointed at, and in words for those who cannot see it.

use maud::{Markup, html};

use super::axis::{Scale, number};

/// Size of the drawing.
const SIZE: [f64; 2] = [720.0, 400.0];
/// Left, right, top and bottom of the axes.
const FRAME: [f64; 4] = [64.0, 704.0, 14.0, 346.0];
/// Radius of a mark.
const RADIUS: f64 = 4.5;
/// Colours of the style.
const COLORS: usize = 8;

/// A chart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chart {
    /// What it shows.
    pub title: String,
    /// One line under it.
    pub note: Option<String>,
    /// To the right.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
    /// Points of the front, the cheapest first.
    pub front: Vec<[f64; 2]>,
}

/// An axis of a chart.
#[derive(Clone, Debug, Default)]
pub(crate) struct Axis {
    /// What it measures, with its unit.
    pub label: String,
    /// Whether it is logarithmic.
    pub is_log: bool,
    /// Words at 0, 1, 2, ... where values are no numbers.
    pub categories: Vec<String>,
}

/// Marks of one kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    pub name: String,
    /// In the order in which they are joined.
    pub marks: Vec<Mark>,
}

/// A mark.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mark {
    /// Where it is.
    pub at: [f64; 2],
    /// How far its coordinates scatter to either side.
    pub spread: [f64; 2],
    /// What it is.
    pub title: String,
    /// Whether something about it is doubtful, as of a frame that overflowed.
    pub is_doubtful: bool,
}

impl Chart {
    /// The drawing, without its title and legend.
    pub(super) fn svg(&self) -> Markup {
        let marks = || self.series.iter().flat_map(|s| &s.marks);
        let [left, right, top, bottom] = FRAME;
        let scale = |i: usize, axis: &Axis, px: [f64; 2]| {
            let values: Vec<f64> = if axis.categories.is_empty() {
                // Ends of spreads too, but none that would squeeze the rest.
                let ends = |m: &Mark| {
                    let (at, spread) = (m.at[i], m.spread[i].min(m.at[i] * 0.5));
                    [at, at - spread, at + spread]
                };
                marks().flat_map(ends).collect()
            } else {
                (0..axis.categories.len()).map(|c| c as f64).collect()
            };
            Scale::of(&values, axis.is_log, i == 1, px)
        };
        let scales = [
            scale(0, &self.x, [left, right]),
            scale(1, &self.y, [bottom, top]),
        ];
        let place = |at: [f64; 2]| [0, 1].map(|i| scales[i].place(at[i]));
        html! {
            svg viewBox={ "0 0 " (SIZE[0]) " " (SIZE[1]) } role="img" aria-label=(self.title) {
                (self.axes(&scales))
                @if self.front.len() > 1 {
                    polyline.front points=(points(self.front.iter().map(|p| place(*p)))) {}
                }
                @for (index, series) in self.series.iter().enumerate() {
                    g class={ "c" (index % COLORS) } {
                        @if series.marks.len() > 1 {
                            polyline points=(points(series.marks.iter().map(|m| place(m.at)))) {}
                        }
                        @for mark in &series.marks { (drawn(mark, index, &scales)) "\n" }
                    }
                }
            }
        }
    }

    fn axes(&self, scales: &[Scale; 2]) -> Markup {
        let [left, right, top, bottom] = FRAME;
        let ticks = |i: usize, axis: &Axis| -> Vec<(f64, String)> {
            if axis.categories.is_empty() {
                return scales[i].ticks();
            }
            let words = axis.categories.iter().enumerate();
            words.map(|(c, word)| (c as f64, word.clone())).collect()
        };
        let middle = (top + bottom) * 0.5;
        html! {
            g.axes {
                @for (value, word) in ticks(0, &self.x) {
                    @let x = px(scales[0].place(value));
                    line.grid x1=(x) x2=(x) y1=(top) y2=(bottom) {}
                    text x=(x) y=(bottom + 18.0) text-anchor="middle" { (word) }
                }
                @for (value, word) in ticks(1, &self.y) {
                    @let y = scales[1].place(value);
                    line.grid x1=(left) x2=(right) y1=(px(y)) y2=(px(y)) {}
                    text x=(left - 8.0) y=(px(y + 4.0)) text-anchor="end" { (word) }
                }
                @if let Some(y) = scales[1].zero_px {
                    line.zero x1=(left) x2=(right) y1=(y) y2=(y) {}
                }
                text.label x=((left + right) * 0.5) y=(SIZE[1] - 14.0) text-anchor="middle" { (self.x.label) }
                text.label transform={ "translate(14 " (middle) ") rotate(-90)" } text-anchor="middle" { (self.y.label) }
            }
        }
    }

    /// Names of the series with their marks.
    pub(super) fn legend(&self) -> Markup {
        html! {
            ul.legend {
                @for (index, series) in self.series.iter().enumerate() {
                    li {
                        svg viewBox="0 0 14 14" class={ "c" (index % COLORS) } aria-hidden="true" { (shape([7.0, 7.0], index, false)) }
                        (series.name)
                    }
                }
            }
        }
    }
}

/// A coordinate, to a tenth of a pixel.
fn px(at: f64) -> String {
    format!("{at:.1}")
}

fn points(all: impl Iterator<Item = [f64; 2]>) -> String {
    let words: Vec<String> = all.map(|at| at.map(px).join(",")).collect();
    words.join(" ")
}

fn drawn(mark: &Mark, series: usize, scales: &[Scale; 2]) -> Markup {
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
            (shape(at, series, mark.is_doubtful))
        }
    }
}

/// The shape of a series: circle, square, diamond or triangle, another one after all colours are used.
fn shape([x, y]: [f64; 2], series: usize, is_hollow: bool) -> Markup {
    let r = RADIUS;
    let class = is_hollow.then_some("hollow");
    let path = match (series / COLORS + series) % 4 {
        0 => return html! { circle class=[class] cx=(px(x)) cy=(px(y)) r=(r) {} },
        1 => format!("M{:.1} {:.1}h{d}v{d}h-{d}z", x - r, y - r, d = 2.0 * r),
        2 => format!(
            "M{x:.1} {:.1}l{s} {s}l-{s} {s}l-{s} -{s}z",
            y - r * 1.3,
            s = r * 1.3
        ),
        _ => format!(
            "M{x:.1} {:.1}l{w} {h}h-{b}z",
            y - r * 1.2,
            w = r * 1.2,
            h = r * 2.1,
            b = r * 2.4
        ),
    };
    html! { path class=[class] d=(path) {} }
}

/// Words of a value, for titles of marks.
pub(in crate::report) fn word_of(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e7 {
        format!("{value:.0}")
    } else {
        number(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart() -> Chart {
        let mark = |x: f64, y: f64| Mark {
            at: [x, y],
            spread: [0.2, 0.0],
            title: format!("<{x}>"),
            is_doubtful: y > 50.0,
        };
        Chart {
            title: "a & b".to_owned(),
            y: Axis {
                is_log: true,
                ..Axis::default()
            },
            series: vec![
                Series {
                    name: "one".to_owned(),
                    marks: vec![mark(1.0, 100.0), mark(2.0, 10.0), mark(3.0, 0.0)],
                },
                Series {
                    name: "<two>".to_owned(),
                    marks: vec![mark(2.0, 20.0)],
                },
            ],
            front: vec![[1.0, 100.0], [2.0, 10.0], [3.0, 0.0]],
            ..Chart::default()
        }
    }

    #[test]
    fn every_mark_is_drawn_with_its_title_and_spread() {
        let svg = chart().svg().into_string();
        assert_eq!(svg.matches("class=\"mark\"").count(), 4);
        assert_eq!(svg.matches("<title>").count(), 4);
        assert_eq!(svg.matches("class=\"front\"").count(), 1);
        assert_eq!(svg.matches("class=\"hollow\"").count(), 1);
        assert_eq!(svg.matches("class=\"zero\"").count(), 1);
        assert!(
            svg.contains("&lt;2&gt;") && svg.contains("a &amp; b"),
            "{svg}"
        );
        assert!(chart().legend().into_string().contains("&lt;two&gt;"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn an_empty_chart_is_drawn() {
        let svg = Chart::default().svg().into_string();
        assert!(!svg.contains("NaN") && svg.ends_with("</svg>"), "{svg}");
    }
}
