//! Occlusion: one number per pixel, the visible fraction of the sky, computed by the methods that the style selects.

use super::{horizon, relief_sky, unsharp};
use crate::effects::pixels::{Pixels, VISIBILITY};
use crate::plan::{Plan, ResourceId};
use crate::scene::View;
use crate::scene::style::{Occlusion, OcclusionKind};

/// Fraction of the light that reaches each pixel, one f32 per pixel; none if the style has no occlusion.
pub(in crate::effects) fn occlusion(
    plan: &mut Plan,
    pixels: Pixels<'_>,
    layers: ResourceId,
) -> Option<ResourceId> {
    let scene = pixels.scene;
    let style = &scene.input.model.prepared.style.occlusion;
    let relieved = relief_sky::is_drawn(scene);
    let name = if relieved { "open_sky" } else { VISIBILITY };
    let found = match style.kind {
        _ if !style.is_drawn() => None,
        OcclusionKind::None => None,
        OcclusionKind::Horizon => Some(horizon::horizon(plan, pixels, (style, name), layers)),
        OcclusionKind::Unsharp => Some(unsharp::unsharp(plan, scene, (style, name), layers)),
    };
    match relieved {
        true => Some(relief_sky::relief_sky(plan, pixels, layers, found)),
        false => found,
    }
}

/// Number of rows on each side of a band that these passes read.
pub(in crate::effects) fn halo_rows(style: &Occlusion, view: &View) -> u32 {
    match style.kind {
        _ if !style.is_drawn() => 0,
        OcclusionKind::None => 0,
        OcclusionKind::Horizon => horizon::halo_rows(view),
        OcclusionKind::Unsharp => unsharp::reach_px(style, view) as u32,
    }
}
