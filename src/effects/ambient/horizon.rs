//! Occlusion by horizons: the share of the sky over what the picture shows around a pixel (Jimenez, Wu, Pesce and Jarabo 2016).
//!
//! Two passes, 8 bytes a pixel. A search costs slices x steps x 2 samples of layers and as many arc cosines as slices x 2.
//!
//! Cannot: see what is hidden or outside of the picture, so that a model at its border is lighter there.

use crate::effects::pixels::{Pixels, numbers, per_pixel};
use crate::plan::{Binding, Plan, ResourceId, pack};
use crate::scene::View;
use crate::scene::style::Occlusion;

/// The farthest sample, in thousandths of the picture's height: near the eye a radius would be the whole height.
const REACH: f64 = 160.0;
/// And in pixels: bands of large pictures are to fit devices that bind no more than core WebGPU asks for.
const MOST_REACH_PX: f64 = 512.0;
/// Radius of the mean over the pattern.
pub(in crate::effects) const SMOOTH_PX: u32 = 2;

/// Finds what of the sky each pixel sees.
pub(in crate::effects) fn horizon(
    plan: &mut Plan,
    pixels: Pixels<'_>,
    (style, name): (&Occlusion, &'static str),
    layers: ResourceId,
) -> ResourceId {
    let scene = pixels.scene;
    let diagonal = 2.0 * scene.input.model.prepared.bounds.radius();
    let horizon = pack::Horizon {
        radius: (f64::from(style.radius_percent) / 100.0 * diagonal) as f32,
        reach_px: reach_px(scene.input.view) as f32,
        slices: style.slices,
        steps: style.steps,
    };
    let numbers = numbers(plan, "horizon", horizon);
    let sky = per_pixel(plan, scene, "sky", 4);
    pixels.add_pass(
        plan,
        (
            "find horizons",
            "the sky that a point sees lies over the highest samples around it",
        ),
        "effects/horizon/find.wgsl",
        vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            Binding::write("sky", sky),
            numbers,
        ],
    );
    let visibility = per_pixel(plan, scene, name, 4);
    pixels.add_pass(
        plan,
        (
            "smooth occlusion",
            "the mean over the pattern by which the search was turned",
        ),
        "effects/horizon/smooth.wgsl",
        vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            Binding::read("sky", sky),
            Binding::write("visibility", visibility),
        ],
    );
    visibility
}

fn reach_px(view: &View) -> f64 {
    (REACH / 1000.0 * f64::from(view.band[1])).min(MOST_REACH_PX)
}

/// Rows around a band that are read.
pub(in crate::effects) fn halo_rows(view: &View) -> u32 {
    reach_px(view).ceil() as u32 + SMOOTH_PX + 1
}
