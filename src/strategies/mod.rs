//! Strategies: a cap surface and an inside test, and the plan that they record together.
//!
//! A strategy never touches the GPU. Adding a cap surface or an inside test means a file under `surface/` or `inside/`, a folder of
//! shaders and a line in the [`table`].

pub(crate) mod inside;
pub(crate) mod surface;
pub mod table;

mod auto;
mod method;
mod name;
mod row;

pub use crate::passes::{Rasteriser, Refusal, ReliefWalk, Unsupported};
pub use auto::{AUTO, AdapterTraits, Choice, choose, open_parts_in_words};
pub use method::{DrawOptions, Method};
pub use name::Strategy;
use row::unpaired;
pub use row::{
    Abilities, CapSurface, CapSurfaceRow, InsideTest, InsideTestRow, StrategyInfo,
    StrategyParameter,
};
pub(crate) use row::{Caps, InsideTestKind};

use crate::effects::{FrameOutput, finish};
use crate::passes::{
    CrossingSource, Input, Inside, Lanes, Model, SceneBuffers, Store, Surfaces, gather, over_mesh,
    resolve,
};
use crate::plan::{Capacities, CpuWork, Plan, Recorded};
use crate::scene::{HeightFilter, View};

/// The plan of a frame by a method.
///
/// The plan is the minimum for the scene and the view: an uncut frame has the same plan for every method, and the hardware rasteriser draws
/// it.
///
/// # Errors
///
/// Returns an error if the scene has features that the method cannot draw.
pub fn plan(
    model: &Model,
    view: &View,
    method: impl Into<Method>,
    capacities: &Capacities,
) -> Result<Plan, Refusal> {
    record(model, view, method, capacities).map(|recorded| recorded.plan)
}

/// The plan together with the CPU work spent on recording it.
///
/// # Errors
///
/// As [`plan`].
pub fn record(
    model: &Model,
    view: &View,
    method: impl Into<Method>,
    capacities: &Capacities,
) -> Result<Recorded, Refusal> {
    let Method { strategy, options } = method.into();
    let rasteriser = options.rasteriser.unwrap_or_default();
    if rasteriser == Rasteriser::Compute && !strategy.can().compute {
        return Err(Refusal::new(
            Unsupported::Rasteriser,
            format!(
                "the compute rasteriser draws no caps, peels no sprite and has no stencil: {strategy} is drawn by the hardware \
                 rasteriser alone"
            ),
        ));
    }
    let view = &View {
        precision: options.precision(),
        ..*view
    };
    let input = Input {
        rasteriser,
        wide_atomics: options.wide_atomics.unwrap_or(false),
        relief_walk: options.relief_walk,
        keeps_list: options.list.unwrap_or(false),
        height_filter: options.height_filter.unwrap_or_default(),
        ..Input::new(model, view, capacities)?
    };
    must_be_able(&input, strategy)?;
    let mut plan = Plan::default();
    let (picture, on_cpu) = match input.active_cuts.lanes {
        0 => (record_uncut(&mut plan, &input)?, Vec::new()),
        _ => record_cut(&mut plan, &input, strategy)?,
    };
    plan.layers = Some(picture.layers);
    plan.picture = Some(picture.picture);
    Ok(Recorded {
        plan: plan.without_unused(),
        on_cpu,
    })
}

/// The plan of an uncut frame by a rasteriser: the baseline for the cost of a cut.
///
/// # Errors
///
/// Refuses scenes with cuts, or with more parts than the compute rasteriser can draw.
pub(crate) fn record_uncut_by(
    model: &Model,
    view: &View,
    (rasteriser, wide_atomics): (Rasteriser, bool),
    capacities: &Capacities,
) -> Result<Recorded, Refusal> {
    let input = Input {
        rasteriser,
        wide_atomics,
        ..Input::new(model, view, capacities)?
    };
    let mut plan = Plan::default();
    let picture = match rasteriser {
        Rasteriser::Hardware => record_uncut(&mut plan, &input)?,
        Rasteriser::Compute => sweep_uncut(&mut plan, &input)?,
    };
    plan.layers = Some(picture.layers);
    plan.picture = Some(picture.picture);
    Ok(Recorded {
        plan: plan.without_unused(),
        on_cpu: Vec::new(),
    })
}

/// The passes of the compute rasteriser if no cut opens a part.
fn sweep_uncut(plan: &mut Plan, input: &Input<'_>) -> Result<FrameOutput, Refusal> {
    let scene = SceneBuffers::upload(plan, input, Lanes::none())?;
    let crossings = CrossingSource::none();
    let nearest = over_mesh(plan, &scene, &Store::nothing(Vec::new()), &crossings)?;
    let layered = resolve(plan, &scene, nearest, Inside::unasked(), &crossings);
    Ok(finish(plan, &scene, layered))
}

