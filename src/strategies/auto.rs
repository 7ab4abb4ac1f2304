//! `auto`: the method used where none is named.
//!
//! A candidate must be exact, mark most possible errors, and refuse only scenes with more clip-surfaces than a word has bits. On closed
//! meshes only `raycast+mask` qualifies. For one plane, `stencil` and `planar` take about as long, but `stencil` marks no errors and `planar`
//! rebuilds moving parts. If a cut applies to a part that is not closed, `raycast+winding` is chosen, which draws the other parts alike.
//!
//! The rule for the rasteriser:
//!
//! 1. A requested rasteriser is used.
//! 2. A software adapter runs fixed functions on the CPU like any other code: there the compute rasteriser, which cuts, caps and finds the
//!    nearest surface in one sweep, took as long or less in all measurements (docs/results.md).
//! 3. The hardware rasteriser draws scenes that the compute rasteriser refuses, for example with more parts than its table holds, or that
//!    exceed the binding limits even with the fewest rows per band: vertex and index buffers may be larger than storage bindings.
//! 4. An adapter that snaps vertices to coarser steps than 1/256 px draws other silhouettes than the compute rasteriser, which always has 8
//!    sub-pixel bits: the compute rasteriser is used there too.
//! 5. On other adapters the hardware rasteriser draws: no measurement so far favours the compute rasteriser there.
//!
//! Costs one additional recording of a plan, one more for open parts, and once per mesh a sort of its edges.

use super::{DrawOptions, Method, Rasteriser, Strategy, plan};
use crate::Error;
use crate::passes::{Model, counted};
use crate::plan::{Capacities, Limits};
use crate::scene::{USUAL_SUB_PIXEL_BITS, View};

/// Name that requests this choice instead of naming a method.
pub const AUTO: &str = "auto";

/// Result of the choice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// The reason, worded to follow "for".
    pub reason: String,
}

/// Properties of an adapter that the choice depends on.
#[derive(Clone, Copy, Debug)]
pub struct AdapterTraits<'a> {
    /// Limits for plans.
    pub limits: &'a Limits,
    /// True if the adapter runs on the CPU.
    pub software: bool,
    /// Sub-pixel bits: the adapter snaps vertices to 2^-bits of a pixel; `None` if unknown, as in a browser.
    pub sub_pixel_bits: Option<u32>,
}

/// `2 of 3 parts are not closed: winding numbers decide what is inside them`; `None` if all parts that are cut are closed.
pub fn open_parts_in_words(model: &Model) -> Option<String> {
    let open = model.open_parts().len();
    let (are, them) = match open {
        0 => return None,
        1 => ("is", "it"),
        _ => ("are", "them"),
    };
    let all = counted(model.prepared.parts.len(), "part");
    Some(format!(
        "{open} of {all} {are} not closed: winding numbers decide what is inside {them}"
    ))
}

/// Chooses the method for a scene in a view, with the options that are already fixed and the adapter that will draw.
pub fn choose(
    model: &Model,
    view: &View,
    asked: DrawOptions,
    adapter: Option<AdapterTraits<'_>>,
) -> Choice {
    // Larger pictures are drawn in bands.
    let band = view.rows(0, view.size_px[1].min(Capacities::FEWEST_ROWS));
    // Open parts take one more cut, and bytes in place of bits: a scene may have too many.
    let winding = Method::new(
        Strategy::RAYCAST_WINDING,
        DrawOptions::by(Rasteriser::Hardware),
    );
    let open = open_parts_in_words(model)
        .filter(|_| plan(model, &band, winding, &Capacities::UNKNOWN).is_ok());
    let by = |rasteriser, reason: &str| Choice {
        method: Method::new(
            match &open {
                Some(_) => Strategy::RAYCAST_WINDING,
                None => Strategy::RAYCAST_MASK,
            },
            asked.or(DrawOptions::by(rasteriser)),
        ),
        reason: match &open {
            Some(open) => format!("{open}, and {reason}"),
            None => reason.to_owned(),
        },
    };
    if let Some(rasteriser) = asked.rasteriser {
        return by(
            rasteriser,
            &format!("the {rasteriser} rasteriser is requested"),
        );
    }
    let (limits, reason) = match adapter {
        Some(a) if a.software => (
            a.limits,
            "the adapter runs in software, where one sweep of the compute rasteriser takes less time than fixed functions".to_owned(),
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
    match plan(model, &band, compute.method, &Capacities::UNKNOWN) {
        Ok(plan) => match plan.check_sizes(limits) {
            Err(Error::Limit(lack)) => by(
                Rasteriser::Hardware,
                &format!(
                    "the compute rasteriser would exceed the binding limits of the device: {lack}"
                ),
            ),
            _ => compute,
        },
        Err(refusal) => by(Rasteriser::Hardware, &refusal.reason),
    }
}
