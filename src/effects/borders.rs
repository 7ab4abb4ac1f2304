//! Borders: between which neighbouring samples a stroke belongs, and of what class. One pass over the layers; 4 bytes a pixel.

use super::pixels::over_pixels;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Clock, Plan, Resource, ResourceId};

/// Pixels along the side of a tile, which has a word that says whether any border is in it.
const TILE: u32 = 16;

/// Finds the borders of the layers of the frame.
pub(super) fn borders(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Binding,
    layers: ResourceId,
) -> ResourceId {
    borders_of(plan, scene, style, layers, ["borders", "find borders"])
}

/// Finds the borders of some layers, under the names of a buffer and a pass.
pub(super) fn borders_of(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Binding,
    layers: ResourceId,
    [name, pass]: [&'static str; 2],
) -> ResourceId {
    let tiles: u64 = (scene.input.view.size_px.iter())
        .map(|pixels| u64::from(pixels.div_ceil(TILE)))
        .product();
    let bytes = (scene.input.pixel_count() + tiles) * 4;
    let borders = plan.add_resource(Resource::storage(name, bytes, Clock::Frame));
    over_pixels(
        plan,
        scene,
        (
            pass,
            "strokes are drawn where neighbouring samples differ in kind, part, clip-surface, depth or fold",
        ),
        "effects/borders.wgsl",
        vec![
            scene.frame.clone(),
            style.clone(),
            Binding::read("layers", layers),
            Binding::write("borders", borders),
        ],
    );
    borders
}
