//! Illustration: a picture as a style asks, by one pass over the layers and one for each effect that looks at neighbours.
//!
//! Cannot: shade what layers do not have, such as what is behind glass.

use glam::Vec3;

use super::Picture;
use super::borders::{RAMP_PX, Strokes};
use super::dress::dress;
use super::effect_tiles::EffectTiles;
use super::ghost;
use super::ground::ground;
use super::hatch::{hatch, zoom_of};
use super::occlusion::occlusion;
use super::pixels::{self, Pixels};
use super::relief_sky;
use crate::passes::{SceneBuffers, overlap, picture};
use crate::plan::{Binding, Plan, ResourceId, pack};
use crate::scene::style::{Paper, Shading, Style};
use crate::scene::{View, linear_from_srgb, map_channels};
use crate::shader::Shader;

/// The widest strokes have 32 pixels.
const MOST_HALF_PX: f32 = 16.0;

/// Makes the picture.
pub(super) fn illustrate(plan: &mut Plan, scene: &SceneBuffers<'_>, layers: ResourceId) -> Picture {
    let style = scene.input.model.prepared.style;
    let numbers = style_numbers(plan, scene);
    let picture = picture(plan, scene.input);
    let strokes = (style.strokes.widest() > 0.0).then(|| Strokes::new(plan, scene));
    let pixels = Pixels {
        scene,
        tiles: EffectTiles::find(plan, scene, &numbers, layers, (picture, strokes)),
    };
    let strokes = strokes.map(|strokes| strokes.find(plan, pixels, &numbers, layers));
    let visibility = occlusion(plan, pixels, layers);
    let lit = dress(plan, pixels, (layers, picture));
    let mut bindings = vec![
        scene.frame.clone(),
        scene.parts.clone(),
        Binding::read("layers", lit.unwrap_or(layers)),
        match lit {
            Some(_) => Binding::update("picture", picture),
            None => Binding::write("picture", picture),
        },
    ];
    let overlap = overlap(plan, scene.input, &mut bindings);
    let mut shader = Shader::from("effects/illustrate.wgsl")
        .with(overlap)
        .with(match lit {
            Some(_) => "lib/dress/drawn.wgsl",
            None => "lib/dress/none.wgsl",
        })
        .with(shading(style.shading))
        .with(match style.shading {
            Shading::Engraved => "lib/surface_pattern/engraving.wgsl",
            _ => "lib/surface_pattern/plain.wgsl",
        })
        .with(backdrop(style.paper));
    let hatch = hatch(plan, scene, &style);
    shader = match &hatch {
        Some(_) => shader
            .with("lib/cap_pattern/hatch.wgsl")
            .with(zoom_of(&style.hatch)),
        None => shader.with("lib/cap_pattern/plain.wgsl"),
    };
    shader = match strokes {
        Some(strokes) => {
            bindings.push(Binding::read("strokes", strokes));
            shader.with("lib/strokes/drawn.wgsl")
        }
        None => shader.with("lib/strokes/none.wgsl"),
    };
    shader = match visibility {
        Some(visibility) => {
            bindings.push(Binding::read("visibility", visibility));
            shader.with("lib/occlusion/drawn.wgsl")
        }
        None => shader.with("lib/occlusion/none.wgsl"),
    };
    // Gradient, light and no strokes ask for no number of the style.
    let reads_style = strokes.is_some()
        || hatch.is_some()
        || visibility.is_some()
        || style.paper != Paper::Gradient
        || matches!(
            style.shading,
            Shading::Calm | Shading::Gooch | Shading::Engraved
        );
    if reads_style {
        bindings.push(numbers.clone());
    }
    bindings.extend(hatch.into_iter().flatten());
    let about = ("illustrate", "the style turns layers into a picture");
    pixels.add_pass(plan, about, shader, bindings);
    ground(plan, scene, (layers, picture));
    ghost::ghost(plan, scene, &numbers, (layers, picture));
    Picture { layers, picture }
}

/// The numbers of the style, as a binding.
pub(super) fn style_numbers(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Binding {
    let style = &scene.input.model.prepared.style;
    let mut numbers = numbers(style, scene.input.view);
    if relief_sky::is_drawn(scene) {
        // How much of it caps have is in what was found.
        numbers.occlusion_cap = 1.0;
    }
    pixels::numbers(plan, "style", numbers)
}

/// How many rows around a band are looked at, of a picture of so many.
pub(super) fn halo_rows(style: &Style, rows: u32) -> u32 {
    let of_strokes = match style.strokes.widest() > 0.0 {
        // Beyond a stroke's reach those borders say where it is that lead to it, and two samples around them what they are.
        true => reach_px(style, rows) as u32 + RAMP_PX + 4,
        false => 0,
    };
    of_strokes.max(ghost::halo_rows(style, rows))
}

/// The file that fills `cutaway::backdrop`.
pub(super) fn backdrop(paper: Paper) -> &'static str {
    match paper {
        Paper::Gradient => "lib/backdrop/gradient.wgsl",
        Paper::Color(_) | Paper::None => "lib/backdrop/paper.wgsl",
    }
}

/// The file that fills `cutaway::shading`.
fn shading(shading: Shading) -> &'static str {
    match shading {
        Shading::Lit => "lib/shading/lit.wgsl",
        Shading::Calm => "lib/shading/calm.wgsl",
        Shading::Flat => "lib/shading/flat.wgsl",
        Shading::Gooch => "lib/shading/gooch.wgsl",
        Shading::Toon => "lib/shading/toon.wgsl",
        Shading::Clay => "lib/shading/clay.wgsl",
        Shading::Engraved => "lib/shading/engraved.wgsl",
    }
}

/// How many pixels away a border may be whose stroke is seen.
pub(super) fn reach_px(style: &Style, rows: u32) -> i32 {
    (half_px(style.strokes.widest(), rows)).ceil() as i32 + 1
}

/// Half the width of a stroke in pixels: its cost grows with the square, and wider ones are cut.
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
        crease_cos: strokes.crease_deg.to_radians().cos(),
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
