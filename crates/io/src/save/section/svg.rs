//! Draws sections as SVG, with each plane seen from the removed side.
//!
//! One file holds all planes side by side, each in a group. The paths in a group have exactly the coordinates `u` and `v` of the JSON. The
//! group flips `v` up and, except for the first plane, translates the plane. Each part is one path in its cap colour, filled by its fill
//! rule. Strokes keep their screen width if the viewer supports that. Otherwise their width is a thousandth of the drawing. Curves that do
//! not close are red and not filled, and so are lines that winding numbers added.
//!
//! A unit of the drawing is a unit of the model. If a [`LengthUnit`] is given, the drawing has the model's physical size. Otherwise its
//! longer side has [`LONGEST_PX`] pixels.

use cutaway::scene::LengthUnit;
use maud::{Markup, html};

use super::{Curve, PartReport, PlaneReport, SectionReport};

/// Number of pixels along the longer side of a drawing that has no physical size.
const LONGEST_PX: f64 = 1000.0;
/// Margin around the drawing and between planes, as a fraction of the longest side of any plane.
const GAP_SHARE: f64 = 0.03;
/// Number of digits that are kept for a coordinate as large as the longest side.
const DRAWN_DIGITS: i32 = 10;

/// Viewers without this effect skip the `@supports` rule. Without it, a stroke of 1 px would be one drawing unit wide, possibly a blot.
const NON_SCALING: &str = "@supports (vector-effect: non-scaling-stroke) \
    { path { vector-effect: non-scaling-stroke; stroke-width: 1px } .open { stroke-width: 2px } }";

/// A rectangle in a plane.
#[derive(Clone, Copy, Debug)]
struct PlaneRect {
    min: [f64; 2],
    max: [f64; 2],
}

impl PlaneRect {
    /// Bounds of all curves of a plane, or the unit square if there are no curves.
    fn of(plane: &PlaneReport) -> Self {
        let curves = plane
            .parts
            .iter()
            .flat_map(|p| p.loops.iter().chain(&p.open_chains));
        let mut points = curves.flat_map(|c| &c.uv).copied();
        let Some(first) = points.next() else {
            return Self {
                min: [0.0; 2],
                max: [1.0; 2],
            };
        };
        let start = Self {
            min: first,
            max: first,
        };
        points.fold(start, |f, p| Self {
            min: [0, 1].map(|i| f.min[i].min(p[i])),
            max: [0, 1].map(|i| f.max[i].max(p[i])),
        })
    }

    fn size(&self) -> [f64; 2] {
        [0, 1].map(|i| self.max[i] - self.min[i])
    }
}

/// Layout of the planes of a report side by side.
struct DrawingLayout {
    frames: Vec<PlaneRect>,
    /// The longest side of any plane.
    longest: f64,
}

impl DrawingLayout {
    fn of(report: &SectionReport) -> Self {
        let frames: Vec<PlaneRect> = report.sections.iter().map(PlaneRect::of).collect();
        let longest = (frames.iter().flat_map(PlaneRect::size)).fold(0.0, f64::max);
        let longest = if longest > 0.0 { longest } else { 1.0 };
        Self { frames, longest }
    }
}

/// Offset of each plane, such that all planes stand on one line. The first plane is not moved.
pub(super) fn places(report: &SectionReport) -> Vec<[f64; 2]> {
    let DrawingLayout { frames, longest } = DrawingLayout::of(report);
    let Some(first) = frames.first() else {
        return Vec::new();
    };
    let mut left = first.min[0];
    let place = |frame: &PlaneRect| {
        let by = [left - frame.min[0], frame.min[1] - first.min[1]];
        left += frame.size()[0] + longest * GAP_SHARE;
        by
    };
    frames.iter().map(place).collect()
}

/// Returns the text of the SVG file.
pub fn svg(report: &SectionReport, unit: Option<LengthUnit>) -> String {
    let DrawingLayout { frames, longest } = DrawingLayout::of(report);
    let decimals = (DRAWN_DIGITS - longest.log10().ceil() as i32).clamp(0, 300) as usize;
    let gap = longest * GAP_SHARE;
    let first = frames.first().copied().unwrap_or(PlaneRect {
        min: [0.0; 2],
        max: [1.0; 2],
    });
    // Planes stand on a common line.
    let width = frames.iter().map(|f| f.size()[0] + gap).sum::<f64>() + gap;
    let height = frames.iter().map(|f| f.size()[1]).fold(0.0, f64::max) + 2.0 * gap;
    let corner = [first.min[0] - gap, gap - height - first.min[1]];
    let number = |value: f64| shortened(value, decimals);

    let [wide, high] = match unit {
        Some(unit) => [width, height].map(|v| format!("{}mm", number(v * unit.mm()))),
        None => {
            let per_unit = LONGEST_PX / width.max(height);
            [width, height].map(|v| shortened(v * per_unit, 3))
        }
    };
    let seen = [corner[0], corner[1], width, height].map(number).join(" ");
    let drawing = html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(wide) height=(high) viewBox=(seen) {
            title { (without_controls(&report.scene)) }
            desc {
                "To scale: one unit is one unit of the model"
                @match unit {
                    Some(unit) => { ", drawn as 1 " (unit.symbol()) }
                    None => { "; the drawing has no physical size" }
                }
                ". Seen from the side that is removed."
            }
            style { (NON_SCALING) }
            g stroke-width=(number(width.max(height) / LONGEST_PX)) {
                @for (index, (plane, by)) in report.sections.iter().zip(places(report)).enumerate() {
                    "\n" (group(index, plane, by.map(number), decimals))
                }
            }
        }
    };
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n",
        drawing.into_string()
    )
}

fn group(index: usize, plane: &PlaneReport, [x, y]: [String; 2], decimals: usize) -> Markup {
    let moved = (index > 0).then(|| format!("translate({x} {y}) "));
    let rule = |part: &PartReport| match part.fill.as_str() {
        "nonzero" => "nonzero",
        _ => "evenodd",
    };
    html! {
        g id={ "section-" (index + 1) } transform={ (moved.unwrap_or_default()) "scale(1 -1)" } {
            title { (without_controls(&plane.name())) ": area " (plane.area) ", perimeter " (plane.perimeter) }
            @for part in &plane.parts {
                @if !part.loops.is_empty() {
                    "\n"
                    path d=(outline(&part.loops, decimals, "Z")) fill=(part.color) fill-rule=(rule(part)) stroke="#222222" {
                        title { (without_controls(&part.part)) ": area " (part.area) }
                    }
                }
                @for (curves, why) in [(&part.open_chains, "open"), (&part.bridges, "closed by winding numbers")] {
                    @if !curves.is_empty() {
                        "\n"
                        path.open d=(outline(curves, decimals, "")) fill="none" stroke="#cc0000" {
                            title { (without_controls(&part.part)) ": " (why) }
                        }
                    }
                }
            }
        }
    }
}

/// Formats curves as the data of one path. Consecutive points that round to the same text are merged.
fn outline(curves: &[Curve], decimals: usize, end: &str) -> String {
    let mut data = String::new();
    for curve in curves {
        let mut before = String::new();
        for at in &curve.uv {
            let point = at.map(|c| shortened(c, decimals)).join(" ");
            if point != before {
                let step = if before.is_empty() { "M" } else { "L" };
                data.push_str(step);
                data.push_str(&point);
                before = point;
            }
        }
        data.push_str(end);
    }
    data
}

/// Formats a number with `decimals` decimals, without trailing zeros.
fn shortened(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// Removes characters that XML does not allow.
fn without_controls(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).collect()
}
