//! Inside tests.
//!
//! Ray tests record the frame of a cap surface themselves. Point tests record images, which are sampled here at every crossing of the
//! camera's rays, or by the paper's rule ([`paper`](super::surface::paper)) at every cap fragment.

pub(crate) mod abuffer;
pub(crate) mod kbuffer;
pub(crate) mod ldi;
pub(crate) mod mask;
pub(crate) mod stencil;
pub(crate) mod vds;
pub(crate) mod winding;

use std::ops::Range;

use super::row::CapSurface;
use super::surface;
use crate::effects::{FrameOutput, finish};
use crate::passes::{
    Crossings, Input, Inside, Lanes, NearestKept, Refusal, SceneBuffers, Store, Volume, over_mesh,
    resolve,
};
use crate::plan::{Binding, Plan, ResourceId};

/// Lists crossings, at most `capacity` per pixel, and draws the mesh with fragments that store nothing, for an inside test that uses other
/// data or draws the mesh again. Its mask starts empty.
fn leaving_nothing(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    surface: CapSurface,
    capacity: u32,
    mask: ResourceId,
) -> Result<(Crossings, NearestKept), Refusal> {
    let emptied = Store::nothing(vec![Binding::write("mask", mask)]);
    let crossings = surface::list(plan, scene, surface, capacity, &emptied)?;
    let store = Store::nothing(Vec::new());
    let nearest = over_mesh(plan, scene, &store, &crossings.asked())?;
    Ok((crossings, nearest))
}

/// Records the frame of listed crossings with the volume images that `images` makes, each with the part-table indices that it covers.
pub(super) fn probed(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    images: impl FnOnce(&mut Plan, &SceneBuffers<'_>) -> Result<Vec<(Range<usize>, Volume)>, Refusal>,
) -> Result<FrameOutput, Refusal> {
    let capacity = surface::capacity(input);
    let scene = SceneBuffers::upload(plan, input, Lanes::of_bits(input, capacity))?;
    let images = images(plan, &scene)?;
    let mask = scene.lanes.reduced_mask(plan, input);
    let (crossings, nearest) = leaving_nothing(plan, &scene, surface, capacity, mask)?;
    for (places, volume) in images {
        volume.probe(plan, &scene, places, mask, &crossings);
    }
    let inside = Inside::mask(mask);
    let layered = resolve(plan, &scene, nearest, inside, &crossings.asked());
    Ok(finish(plan, &scene, layered))
}
