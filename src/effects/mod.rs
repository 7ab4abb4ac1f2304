//! Effects: the last passes of every plan. They turn layers into a picture in the [`Style`](crate::scene::Style) of the scene, in the same
//! way for every strategy and for the exact reference.
//!
//! The plain style takes one pass, or none after the compute rasteriser, which colours pixels as it completes them. Any other style takes
//! the pass `illustrate`, after passes for effects that read neighbouring pixels. Each effect fills an open module, so a disabled effect
//! adds no pass, no binding and no instruction.

mod ambient;
mod backdrop;
mod borders;
mod cap_materials;
mod channels;
mod effect_tile_search;
mod effect_tiles;
mod ghost;
mod ground;
mod halo;
mod hatch;
mod hatch_lines;
mod illustrate;
mod pixels;
mod shade;
mod style_numbers;
mod vertex_paint;

pub(crate) use channels::{HATCH, STROKE};
pub(crate) use pixels::VISIBILITY;

use crate::passes::{Input, Lanes, Layered, Model, Refusal, SceneBuffers};
use crate::plan::{BufferRole, Capacities, Clock, Contents, Plan, Resource, ResourceId};
use crate::scene::View;

/// Output of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameOutput {
    /// Three words per pixel.
    pub layers: ResourceId,
    /// One RGBA8 word per pixel.
    pub picture: ResourceId,
}

/// Number of rows on each side of a band that the effects of a model read.
pub(crate) fn halo_rows(model: &Model, view: &View) -> u32 {
    let style = &model.prepared.style;
    let strokes = halo::halo_rows(style, view.band[1]);
    let of_style = strokes.max(ambient::occlusion::halo_rows(&style.occlusion, view));
    // Surfaces may take their vertex paints from the neighbouring pixel.
    of_style.max(u32::from(model.cap_materials.is_some()))
}

/// Adds the passes that make the picture.
pub(crate) fn finish(plan: &mut Plan, scene: &SceneBuffers<'_>, layered: Layered) -> FrameOutput {
    let Layered { layers, picture } = layered;
    match picture {
        Some(picture) => FrameOutput { layers, picture },
        None if scene.input.is_plain() => shade::shade(plan, scene, layers),
        None => illustrate::illustrate(plan, scene, layers),
    }
}

/// The plan that measures the effects of a style over external layers, given as words. Returns a refusal if the scene exceeds a limit.
pub(crate) fn channels_of(model: &Model, view: &View, layers: &[u32]) -> Result<Plan, Refusal> {
    let capacities = Capacities::UNKNOWN;
    let input = Input::new(model, view, &capacities)?;
    let mut plan = Plan::default();
    let (scene, layers) = over_layers(&mut plan, &input, layers)?;
    channels::channels(&mut plan, &scene, layers);
    Ok(plan.without_unused())
}

/// Adds the buffers of the scene, and the external layers, to a plan.
fn over_layers<'a>(
    plan: &mut Plan,
    input: &'a Input<'a>,
    layers: &[u32],
) -> Result<(SceneBuffers<'a>, ResourceId), Refusal> {
    let style = &input.model.prepared.style;
    let cap_materials = input.model.cap_materials.as_ref();
    let has_vertex_paints =
        cap_materials.is_some_and(|cap_materials| cap_materials.vertex_paints.is_some());
    let scene = match style.ghost.is_drawn() || has_vertex_paints {
        true => SceneBuffers::upload(plan, input, Lanes::none())?,
        // No pass of this plan reads vertices.
        false => SceneBuffers::unposed(plan, input, Lanes::none()),
    };
    let layers = Contents::from_values(layers);
    let layers = Resource::upload("layers", BufferRole::Storage, layers, Clock::Frame);
    Ok((scene, plan.add_resource(layers)))
}

/// The plan that makes a picture from external layers, for example those of the exact reference, given as words. Returns a refusal if the
/// scene exceeds a limit.
pub(crate) fn finish_of(model: &Model, view: &View, layers: &[u32]) -> Result<Plan, Refusal> {
    let capacities = Capacities::UNKNOWN;
    let input = Input::new(model, view, &capacities)?;
    let mut plan = Plan::default();
    let (scene, layers) = over_layers(&mut plan, &input, layers)?;
    let layered = Layered {
        layers,
        picture: None,
    };
    plan.picture = Some(finish(&mut plan, &scene, layered).picture);
    plan.layers = Some(layers);
    Ok(plan.without_unused())
}
