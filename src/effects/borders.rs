//! Borders: between which neighbouring samples a stroke belongs, and of what class; and where in the pixel the stroke is. One pass over the
//! layers and one over the borders; 4 bytes a pixel each.

use super::pixels::over_pixels;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Clock, Plan, Resource, ResourceId};

/// Pixels along the side of a tile, which has a word that says whether any border is in it.
const TILE: u32 = 16;

/// How far along a border those are that say where its stroke is; `RAMP` in `shaders/effects/strokes.wgsl`.
pub(super) const RAMP_PX: u32 = 16;

/// Finds the borders of the layers of the frame, and where their strokes are.
pub(super) fn strokes(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Binding,
    layers: ResourceId,
) -> ResourceId {
    let borders = borders_of(plan, scene, style, layers, ["borders", "find borders"]);
    let strokes = per_pixel_and_tile(plan, scene, "strokes");
    over_pixels(
        plan,
        scene,
        (
            "place strokes",
            "the staircase of borders along an edge tells where in the pixels the edge is",
        ),
        "effects/strokes.wgsl",
        vec![
            scene.frame.clone(),
            style.clone(),
            Binding::read("borders", borders),
            Binding::write("strokes", strokes),
        ],
    );
    strokes
}

/// A buffer of a word for each pixel and for each tile.
fn per_pixel_and_tile(plan: &mut Plan, scene: &SceneBuffers<'_>, name: &'static str) -> ResourceId {
    let tiles: u64 = (scene.input.view.size_px.iter())
        .map(|pixels| u64::from(pixels.div_ceil(TILE)))
        .product();
    let bytes = (scene.input.pixel_count() + tiles) * 4;
    plan.add_resource(Resource::storage(name, bytes, Clock::Frame))
}

/// Finds the borders of some layers, under the names of a buffer and a pass.
pub(super) fn borders_of(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Binding,
    layers: ResourceId,
    [name, pass]: [&'static str; 2],
) -> ResourceId {
    let borders = per_pixel_and_tile(plan, scene, name);
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
