//! Effects as numbers: the contributions of strokes, hatches and light to each pixel, so that tests can check a picture. The shader modules
//! are the same as for the picture, but the plan of a picture does not contain these passes.

use super::ambient::occlusion::occlusion;
use super::borders::StrokeBuffers;
use super::hatch::{hatch, zoom_of};
use super::pixels::{Pixels, over_picture, per_pixel};
use super::style_numbers::style_numbers;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Plan, ResourceId};
use crate::shader::Shader;

/// Buffer with the fraction of each pixel that strokes cover, one f32 per pixel.
pub(crate) const STROKE: &str = "stroke_channel";
/// Four numbers per pixel: the fraction that hatch lines cover, two coordinates on the cap plane in scene units, and an unused number.
pub(crate) const HATCH: &str = "hatch_channel";

/// Adds passes that measure the effects of a style over layers.
pub(super) fn channels(plan: &mut Plan, scene: &SceneBuffers<'_>, layers: ResourceId) {
    let style = scene.input.model.prepared.style;
    let numbers = style_numbers(plan, scene);
    let stroke = (style.strokes.widest() > 0.0).then(|| {
        let strokes =
            StrokeBuffers::new(plan, scene).find(plan, Pixels::all(scene), &numbers, layers);
        let stroke = per_pixel(plan, scene, STROKE, 4);
        over_picture(
            plan,
            scene,
            (
                "measure strokes",
                "the share of each pixel that strokes cover",
            ),
            "effects/channels/stroke.wgsl",
            vec![
                scene.frame.clone(),
                Binding::write("stroke", stroke),
                numbers.clone(),
                Binding::read("strokes", strokes),
            ],
        );
        stroke
    });
    let hatch = hatch(plan, scene, &style).map(|tables| {
        let hatched = per_pixel(plan, scene, HATCH, 16);
        let mut bindings = vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            scene.parts.clone(),
            Binding::write("hatched", hatched),
            numbers.clone(),
        ];
        bindings.extend(tables);
        over_picture(
            plan,
            scene,
            (
                "measure hatches",
                "the share of each pixel that hatches cover",
            ),
            Shader::from("effects/channels/hatch.wgsl").with(zoom_of(&style.hatch)),
            bindings,
        );
        hatched
    });
    let visibility = occlusion(plan, Pixels::all(scene), layers);
    plan.channels = [stroke, hatch, visibility].into_iter().flatten().collect();
}
