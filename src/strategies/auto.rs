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
//!    finds what is nearest in one sweep, takes less time in all that was measured (README, "What accuracy costs").
//! 3. Where it refuses a scene, as one of more parts than its table holds, the hardware rasteriser draws.
//! 4. On other adapters the hardware rasteriser draws: there is no measurement yet that would say otherwise.
//!
//! Costs what it takes to record a plan once more.

use super::{Means, Method, Rasteriser, Strategy, plan};
use crate::passes::Model;
use crate::plan::Capacities;
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

/// Chooses the method for a scene in a view; `asked` are the means that are settled already, `is_software` says that the adapter is.
pub fn choose(model: &Model, view: &View, asked: Means, is_software: bool) -> Choice {
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
    if !is_software {
        return by(
            Rasteriser::Hardware,
            "the adapter rasterises by fixed functions",
        );
    }
    let compute = by(
        Rasteriser::Compute,
        "the adapter is a software one, where one sweep of the compute rasteriser takes less time than fixed functions",
    );
    match plan(model, view, compute.method, &Capacities::UNKNOWN) {
        Ok(_) => compute,
        Err(refusal) => by(Rasteriser::Hardware, &refusal.reason),
    }
}
