//! `auto`: the method that draws where nobody names one.
//!
//! Only those are taken that are exact on closed meshes, mark what may be wrong on others, and draw every scene: so a picture can be
//! trusted by who knows nothing of the choice. That is `raycast+mask`; what is chosen is who rasterises the mesh. `stencil` and `planar`
//! come near it in time for one plane, but mark nothing, or build anew what moves.
//!
//! The rule:
//!
//! 1. Who is asked for rasterises.
//! 2. A software adapter is the CPU, to which fixed functions are code like any other: there the compute rasteriser, which cuts, caps and
//!    finds what is nearest in one sweep, takes less time in all that was measured (docs/results.md).
//! 3. Where it refuses a scene, as one of more parts than its table holds, or would bind more than the device does however few rows are drawn at
//!    once, the hardware rasteriser draws: that takes a mesh as vertex and index buffers, which may be larger than storage bindings.
//! 4. On other adapters the hardware rasteriser draws: there is no measurement yet that would say otherwise.
//!
//! Costs what it takes to record a plan once more.

use super::{Means, Method, Rasteriser, Strategy, plan};
use crate::Error;
use crate::passes::Model;
use crate::plan::{Capacities, Limits};
use crate::scene::View;

/// The name that stands for the choice.
pub const AUTO: &str = "auto";

/// What was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// Why, in words that follow "for".
    pub reason: String,
}

/// Chooses the method for a scene in a view; `asked` are the means that are settled already, `software` the limits of the adapter where that
/// is a software one.
pub fn choose(model: &Model, view: &View, asked: Means, software: Option<&Limits>) -> Choice {
    let by = |rasteriser, reason: &str| Choice {
        method: Method::new(Strategy::RAYCAST_MASK, asked.or(Means::by(rasteriser))),
        reason: reason.to_owned(),
    };
    if let Some(rasteriser) = asked.rasteriser {
        return by(
            rasteriser,
            &format!("the {rasteriser} rasteriser is asked for"),
        );
    }
    let Some(limits) = software else {
        return by(
            Rasteriser::Hardware,
            "the adapter rasterises by fixed functions",
        );
    };
    let compute = by(
        Rasteriser::Compute,
        "the adapter is a software one, where one sweep of the compute rasteriser takes less time than fixed functions",
    );
    // Larger pictures are drawn in bands.
    let band = view.rows(0, view.size_px[1].min(Capacities::FEWEST_ROWS));
    match plan(model, &band, compute.method, &Capacities::UNKNOWN) {
        Ok(plan) => match plan.check_sizes(limits) {
            Err(Error::Limit(lack)) => by(
                Rasteriser::Hardware,
                &format!("the compute rasteriser would bind more than the device does: {lack}"),
            ),
            _ => compute,
        },
        Err(refusal) => by(Rasteriser::Hardware, &refusal.reason),
    }
}
