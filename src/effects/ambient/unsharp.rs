//! Occlusion as an unsharp mask of depth (Luft, Colditz and Deussen 2006; Trapp and Döllner 2013, 4.5).
//!
//! Two passes, 8 bytes a pixel; a separable Gaussian out to three standard deviations, rows first.
//!
//! Cannot: darken narrow gaps between surfaces of equal depth.

use crate::effects::pixels::{numbers, over_picture, per_pixel};
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Plan, ResourceId, pack};
use crate::scene::View;
use crate::scene::style::Occlusion;

/// Computes the fraction of light that reaches each pixel.
pub(in crate::effects) fn unsharp(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    (style, name): (&Occlusion, &'static str),
    layers: ResourceId,
) -> ResourceId {
    let view = scene.input.view;
    let unsharp = pack::Unsharp {
        diagonal: 2.0 * scene.input.model.prepared.bounds.radius() as f32,
        sigma_px: sigma_px(style, view) as f32,
        reach_px: reach_px(style, view),
        strength: style.strength,
    };
    let numbers = numbers(plan, "unsharp", unsharp);
    let blurred = per_pixel(plan, scene, "blurred_depth", 4);
    over_picture(
        plan,
        scene,
        ("blur depth", "depth, blurred along rows"),
        "effects/unsharp/across.wgsl",
        vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            Binding::write("blurred", blurred),
            numbers.clone(),
        ],
    );
    let visibility = per_pixel(plan, scene, name, 4);
    over_picture(
        plan,
        scene,
        (
            "mask depth",
            "surfaces deeper than the blurred depth around them get less light",
        ),
        "effects/unsharp/down.wgsl",
        vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            Binding::read("blurred", blurred),
            Binding::write("visibility", visibility),
            numbers,
        ],
    );
    visibility
}

/// Standard deviation in pixels; the style gives it relative to the size of the whole picture.
fn sigma_px(style: &Occlusion, view: &View) -> f64 {
    let size = [view.size_px[0], view.band[1]].map(f64::from);
    f64::from(style.blur_percent) / 100.0 * size[0].hypot(size[1])
}

/// Number of rows on each side of a band that these passes read.
pub(in crate::effects) fn reach_px(style: &Occlusion, view: &View) -> i32 {
    (3.0 * sigma_px(style, view)).ceil() as i32
}
