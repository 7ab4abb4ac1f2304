//! Strategies: a cap surface and an inside test, and the plan they record together.
//!
//! A strategy never touches the GPU. Adding one means a file under `surface/` or `inside/`, a folder of shaders and an arm in
//! `record_cut`.

pub mod inside;
pub mod surface;

mod method;
mod name;

pub use crate::passes::{Rasteriser, ReliefWalk};
pub use method::{Means, Method};
pub use name::{CapSurface, InsideTest, Strategy, Tau};

use crate::passes::{Model, Recorder};
use crate::plan::{Capacities, Plan};
use crate::scene::{HeightFilter, View};

/// Why a strategy does not draw a scene: data, which an experiment can expect.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{strategy} refuses: {reason}")]
pub struct Refusal {
    /// Name of the strategy.
    pub strategy: String,
    /// Why.
    pub reason: String,
}

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
    let strategy = &strategy;
    let refuse = |reason: String| Refusal {
        strategy: strategy.to_string(),
        reason,
    };
    let rasteriser = means.rasteriser.unwrap_or_default();
    let needs_targets = strategy.is_by_the_papers_rule()
        || matches!(
            strategy.inside,
            InsideTest::Vds { .. } | InsideTest::Stencil
        );
    if rasteriser == Rasteriser::Compute && needs_targets {
        return Err(refuse(format!(
            "the compute rasteriser draws no caps, peels no sprite and has no stencil: {strategy} is drawn by the hardware \
             rasteriser alone"
        )));
    }
    let mut recorder = Recorder::new(model, view).map_err(refuse)?;
    recorder.wide_atomics = means.wide_atomics.unwrap_or(false);
    recorder.relief_walk = means.relief_walk;
    recorder.height_filter = means.height_filter.unwrap_or_default();
    recorder.keeps_pyramids = capacities.pyramids;
    if let Some(reason) = beyond(&recorder, strategy) {
        return Err(refuse(reason));
    }
    recorder.pose_parts().map_err(refuse)?;
    if recorder.relevance.lanes == 0 {
        recorder.draw_plain_parts(false);
        recorder.gather();
    } else {
        record_cut(&mut recorder, strategy, rasteriser, capacities).map_err(refuse)?;
    }
    recorder.shade();
    Ok(recorder.plan)
}

/// The plan where a cut opens some part; the reason where the strategy cannot draw it.
fn record_cut(
    recorder: &mut Recorder<'_>,
    strategy: &Strategy,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), String> {
    let surface = strategy.surface;
    match (surface, strategy.inside) {
        (CapSurface::Planar, InsideTest::Alone) => {
            surface::planar::record(recorder, rasteriser, capacities)
        }
        (CapSurface::Planar, inside) => Err(format!(
            "a section knows by itself what is inside, and {inside} has nothing to answer: name planar alone"
        )),
        (CapSurface::Alone, InsideTest::Stencil) => inside::stencil::alone::record(recorder),
        (CapSurface::Alone, inside) => Err(format!("{inside} does not draw caps by itself")),
        (_, InsideTest::Alone) => Err(format!("{surface} does not know what is inside")),
        (_, InsideTest::Mask) => inside::mask::record(recorder, surface, rasteriser, capacities),
        (_, InsideTest::Stencil) => inside::stencil::record(recorder, surface, capacities),
        (_, InsideTest::ABuffer) => {
            inside::abuffer::record(recorder, surface, rasteriser, capacities)
        }
        (_, InsideTest::KBuffer { depths }) => {
            inside::kbuffer::record(recorder, surface, rasteriser, depths, capacities)
        }
        (CapSurface::Raycast, InsideTest::Vds { resolution }) => {
            inside::vds::record_with_list(recorder, rasteriser, resolution, capacities)
        }
        (CapSurface::Raycast, InsideTest::Ldi { resolution }) => {
            inside::ldi::record_with_list(recorder, rasteriser, resolution, capacities)
        }
        (CapSurface::Grid { .. } | CapSurface::Adaptive { .. }, InsideTest::Vds { resolution }) => {
            let sprites = |recorder: &mut Recorder<'_>, ranks: &[usize]| {
                let of_part = |rank: &usize| {
                    let sprite = inside::vds::record(recorder, *rank, resolution, capacities);
                    (vec![*rank], sprite)
                };
                Ok(ranks.iter().map(of_part).collect())
            };
            let tessellate =
                |r: &mut Recorder<'_>| surface::tessellate(r, surface, true, capacities);
            surface::paper::record(recorder, tessellate, sprites)
        }
        (CapSurface::Grid { .. } | CapSurface::Adaptive { .. }, InsideTest::Ldi { resolution }) => {
            let images = |recorder: &mut Recorder<'_>, ranks: &[usize]| {
                let images =
                    inside::ldi::record(recorder, rasteriser, ranks, resolution, capacities)?;
                Ok(vec![(ranks.to_vec(), images)])
            };
            let tessellate =
                |r: &mut Recorder<'_>| surface::tessellate(r, surface, true, capacities);
            surface::paper::record(recorder, tessellate, images)
        }
    }
}

/// What of the scene is more than the strategy knows of.
fn beyond(recorder: &Recorder<'_>, strategy: &Strategy) -> Option<String> {
    let inside = strategy.inside;
    if !strategy.counts_winding() && recorder.has_nonzero() {
        return Some(format!(
            "{inside} knows parity alone, and a part that is cut has fill = \"nonzero\""
        ));
    }
    if recorder.shows_overlaps() && !strategy.tells_overlaps() {
        return Some(format!(
            "{strategy} draws the caps of each part by themselves and does not tell where solids overlap"
        ));
    }
    if recorder.has_cutters() && !strategy.lists_crossings() {
        let why = if strategy.is_by_the_papers_rule() {
            "draws each clip-surface by itself, with no list of crossings to put its faces in"
        } else {
            "cuts by planes alone"
        };
        return Some(format!(
            "a cut has a closed mesh for a volume, and {strategy} {why}: name raycast, grid or adaptive with mask, stencil, abuffer \
             or kbuffer, or raycast with vds or ldi"
        ));
    }
    unfiltered(recorder, strategy.surface)
}

/// Why the reliefs of the scene are not read as the options say.
fn unfiltered(recorder: &Recorder<'_>, surface: CapSurface) -> Option<String> {
    if recorder.height_filter == HeightFilter::Exact || !recorder.has_reliefs() {
        return None;
    }
    let why = match surface {
        CapSurface::Raycast => "solves for where a ray meets what four texels span",
        CapSurface::Adaptive { .. } => "measures its triangles against four texels",
        // What cuts by planes alone says so itself.
        CapSurface::Grid { .. } | CapSurface::Planar | CapSurface::Alone => {
            return recorder.unfiltered();
        }
    };
    Some(format!(
        "{surface} {why} and asks no sampler for heights: height_filter = \"hardware\" is for grid"
    ))
}
