//! `auto`: the method that draws where none is named.
//!
//! Only those are taken that are exact on closed meshes, mark most of what may be wrong on others, and refuse nothing but more
//! clip-surfaces than a word has bits. That is `raycast+mask`; the choice is the rasteriser of the mesh. `stencil` and `planar`
//! come near it in time for one plane, but mark nothing, or rebuild moving parts.
//!
//! The rule:
//!
//! 1. A requested rasteriser is used.
//! 2. A software adapter is the CPU, to which fixed functions are code like any other: there the compute rasteriser, which cuts, caps and
//!    finds what is nearest in one sweep, took less time, or as much, in all that was measured (docs/results.md).
//! 3. Where it refuses a scene, as one of more parts than its table holds, or would bind more than the device does with the fewest rows at
//!    once, the hardware rasteriser draws: that takes a mesh as vertex and index buffers, which may be larger than storage bindings.
//! 4. An adapter that snaps vertices to coarser steps than 1/256 px draws other silhouettes than the compute rasteriser, which has 8
//!    sub-pixel bits everywhere: there too the compute rasteriser.
//! 5. On other adapters the hardware rasteriser draws: there is no measurement yet that would say otherwise.
//!
//! Costs what it takes to record a plan once more.

use super::{DrawOptions, Method, Rasteriser, Strategy, plan};
use crate::Error;
use crate::passes::Model;
use crate::plan::{Capacities, Limits};
use crate::scene::{USUAL_SUB_PIXEL_BITS, View};

/// The name that stands for the choice.
pub const AUTO: &str = "auto";

/// Result of the choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// Why, in words that follow "for".
    pub reason: String,
}

/// Properties of an adapter that the choice depends on.
#[derive(Clone, Copy, Debug)]
pub struct AdapterTraits<'a> {
    /// Limits for plans.
    pub limits: &'a Limits,
    /// True if it runs on the CPU.
    pub software: bool,
    /// To which fraction of a pixel it snaps vertices, 2^-bits; `None` where that is not known, as in a browser.
    pub sub_pixel_bits: Option<u32>,
}

/// Chooses the method for a scene in a view, with the means that are already fixed and the adapter that will draw.
pub fn choose(
    model: &Model,
    view: &View,
    asked: DrawOptions,
    adapter: Option<AdapterTraits<'_>>,
) -> Choice {
    let by = |rasteriser, reason: &str| Choice {
        method: Method::new(
            Strategy::RAYCAST_MASK,
            asked.or(DrawOptions::by(rasteriser)),
        ),
        reason: reason.to_owned(),
    };
    if let Some(rasteriser) = asked.rasteriser {
        return by(
            rasteriser,
            &format!("the {rasteriser} rasteriser is asked for"),
        );
    }
    let (limits, reason) = match adapter {
        Some(a) if a.software => (
            a.limits,
            "the adapter is a software one, where one sweep of the compute rasteriser takes less time than fixed functions".to_owned(),
        ),
        Some(AdapterTraits {
            limits,
            sub_pixel_bits: Some(bits),
            ..
        }) if bits < USUAL_SUB_PIXEL_BITS => (
            limits,
            format!("the adapter snaps vertices to 1/{} px, the compute rasteriser to 1/256", 1 << bits),
        ),
        _ => {
            return by(
                Rasteriser::Hardware,
                "the adapter rasterises by fixed functions",
            );
        }
    };
    let compute = by(Rasteriser::Compute, &reason);
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
