//! The numbers of a style in the shaders' layout, and the width of its strokes in pixels.

use glam::Vec3;

use super::ambient::relief_sky;
use super::pixels;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Plan, pack};
use crate::scene::style::{Paper, Style};
use crate::scene::{View, linear_from_srgb, map_channels};

/// The widest strokes are 32 pixels wide.
const MOST_HALF_PX: f32 = 16.0;

/// Binding of the numbers of the style.
pub(super) fn style_numbers(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Binding {
    let style = &scene.input.model.prepared.style;
    let mut numbers = numbers(style, scene.input.view);
    if relief_sky::is_drawn(scene) {
        // The occlusion values from the relief pass already include the weight on caps.
        numbers.occlusion_cap = 1.0;
    }
    pixels::numbers(plan, "style", numbers)
}

/// Greatest distance in pixels between a border and a pixel that its stroke still covers in part.
pub(super) fn reach_px(style: &Style, rows: u32) -> i32 {
    (half_px(style.strokes.widest(), rows)).ceil() as i32 + 1
}

/// Half the width of a stroke in pixels; clamped, because the cost grows with the square of the width.
pub(super) fn half_px(width: f32, rows: u32) -> f32 {
    (Style::px(width, rows) / 2.0).min(MOST_HALF_PX)
}

fn numbers(style: &Style, view: &View) -> pack::Style {
    let (rows, fineness) = (view.band[1], view.fineness);
    let linear = |color: Vec3| map_channels(color, linear_from_srgb);
    let strokes = &style.strokes;
    let mut halves = [0.0; 8];
    for (half, width) in halves.iter_mut().zip(strokes.widths()) {
        *half = half_px(width, rows);
    }
    let [a, b, c, d, rest @ ..] = halves;
    let gooch = &style.gooch;
    pack::Style {
        ink: linear(style.ink).extend(1.0).to_array(),
        paper: match style.paper {
            Paper::Color(color) => linear(color).extend(1.0).to_array(),
            Paper::Gradient | Paper::None => [0.0; 4],
        },
        gooch: [gooch.blue, gooch.yellow, gooch.of_cool, gooch.of_warm],
        stroke_halves: [[a, b, c, d], rest],
        // A smaller angle would treat rounding errors of normals as folds.
        crease_cos: strokes.crease_deg.max(1.0).to_radians().cos(),
        depth_px: strokes.depth_px,
        cap_light: style.cap.light,
        cap_relief: style.cap.relief,
        stroke_reach_px: reach_px(style, rows),
        fineness: fineness as f32,
        occlusion_surface: style.occlusion.surface,
        occlusion_cap: style.occlusion.cap,
        engraving: [style.engraving.across, style.engraving.across_dark].map(|across| {
            let across = Vec3::from(across).normalize_or(Vec3::X);
            let spacing_px = Style::px(style.engraving.spacing, rows);
            across.extend(spacing_px).to_array()
        }),
    }
}
