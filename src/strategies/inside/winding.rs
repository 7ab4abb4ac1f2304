//! `winding`: generalised winding numbers, for meshes that are not closed.
//!
//! An open part is closed for counting: its boundary chain is filled with triangles that are drawn like all others and never kept. The lane
//! of the part counts fragments as `mask` does for the nonzero rule; where the part begins to be kept at a crossing, the number of its
//! closing triangles, a smooth function of the point, is subtracted from the count. The result is the winding number of the part itself
//! ([`crate::scene::winding`]), rounded to the nearest whole number, which its fill rule judges. Closed parts are tested as by `mask`, and
//! a frame without open parts is that of `mask`.
//!
//! Per frame: what `mask` takes with counts, the closing triangles, and a query of a tree per crossing at which an open part begins to be
//! kept. Per mesh: a sort of its edges; per pose: a tree of the closing triangles.
//!
//! Marks a pixel where a number is as near to a half as the bound of its error, where a crossing lies in a closing triangle, and where counts
//! may have overflowed. Cannot: tell a hole from an opening that is meant; what half of the view from a point sees as open is outside.

use super::mask;
use crate::effects::FrameOutput;
use crate::passes::{CrossingSource, Input, Refusal, SceneBuffers};
use crate::plan::{Binding, Pass, Plan, ResourceId};
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo};

/// Distance from a closing triangle within which a crossing is marked, in pixels: rasterisers snap vertices to 1/16 px or finer.
const SNAPPED_PX: f64 = 0.0625;

/// The row of the table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "winding",
        parameter: None,
        about: "generalised winding numbers of parts that are open; other parts as by mask",
        limit: "",
        rebuilds: "tree of closing triangles, for open parts",
        can: Abilities::ALL,
        hard_cases: &[
            ("raycast+winding", false),
            ("raycast+winding@compute", false),
        ],
    },
    answers: InsideTestKind::Rays(record),
};

/// Records the frame of a cap surface with `winding`.
fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    parameter: u32,
) -> Result<FrameOutput, Refusal> {
    mask::record(plan, &input.closed()?, surface, parameter)
}

/// Records the pass that decides by winding numbers which crossings are inside open parts, if the input closes any. `mask` holds the counts.
pub(super) fn reduce(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    mask: ResourceId,
    crossings: &CrossingSource,
) {
    let Some([trees, cells]) = scene.closings.clone() else {
        return;
    };
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        Binding::update("mask", mask),
        trees,
        cells,
    ];
    bindings.extend(crossings.bindings.iter().cloned());
    let (share, work, tiles) = scene.pixels();
    bindings.extend(tiles);
    let active_cuts = &scene.input.active_cuts;
    let pass = Pass::new(
        "reduce",
        "winding numbers decide which crossings are inside open parts",
        Shader::from("strategies/inside/winding/reduce.wgsl")
            .with(share)
            .with_all(&crossings.files()),
        bindings,
        work,
    );
    plan.add_pass(pass.with_constants(vec![
        ("lane_count", active_cuts.lanes as f64),
        ("near_inside", f64::from(u8::from(active_cuts.near_inside))),
        ("snapped_px", scene.input.view.doubt_px().max(SNAPPED_PX)),
    ]));
}
