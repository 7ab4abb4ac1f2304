//! `abuffer`: all fragments of each pixel, kept as lists (Carpenter 1984).
//!
//! One pass over the mesh counts the fragments of each pixel, a prefix sum lays their lists out one after the other, and the pass that
//! finds the surfaces fills them with depths. A pass per pixel then counts the crossings in front of each depth and converts the list into
//! the same words that `mask` writes directly: a crossing is inside where an odd number of depths lies behind it. No list is sorted,
//! because parity does not depend on order.
//!
//! Per frame: two mesh passes (the compute rasteriser transforms the vertices for each), a prefix sum of one to five passes, one reduction,
//! one resolve; 4 bytes per pixel and per fragment, 8 per fragment if several parts are cut. Exact for closed meshes up to ties of f32, as
//! `mask` is; depths keep full precision. Advantage over `mask`: the fragments themselves, for other queries.
//!
//! Cannot: predict the number of fragments of a frame. A frame that needs more than the previous one is drawn twice; if the fragments
//! exceed a storage binding, the frame is drawn in bands of rows.

use crate::effects::{FrameOutput, finish};
use crate::passes::{
    FragmentLists, Input, Inside, LISTED, Lanes, Refusal, SceneBuffers, leave_fragments, need,
    over_mesh, resolve,
};
use crate::plan::{Binding, Clock, Pass, Plan, Work};
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo};
use crate::strategies::surface;

/// Name of the bounded buffer, reported when a frame needs more.
const FRAGMENTS_OF_PIXELS: &str = "fragments of the A-buffer";

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "abuffer",
        parameter: None,
        about: "all fragments of each pixel, counted, laid out by a prefix sum and kept",
        limit: "",
        rebuilds: "",
        can: Abilities {
            nonzero: false,
            ..Abilities::ALL
        },
        hard_cases: &[
            ("raycast+abuffer", true),
            ("raycast+abuffer@compute", false),
        ],
    },
    answers: InsideTestKind::Rays(record),
};

/// Records the frame of a cap surface with `abuffer`.
fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    _: u32,
) -> Result<FrameOutput, Refusal> {
    let capacity = surface::capacity(input);
    let scene = SceneBuffers::upload(plan, input, Lanes::of_bits(input, capacity))?;
    let several = input.active_cuts.lanes > 1;
    let lists = FragmentLists::of_mesh(
        plan,
        input,
        input.pixel_count(),
        several,
        FRAGMENTS_OF_PIXELS,
    )?;
    let crossings = surface::list(plan, &scene, surface, capacity, &lists.counting())?;
    leave_fragments(
        plan,
        &scene,
        "count",
        "how many fragments each pixel has",
        &lists.counting(),
    )?;
    let need = need(plan, input, Clock::Frame);
    lists.lay_out(plan, "fragments of each pixel", need);
    let nearest = over_mesh(plan, &scene, &lists.keeping(), &crossings.asked())?;
    let mask = scene.lanes.reduced_mask(plan, input);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        Binding::write("mask", mask),
    ];
    bindings.extend(lists.read());
    bindings.extend(crossings.bindings());
    let reduce = Pass::new(
        "reduce",
        "the fragments of a pixel become its words of the mask",
        Shader::from("strategies/inside/abuffer/reduce.wgsl").with_all(&LISTED),
        bindings,
        Work::over(input.view.size_px),
    );
    plan.add_pass(reduce.with_constants(vec![scene.lanes.constant()]));
    let inside = Inside::mask(mask);
    let layered = resolve(plan, &scene, nearest, inside, &crossings.asked());
    Ok(finish(plan, &scene, layered))
}
