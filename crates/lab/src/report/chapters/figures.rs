//! Labels and formats of figures, the same in every table and chart.

use crate::experiment::Samples;
use crate::report::derived::Spread;
use crate::report::document::{Cell, Tone};
use crate::report::number::milliseconds;
pub(super) use crate::report::number::{percent, times};

/// A count with its noun in singular or plural: `1 point`, `2 points`.
pub(super) fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}

/// The readable label of a figure; the figure's own name if it has no label.
pub(super) fn label(name: &str) -> String {
    let meaning = match name {
        "decided_wrong_px" => "decided wrong px",
        "missed_cap_px" => "missed cap px",
        "leaked_cap_px" => "leaked cap px",
        "wrong_part_px" => "wrong part px",
        "crack_px" => "crack px",
        "outline_px" => "outline px",
        "interior_wrong_px" => "interior px",
        "edge_wrong_px" => "edge px",
        "odd_parity_px" => "unreliable px",
        "depth_error_px_max" => "largest error of depth, px",
        "depth_error_px_mean" => "mean error of depth, px",
        "normal_error_deg_max" => "largest error of cap normals, degrees",
        "normal_error_deg_mean" => "mean error of cap normals, degrees",
        "ratio" => "frame time, × draw only",
        "ratio.view_moves" => "time when the view moves, × draw only",
        "ratio.cut_moves" => "time when the cut moves, × draw only",
        "ratio.mesh_moves" => "time when the mesh moves, × draw only",
        "time_ms" => "time of all clocks, ms",
        "time_ms.frame" => "time of a frame, ms",
        "time_ms.cut" => "time when a cut changed, ms",
        "time_ms.solid" => "time when the mesh changed, ms",
        "draw_only_ms" => "draw only, ms",
        "bytes" => "memory, bytes",
        "bytes.frame" => "memory of the frame, bytes",
        "bytes.cut" => "memory of the cut, bytes",
        "bytes.solid" => "memory of the solid, bytes",
        name => return name.replace('_', " "),
    };
    meaning.to_owned()
}

/// A cell for a number of wrong pixels; 0 is good.
pub(super) fn wrong_px(count: usize) -> Cell {
    Cell::number(count.to_string(), count as f64).toned(tone_of(count))
}

/// Severity of a number of wrong pixels.
pub(super) fn tone_of(count: usize) -> Tone {
    /// Up to this many wrong pixels are hardly noticeable.
    const FEW_PX: usize = 30;
    match count {
        0 => Tone::Good,
        1..=FEW_PX => Tone::Fair,
        _ => Tone::Bad,
    }
}

/// A median with its spread.
pub(super) fn timed(samples: &Samples) -> Cell {
    if samples.samples.is_empty() {
        return Cell::default();
    }
    Cell::number(
        format!(
            "{} ± {}",
            milliseconds(samples.median),
            milliseconds(samples.mad)
        ),
        samples.median,
    )
}

/// A ratio with its spread.
pub(super) fn ratio(ratio: Option<f64>, mad: Option<f64>) -> Cell {
    match (ratio, mad) {
        (None, _) => Cell::default(),
        (Some(ratio), None) => Cell::number(times(ratio), ratio),
        (Some(ratio), Some(mad)) => Cell::number(format!("{} ± {mad:.2}", times(ratio)), ratio),
    }
}

/// The median of some ratios, with their range.
pub(super) fn ranged(spread: Option<Spread>) -> Cell {
    spread.map_or_else(Cell::default, |s| {
        let cell = Cell::number(times(s.median), s.median);
        cell.titled(format!("from {} to {}", times(s.least), times(s.most)))
    })
}

/// The median and the maximum of some shares, in percent.
pub(super) fn shares(spread: Option<Spread>) -> Cell {
    spread.map_or_else(Cell::default, |s| {
        let text = format!("{} (up to {})", percent(s.median), percent(s.most));
        Cell::number(text, s.median)
    })
}

/// The median and the maximum of some counts.
pub(super) fn counts(spread: Option<Spread>) -> Cell {
    spread.map_or_else(Cell::default, |s| {
        let text = format!("{:.0} (up to {:.0})", s.median, s.most);
        Cell::number(text, s.median)
    })
}
