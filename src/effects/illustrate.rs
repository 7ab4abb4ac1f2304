//! Illustration: draws the picture in the style of the scene, by a pass over the layers and one for each effect that reads other pixels.
//!
//! Cannot: shade what layers do not contain, such as surfaces behind glass.

use super::FrameOutput;
use super::ambient::occlusion::occlusion;
use super::backdrop::backdrop;
use super::borders::StrokeBuffers;
use super::cap_materials::cap_materials;
use super::effect_tiles::EffectTiles;
use super::ghost;
use super::ground::ground;
use super::hatch::{hatch, zoom_of};
use super::pixels::Pixels;
use super::style_numbers::style_numbers;
use crate::passes::{SceneBuffers, overlap, picture};
use crate::plan::{Binding, Plan, ResourceId};
use crate::scene::style::{Paper, Shading};
use crate::shader::Shader;

/// Makes the picture of a frame from its layers.
pub(super) fn illustrate(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    layers: ResourceId,
) -> FrameOutput {
    let style = scene.input.model.prepared.style;
    let numbers = style_numbers(plan, scene);
    let picture = picture(plan, scene.input);
    let strokes = (style.strokes.widest() > 0.0).then(|| StrokeBuffers::new(plan, scene));
    let pixels = Pixels {
        scene,
        tiles: EffectTiles::find(plan, scene, &numbers, layers, (picture, strokes)),
    };
    let strokes = strokes.map(|strokes| strokes.find(plan, pixels, &numbers, layers));
    let visibility = occlusion(plan, pixels, layers);
    let lit = cap_materials(plan, pixels, (layers, picture));
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
            Some(_) => "lib/cap_materials/drawn.wgsl",
            None => "lib/cap_materials/none.wgsl",
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
    // A gradient, lighting and the absence of strokes need no style numbers.
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
    FrameOutput { layers, picture }
}

/// Path of the file that fills the open module `cutaway::shading`.
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
