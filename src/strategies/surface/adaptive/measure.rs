//! Measures the error of every triangle of a tessellation, once for each map and for its relevant texels.
//!
//! The passes use their own table of the clip-surfaces, without positions: neither another cut nor a relief that moves along its normal or
//! is scaled triggers a new measurement.

use super::domain;
use crate::passes::SceneBuffers;
use crate::plan::pack::Domain;
use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId, Work};

/// Records the passes that fill `sheet_errors`: cells first, then edges and squares from the smallest up, each error at least as large as
/// those of the edges or squares halved from it.
pub(super) fn record(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    rows: &[Domain],
    reliefs: &[u32],
) -> ResourceId {
    let measured: Vec<Domain> = rows.iter().map(Domain::as_measured).collect();
    let name = "measured domains";
    let measured = super::table(plan, "domains", name, Clock::Cut, &measured);
    let errors: u64 = (reliefs.iter())
        .map(|s| {
            let [width, height] = domain::texels(&rows[*s as usize]);
            (width + 1) * (height + 1) + width * height
        })
        .sum();
    let id = plan.add_resource(Resource::storage("sheet_errors", errors * 4, Clock::Cut));
    for (slot, surface) in reliefs.iter().enumerate() {
        let row = &rows[*surface as usize];
        let texels = domain::texels(row).map(|n| n as u32);
        let mut pass = |what: &str, reason: &str, shader: &'static str, bits: Option<u32>, size| {
            let mut constants = vec![("surface", f64::from(*surface))];
            constants.extend(bits.map(|b| ("half_bits", f64::from(b))));
            let errors = match bits {
                None => Binding::write("sheet_errors", id),
                Some(_) => Binding::update("sheet_errors", id),
            };
            let bindings = vec![scene.heights.clone(), measured.clone(), errors];
            let name = format!("errors {slot} {what}");
            let pass = Pass::new(name, reason, shader, bindings, Work::over(size));
            plan.add_pass(pass.on(Clock::Cut).with_constants(constants));
        };
        pass(
            "cells",
            "how far the map is from flat triangles below a texel",
            "strategies/surface/adaptive/cells.wgsl",
            None,
            texels,
        );
        for bits in 0..row.patch_bits {
            pass(
                &format!("edges {}", 2 << bits),
                "how far the map is from the triangles on these edges, and from the halves of these triangles",
                "strategies/surface/adaptive/edges.wgsl",
                Some(bits),
                texels.map(|n| (n >> bits) + 1),
            );
            pass(
                &format!("squares {}", 2 << bits),
                "the same for the halves of squares",
                "strategies/surface/adaptive/squares.wgsl",
                Some(bits),
                texels.map(|n| n >> (bits + 1)),
            );
        }
    }
    id
}