/// The passes if no cut opens a part.
fn record_uncut(plan: &mut Plan, input: &Input<'_>) -> Result<FrameOutput, Refusal> {
    let scene = SceneBuffers::upload(plan, input, Lanes::none())?;
    let mut surfaces = Surfaces::new(plan, &scene);
    surfaces.draw_plain_parts(plan, &scene, false);
    let layered = gather(plan, &scene, &surfaces);
    Ok(finish(plan, &scene, layered))
}

/// The passes if a cut opens at least one part.
fn record_cut(
    plan: &mut Plan,
    input: &Input<'_>,
    strategy: Strategy,
) -> Result<(FrameOutput, Vec<CpuWork>), Refusal> {
    let Strategy { surface, inside } = strategy;
    let Some(inside) = inside else {
        return match surface.row().caps {
            Caps::Alone(record) => record(plan, input),
            _ => Err(unpaired(surface, "needs an inside test")),
        };
    };
    let steps = inside.steps();
    let picture = match (surface.row().caps, inside.row().answers) {
        (Caps::Alone(_), _) => Err(unpaired(surface, "takes no inside test")),
        (_, InsideTestKind::Rays(record)) => record(plan, input, surface, steps),
        (Caps::Rays(_), InsideTestKind::Points(images)) => {
            inside::probed(plan, input, surface, |plan, scene| {
                images(plan, scene, steps)
            })
        }
        (Caps::Triangles(tessellate), InsideTestKind::Points(images)) => surface::paper::record(
            plan,
            input,
            |plan, scene| tessellate(plan, scene, surface.steps(), true),
            |plan, scene| images(plan, scene, steps),
        ),
    };
    Ok((picture?, Vec::new()))
}

/// Refuses features of the scene that the strategy cannot draw.
fn must_be_able(input: &Input<'_>, strategy: Strategy) -> Result<(), Refusal> {
    let can = strategy.can();
    let refuse = |unsupported, reason: String| Err(Refusal::new(unsupported, reason));
    if !can.nonzero && input.has_nonzero() {
        let who = strategy
            .inside
            .map_or_else(|| strategy.to_string(), |i| i.to_string());
        return refuse(
            Unsupported::Nonzero,
            format!("{who} supports only parity, and a cut part has fill = \"nonzero\""),
        );
    }
    if !can.overlaps && input.shows_overlaps() {
        return refuse(
            Unsupported::Overlaps,
            format!(
                "{strategy} draws the caps of each part separately and does not tell where solids overlap"
            ),
        );
    }
    if !can.cutters && input.has_cutters() {
        let why = match strategy.is_by_the_papers_rule() {
            true => {
                "draws each clip-surface by itself, without a list of crossings for the faces of the mesh"
            }
            false => "cuts only by planes",
        };
        return refuse(
            Unsupported::Cutters,
            format!(
                "the volume of a cut is a closed mesh, and {strategy} {why}: name raycast, grid or adaptive with mask, stencil, \
                 abuffer or kbuffer, or raycast with vds or ldi"
            ),
        );
    }
    heights_must_be_read(input, strategy.surface)?;
    let (prepared, surfaces) = (&input.model.prepared, &input.active_cuts.surfaces);
    let relief = surfaces.iter().find(|s| input.model.is_relief(**s));
    if let (false, Some(number)) = (can.reliefs, relief) {
        let cut = &prepared.cuts[prepared.surfaces[*number].cut].name;
        return refuse(
            Unsupported::Reliefs,
            format!(
                "{strategy} cuts by planes, and clip-surface {number} of cut `{cut}` has a relief"
            ),
        );
    }
    if !can.surfaces && surfaces.len() > 1 {
        let count = surfaces.len();
        return refuse(
            Unsupported::Surfaces,
            format!("{strategy} cuts by one plane, and {count} clip-surfaces meet the parts"),
        );
    }
    Ok(())
}

/// Refuses reliefs that the requested height filter cannot read.
fn heights_must_be_read(input: &Input<'_>, surface: CapSurface) -> Result<(), Refusal> {
    if input.height_filter == HeightFilter::Exact || !input.has_reliefs() {
        return Ok(());
    }
    let reason = match surface.row().exact_heights {
        // Strategies that cut only by planes refuse reliefs themselves.
        "" => input.unfiltered(),
        why => Some(format!(
            "{surface} {why} and asks no sampler for heights: height_filter = \"hardware\" is for grid"
        )),
    };
    match reason {
        Some(reason) => Err(Refusal::new(Unsupported::HeightFilter, reason)),
        None => Ok(()),
    }
}
