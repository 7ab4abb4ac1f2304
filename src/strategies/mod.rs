//! Strategies: a cap surface and an inside test, and the plan they record together.
//!
//! A strategy never touches the GPU. Adding a cap surface or an inside test means a file under `surface/` or `inside/`, a folder of
//! shaders and a line in the [`table`].

pub mod inside;
pub mod surface;
pub mod table;

mod method;
mod name;
mod row;

pub use crate::passes::{Obstacle, Rasteriser, Refusal, ReliefWalk};
pub use method::{Means, Method};
pub use name::Strategy;
pub use row::{Abilities, CapSurface, CapSurfaceRow, Facts, InsideTest, InsideTestRow, Parameter};
pub(crate) use row::{Answers, Caps};

use std::fmt::Display;

use crate::passes::{Model, Recorder};
use crate::plan::{Capacities, Plan};
use crate::scene::{HeightFilter, View};

/// The plan of a frame by a method.
///
/// The plan is the minimum for the scene and the view: where nothing is cut, it is the same for every method, and the GPU's own rasteriser
/// draws.
///
/// # Errors
///
/// What of the scene the method does not draw.
pub fn record(
    model: &Model,
    view: &View,
    method: impl Into<Method>,
    capacities: &Capacities,
) -> Result<Plan, Refusal> {
    let Method { strategy, means } = method.into();
    let rasteriser = means.rasteriser.unwrap_or_default();
    if rasteriser == Rasteriser::Compute && !strategy.can().compute {
        return Err(Refusal::new(
            Obstacle::Rasteriser,
            format!(
                "the compute rasteriser draws no caps, peels no sprite and has no stencil: {strategy} is drawn by the hardware \
                 rasteriser alone"
            ),
        ));
    }
    let mut recorder = Recorder::new(model, view)?;
    recorder.wide_atomics = means.wide_atomics.unwrap_or(false);
    recorder.relief_walk = means.relief_walk;
    recorder.height_filter = means.height_filter.unwrap_or_default();
    recorder.keeps_pyramids = capacities.pyramids;
    must_be_able(&recorder, strategy)?;
    recorder.pose_parts()?;
    if recorder.relevance.lanes == 0 {
        recorder.draw_plain_parts(false);
        recorder.gather();
    } else {
        record_cut(&mut recorder, strategy, rasteriser, capacities)?;
    }
    recorder.shade();
    Ok(recorder.plan)
}

/// The plan where a cut opens some part.
fn record_cut(
    recorder: &mut Recorder<'_>,
    strategy: Strategy,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), Refusal> {
    let Strategy { surface, inside } = strategy;
    let Some(inside) = inside else {
        return match surface.row().caps {
            Caps::Alone(record) => record(recorder, rasteriser, capacities),
            _ => Err(unpaired(surface, "does not know what is inside")),
        };
    };
    match (surface.row().caps, inside.row().answers) {
        (Caps::Alone(_), _) => Err(unpaired(surface, "knows by itself what is inside")),
        (_, Answers::Rays(record)) => {
            record(recorder, surface, inside.steps(), rasteriser, capacities)
        }
        (Caps::Rays(_), Answers::Points(images)) => {
            let resolution = inside.steps();
            inside::probed(
                recorder, surface, images, resolution, rasteriser, capacities,
            )
        }
        (Caps::Triangles(tessellate), Answers::Points(images)) => surface::paper::record(
            recorder,
            |recorder| tessellate(recorder, surface.steps(), true, capacities),
            |recorder| images(recorder, inside.steps(), rasteriser, capacities),
        ),
    }
}

/// The refusal of a cap surface or an inside test that is asked for with another.
fn unpaired(who: impl Display, what: &str) -> Refusal {
    Refusal::new(Obstacle::Pairing, format!("{who} {what}"))
}

/// Refuses what of the scene is more than the strategy knows of.
fn must_be_able(recorder: &Recorder<'_>, strategy: Strategy) -> Result<(), Refusal> {
    let can = strategy.can();
    let refuse = |obstacle, reason: String| Err(Refusal::new(obstacle, reason));
    if !can.nonzero && recorder.has_nonzero() {
        let who = strategy
            .inside
            .map_or_else(|| strategy.to_string(), |i| i.to_string());
        return refuse(
            Obstacle::Nonzero,
            format!("{who} knows parity alone, and a part that is cut has fill = \"nonzero\""),
        );
    }
    if !can.overlaps && recorder.shows_overlaps() {
        return refuse(
            Obstacle::Overlaps,
            format!(
                "{strategy} draws the caps of each part by themselves and does not tell where solids overlap"
            ),
        );
    }
    if !can.cutters && recorder.has_cutters() {
        let why = match strategy.is_by_the_papers_rule() {
            true => {
                "draws each clip-surface by itself, with no list of crossings to put its faces in"
            }
            false => "cuts by planes alone",
        };
        return refuse(
            Obstacle::Cutters,
            format!(
                "a cut has a closed mesh for a volume, and {strategy} {why}: name raycast, grid or adaptive with mask, stencil, \
                 abuffer or kbuffer, or raycast with vds or ldi"
            ),
        );
    }
    heights_must_be_read(recorder, strategy.surface)?;
    let (prepared, surfaces) = (&recorder.model.prepared, &recorder.relevance.surfaces);
    let relief = surfaces.iter().find(|s| recorder.model.is_relief(**s));
    if let (false, Some(number)) = (can.reliefs, relief) {
        let cut = &prepared.cuts[prepared.surfaces[*number].cut].name;
        return refuse(
            Obstacle::Reliefs,
            format!(
                "{strategy} cuts by planes, and clip-surface {number} of cut `{cut}` has a relief"
            ),
        );
    }
    if !can.surfaces && surfaces.len() > 1 {
        let count = surfaces.len();
        return refuse(
            Obstacle::Surfaces,
            format!("{strategy} cuts by one plane, and {count} clip-surfaces meet the parts"),
        );
    }
    Ok(())
}

/// Refuses reliefs that cannot be read as the means say.
fn heights_must_be_read(recorder: &Recorder<'_>, surface: CapSurface) -> Result<(), Refusal> {
    if recorder.height_filter == HeightFilter::Exact || !recorder.has_reliefs() {
        return Ok(());
    }
    let reason = match surface.row().exact_heights {
        // What cuts by planes alone says so itself.
        "" => recorder.unfiltered(),
        why => Some(format!(
            "{surface} {why} and asks no sampler for heights: height_filter = \"hardware\" is for grid"
        )),
    };
    match reason {
        Some(reason) => Err(Refusal::new(Obstacle::HeightFilter, reason)),
        None => Ok(()),
    }
}
