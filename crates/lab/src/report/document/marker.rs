//! Markers of methods, in drawings and in text.

use maud::{Markup, html};

use crate::report::look::{Look, Marker};

/// Radius of a marker.
const RADIUS: f64 = 4.5;

/// A coordinate as text, rounded to a tenth of a pixel.
pub(super) fn px(at: f64) -> String {
    format!("{at:.1}")
}

/// The marker centred at a position; hollow if its value is doubtful.
pub(super) fn marker([x, y]: [f64; 2], marker: Marker, is_hollow: bool) -> Markup {
    let r = RADIUS;
    let class = is_hollow.then_some("hollow");
    let triangle = |up: f64| {
        format!(
            "M{x:.1} {:.1}l{w:.1} {h:.1}h-{b:.1}z",
            y - up * r * 1.2,
            w = r * 1.2,
            h = up * r * 2.1,
            b = r * 2.4
        )
    };
    let path = match marker {
        Marker::Circle => {
            return html! { circle class=[class] cx=(px(x)) cy=(px(y)) r=(r) {} };
        }
        Marker::Square => format!("M{:.1} {:.1}h{d}v{d}h-{d}z", x - r, y - r, d = 2.0 * r),
        Marker::Diamond => {
            let s = r * 1.3;
            format!(
                "M{x:.1} {:.1}l{s:.1} {s:.1}l-{s:.1} {s:.1}l-{s:.1} -{s:.1}z",
                y - s
            )
        }
        Marker::Up => triangle(1.0),
        Marker::Down => triangle(-1.0),
        Marker::Cross => format!(
            "M{:.1} {:.1}l{d} {d}m0 -{d}l-{d} {d}",
            x - r,
            y - r,
            d = 2.0 * r
        ),
    };
    html! { path class=[class] d=(path) {} }
}

/// CSS class of a look's colour.
pub(super) fn color(look: Look) -> String {
    format!("c{}", look.color)
}

/// A marker for use in a line of text.
pub(super) fn badge(look: Look) -> Markup {
    html! {
        svg class={ "badge " (color(look)) } viewBox="0 0 14 14" aria-hidden="true" { (marker([7.0, 7.0], look.marker, false)) }
    }
}
