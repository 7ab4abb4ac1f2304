//! Borders: pairs of neighbouring samples that a stroke separates, each with the stroke's class and its position in the pixel. One pass
//! over the layers and one over the borders; 4 bytes a pixel each.

use super::pixels::Pixels;
use crate::passes::{SceneBuffers, tiles_in};
use crate::plan::{Binding, Clock, Plan, Resource, ResourceId};

/// Distance in pixels, along a border, within which others affect the position of its stroke; `RAMP` in `shaders/effects/strokes.wgsl`.
pub(super) const RAMP_PX: u32 = 16;

/// The borders of a frame, and the positions of their strokes.
#[derive(Clone, Copy, Debug)]
pub(super) struct StrokeBuffers {
    pub(super) borders: ResourceId,
    pub(super) strokes: ResourceId,
}

impl StrokeBuffers {
    /// Adds the buffers to the plan.
    pub(super) fn new(plan: &mut Plan, scene: &SceneBuffers<'_>) -> Self {
        let [borders, strokes] =
            ["borders", "strokes"].map(|name| per_pixel_and_tile(plan, scene, name));
        Self { borders, strokes }
    }

    /// Finds the borders and strokes in the layers of the frame; returns the stroke buffer.
    pub(super) fn find(
        self,
        plan: &mut Plan,
        pixels: Pixels<'_>,
        style: &Binding,
        layers: ResourceId,
    ) -> ResourceId {
        find_borders(plan, pixels, style, [layers, self.borders], "find borders");
        pixels.add_pass(
            plan,
            (
                "place strokes",
                "the staircase of borders along an edge gives its sub-pixel position",
            ),
            "effects/strokes.wgsl",
            vec![
                pixels.scene.frame.clone(),
                style.clone(),
                Binding::read("borders", self.borders),
                Binding::write("strokes", self.strokes),
            ],
        );
        self.strokes
    }
}

/// A buffer with one word per pixel, then one word per tile that is nonzero if the tile contains a border.
fn per_pixel_and_tile(plan: &mut Plan, scene: &SceneBuffers<'_>, name: &'static str) -> ResourceId {
    let tiles = tiles_in(scene.input.view.size_px);
    let bytes = (scene.input.pixel_count() + u64::from(tiles)) * 4;
    plan.add_resource(Resource::storage(name, bytes, Clock::Frame))
}

/// Finds the borders of the given layers, over the whole picture.
pub(super) fn borders_of(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    style: &Binding,
    layers: ResourceId,
    [name, pass]: [&'static str; 2],
) -> ResourceId {
    let borders = per_pixel_and_tile(plan, scene, name);
    find_borders(plan, Pixels::all(scene), style, [layers, borders], pass);
    borders
}

fn find_borders(
    plan: &mut Plan,
    pixels: Pixels<'_>,
    style: &Binding,
    [layers, borders]: [ResourceId; 2],
    pass: &'static str,
) {
    pixels.add_pass(
        plan,
        (
            pass,
            "strokes are drawn where neighbouring samples differ in kind, part, clip-surface, depth or fold",
        ),
        "effects/borders.wgsl",
        vec![
            pixels.scene.frame.clone(),
            style.clone(),
            Binding::read("layers", layers),
            Binding::write("borders", borders),
        ],
    );
}
