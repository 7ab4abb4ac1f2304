//! Horizon-based occlusion: the fraction of sky above the visible surroundings of a pixel (Jimenez, Wu, Pesce and Jarabo 2016).
//!
//! Two passes, 8 bytes a pixel. A search costs slices x steps x 2 layer samples and slices x 2 arc cosines.
//!
//! Cannot: see geometry that is hidden or outside the picture, so the model is too light near the picture's border.

use crate::effects::pixels::{Pixels, numbers, per_pixel};
use crate::plan::{Binding, Plan, ResourceId, pack};
use crate::scene::View;
use crate::scene::style::Occlusion;

/// Greatest distance of a sample, in thousandths of the picture's height; near the eye, the radius alone could span the whole height.
const REACH: f64 = 160.0;
/// Greatest distance of a sample in pixels: bands of large pictures must fit the binding limits of core WebGPU.
const MOST_REACH_PX: f64 = 512.0;
/// Radius in pixels of the filter that averages over the sampling pattern.
pub(in crate::effects) const SMOOTH_PX: u32 = 2;

/// Computes the fraction of the sky that is visible from the point of each pixel.
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
            "a point sees the sky above the highest samples around it",
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
            "averages over the rotation pattern of the search",
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

/// Number of rows on each side of a band that these passes read.
pub(in crate::effects) fn halo_rows(view: &View) -> u32 {
    reach_px(view).ceil() as u32 + SMOOTH_PX + 1
}
