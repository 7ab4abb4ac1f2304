//! `winding`: generalised winding numbers, for meshes that are not closed.
//!
//! An open part is closed for counting: its boundary chain is filled with triangles that are drawn like all others and never kept. The lane
//! of the part counts fragments as `mask` does for the nonzero rule; where the part begins to be kept at a crossing, the number of its
//! closing triangles, a smooth function of the point, is subtracted from the count. The result is the winding number of the part itself
//! ([`crate::scene::winding`]), rounded to the nearest whole number, which its fill rule judges. Closed parts are tested as by `mask`, and
//! a frame without open parts is that of `mask`.
//!
//! Per frame: what `mask` takes with counts, the closing triangles, a traversal of a tree per square of pixels in which an open part begins to
//! be kept, and, where that finds no whole number for the square, the triangles nearby for each such crossing. Per mesh: a sort of its
//! edges; per pose: a tree of the closing triangles.
//!
//! Marks a pixel where a number is as near to a half as the bound of its error, where a crossing lies in a closing triangle, and where counts
//! may have overflowed. Cannot: tell a hole from an opening that is meant; what half of the view from a point sees as open is outside.

use super::mask;
use crate::effects::FrameOutput;
use crate::passes::{
    CrossingSource, Input, Refusal, SceneBuffers, groups_of_tiles, share_tiles, tiles_in,
};
use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId};
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo};

/// Distance from a closing triangle within which a crossing is marked, in pixels: rasterisers snap vertices to 1/16 px or finer.
const SNAPPED_PX: f64 = 0.0625;

/// Side in pixels of the squares that share an expansion, bytes of an expansion, and of the list of a workgroup's squares:
/// `shaders/lib/inside_tests/local_winding.wgsl`.
const SQUARE_PX: u32 = 8;
const EXPANSION_BYTES: u64 = 256;
const LIST_BYTES: u64 = 272;

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

fn squares(input: &Input<'_>) -> u64 {
    let [width, height] = input.view.size_px.map(|px| px.div_ceil(SQUARE_PX));
    u64::from(width) * u64::from(height)
}

/// Words behind the lanes of a mask, for whole numbers of closing triangles: around crossings and at the near plane.
pub(super) fn settled_words(input: &Input<'_>) -> u64 {
    2 * squares(input) * input.closed_parts().len() as u64
}

/// Records the passes that decide by winding numbers which crossings are inside open parts, if the input closes any. `mask` holds the counts.
pub(super) fn reduce(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    mask: ResourceId,
    crossings: &CrossingSource,
) {
    let Some(trees) = scene.closings.clone() else {
        return;
    };
    let active_cuts = &scene.input.active_cuts;
    let closing_count = scene.input.closed_parts().len() as u64;
    let tile_count = tiles_in(scene.input.view.size_px);
    let (share, work, tiles) = match &scene.on_screen {
        Some(_) => scene.pixels(),
        None => ("lib/share/all_tiles.wgsl", share_tiles(tile_count), None),
    };
    let kinds = 1 + u64::from(active_cuts.near_inside);
    let bytes_of_squares = squares(scene.input) * closing_count * kinds * EXPANSION_BYTES;
    let expansions = plan.add_resource(Resource::storage(
        "expansions",
        u64::from(groups_of_tiles(tile_count)) * LIST_BYTES + bytes_of_squares,
        Clock::Frame,
    ));
    let mut add = |name, about, file: &'static str, own: Vec<Binding>| {
        let mut bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            scene.parts.clone(),
            trees.clone(),
        ];
        bindings.extend(own);
        bindings.extend(crossings.bindings.iter().cloned());
        bindings.extend(tiles.clone());
        let shader = Shader::from(file).with(share).with_all(crossings.files());
        let pass = Pass::new(name, about, shader, bindings, work.clone());
        plan.add_pass(pass.with_constants(vec![
            ("lane_count", active_cuts.lanes as f64),
            ("near_inside", f64::from(u8::from(active_cuts.near_inside))),
            ("snapped_px", scene.input.view.doubt_px().max(SNAPPED_PX)),
        ]));
    };
    add(
        "expand",
        "the winding number of each open part's closing triangles in a square of pixels: one whole number, or an expansion",
        "strategies/inside/winding/expand.wgsl",
        vec![
            Binding::update("mask", mask),
            Binding::write("expansions", expansions),
        ],
    );
    add(
        "reduce",
        "winding numbers decide which crossings are inside open parts, in squares without a single whole number",
        "strategies/inside/winding/reduce.wgsl",
        vec![
            Binding::update("mask", mask),
            Binding::read("expansions", expansions),
        ],
    );
}
