//! `raycast`: all crossings of each pixel's ray with the clip-surfaces, as one sorted list of depths per pixel.
//!
//! No mesh, no tessellation: planes in closed form, reliefs by a walk over the cells of the offset map, with the sign carried from cell to
//! cell and citardauq roots. Where a ray meets many cells, as in grazing views, a pyramid of least and greatest heights lets it skip whole
//! blocks, with the same list. The list decides surface, cap and inside together, so no pixel of a closed mesh shows the inside of the
//! shell unless a buffer overflows. Per frame: one invocation per pixel, time in proportion to the cells met inside the height slab and the
//! box of the cut solids; 8 bytes per pixel and 4 (one clip-surface) or 8 per crossing of capacity.
//!
//! With the compute rasteriser, rays through reliefs are followed only between the depths of the cut parts in their picture tile
//! ([`SceneBuffers::on_screen_first`]); by slabs, only those of listed pixels ([`WalkedPixels::Listed`]).
//!
//! Lists have the length of the longest one that a frame needed. Cannot: hold more than 1023 crossings per pixel, or lists of more than 2
//! GiB in a picture: 512 crossings at 1024 x 768, 64 at 3840 x 2160. A list that overflows keeps the nearest crossings, marks the pixel and
//! reports its need.

mod choice;

use super::cutter;
use crate::passes::{
    ActiveCuts, Crossings, Input, NEED_OF_CELLS, NEED_OF_CROSSINGS, PixelList, ReliefWalk,
    SceneBuffers, Store, fours_file, need, pixels, pyramids, surfaces_file,
};
use crate::plan::pack;
use crate::plan::{
    Access, Binding, Bounded, Capacities, Capacity, Clock, Limits, Pass, Plan, Resource,
    ResourceId, Work,
};
use crate::scene::Fill;
use crate::shader::Shader;
use crate::strategies::row::{Abilities, CapSurfaceRow, Caps, StrategyInfo};

/// The cap surface's row in the strategy table.
pub(crate) static ROW: CapSurfaceRow = CapSurfaceRow {
    facts: StrategyInfo {
        name: "raycast",
        parameter: None,
        about: "every crossing of the pixel's ray with planes and bilinear height fields, exactly",
        limit: "",
        rebuilds: "",
        can: Abilities::ALL,
        hard_cases: &[],
    },
    exact_heights: "solves for where a ray meets what four texels span",
    usual_tests: |_| true,
    caps: Caps::Rays(cutter::list),
};

/// Initial capacity for one relief or cutter, in crossings; together with the parity bit it makes a lane of 8 bits.
const FIRST_PER_RELIEF: u32 = 7;

/// Bytes of the lists of a whole picture, over all of its bands.
const MOST_BYTES: u64 = 2 << 30;

/// Capacity of a pixel's list, in crossings.
pub(crate) fn capacity(input: &Input<'_>) -> u32 {
    let surfaces = &input.active_cuts.surfaces;
    let reliefs = surfaces
        .iter()
        .filter(|s| input.model.is_relief(**s) || input.model.is_cutter(**s))
        .count() as u32;
    let planes = surfaces.len() as u32 - reliefs;
    // Wider lanes cost time: a frame that needs them reports it.
    let usual = (planes + reliefs * FIRST_PER_RELIEF).min(Capacities::CROSSINGS_OF_A_WORD);
    let most = if reliefs == 0 {
        planes
    } else {
        input
            .capacities
            .crossings
            .unwrap_or(usual)
            .max(planes + reliefs)
    };
    most.clamp(1, most_that_fit(input))
}

/// The longest lists that fit in bands of a picture together with their lanes, by core WebGPU limits: the plan of a frame must not depend
/// on the adapter.
fn most_that_fit(input: &Input<'_>) -> u32 {
    let parts = &input.model.prepared.parts;
    let cut = input.active_cuts.cut_parts();
    let has_counts =
        |rank: &&usize| parts[**rank].fill == Fill::Nonzero || input.closing_of(**rank).is_some();
    let with_counts = cut.iter().filter(has_counts).count() as u64;
    // A crossing takes a word of a list, a bit of each lane of bits, a byte of each lane of counts.
    let with_bits = cut.len() as u64 - with_counts;
    let words = (with_bits.div_ceil(32) + with_counts.div_ceil(4)).max(1);
    let [width, _] = input.view.size_px;
    let in_band = Limits::CORE.storage_binding_bytes / pixels([width, Capacities::FEWEST_ROWS]);
    let in_picture = MOST_BYTES / pixels([width, input.view.band[1]]).max(1);
    let most = (in_band / (4 * words)).min(in_picture / 4);
    let fewest = u64::from(Capacities::CROSSINGS_OF_A_WORD);
    most.clamp(fewest, u64::from(Capacities::MOST_CROSSINGS)) as u32
}

/// Bits of the cuts that reach every cut part; 0 if the parts have different cuts.
fn common_cuts(active_cuts: &ActiveCuts) -> u32 {
    let mut cuts = active_cuts
        .cut_parts()
        .iter()
        .map(|r| active_cuts.cuts_of(*r));
    let first = cuts.next().unwrap_or(0);
    if cuts.all(|of_part| of_part == first) {
        first
    } else {
        0
    }
}

/// The pixels whose crossings are listed.
pub(crate) enum WalkedPixels<'a> {
    /// All, or all in touched tiles if the mesh is on the screen; if it is not, the pass prepares them for the fragments of a store.
    All(&'a Store),
    /// Those in a list; the pass turns the bits of slabs in the mask into bits of crossings.
    Listed(PixelList, ResourceId),
}

/// Records the pass that writes the list, and prepares every pixel for its first fragment. Clip-surfaces with a bit in `sheets` are left to
/// the passes that draw them as triangles.
pub(crate) fn record(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    capacity: u32,
    pixels: &WalkedPixels<'_>,
    sheets: u32,
) -> Crossings {
    let input = scene.input;
    let active_cuts = &input.active_cuts;
    let count = input.pixel_count();
    let one_surface = input.has_one_surface();
    let mut surfaces = active_cuts.surfaces.iter().enumerate();
    let reliefs = surfaces.any(|(i, s)| sheets >> i & 1 == 0 && input.model.is_relief(*s));
    let mut buffer =
        |name: &str, bytes: u64| plan.add_resource(Resource::storage(name, bytes, Clock::Frame));
    let words = count * 4 * u64::from(capacity);
    let crossings = Crossings {
        heads: buffer("crossing_heads", count * 8),
        z: buffer("crossing_z", words),
        surfaces: buffer("crossing_surface", if one_surface { 4 } else { words }),
        capacity,
        surfaces_file: surfaces_file(input),
    };
    let need = need(plan, input, Clock::Frame);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.ray_table.clone(),
        Binding::write("crossing_heads", crossings.heads),
        Binding::write("crossing_z", crossings.z),
        Binding::write("crossing_surface", crossings.surfaces),
        Binding::write("need", need),
    ];
    let mut constants = vec![("capacity", f64::from(capacity))];
    let (files, work) = match (pixels, &scene.on_screen) {
        (WalkedPixels::Listed(list, mask), _) => {
            bindings.extend([list.binding(), Binding::update("mask", *mask)]);
            constants.push(scene.lanes.constant());
            constants.push(("cuts", f64::from(common_cuts(active_cuts))));
            (vec![fours_file(input)], list.shared())
        }
        (WalkedPixels::All(_), Some(on_screen)) => {
            bindings.push(on_screen.touched.binding(Access::Read));
            let touched = on_screen.touched.shared();
            let files = vec!["lib/begun/nothing.wgsl", "lib/share/touched.wgsl"];
            (files, touched)
        }
        (WalkedPixels::All(store), None) => {
            bindings.extend(store.begun());
            let picture = Work::over(input.view.size_px);
            let files = vec!["lib/begun/store.wgsl", store.file, "lib/share/picture.wgsl"];
            (files, picture)
        }
    };
    let (shader, how) = if reliefs {
        bindings.push(scene.heights.clone());
        let reliefs = Shader::from("strategies/surface/raycast/reliefs.wgsl");
        let (shader, by_tiles) = match (pixels, &scene.on_screen) {
            (WalkedPixels::Listed(..), _) => {
                (Shader::from("strategies/surface/raycast/listed.wgsl"), true)
            }
            (WalkedPixels::All(_), Some(_)) => (reliefs.with("lib/interval/tiles.wgsl"), true),
            (WalkedPixels::All(_), None) => (reliefs.with("lib/interval/box.wgsl"), false),
        };
        if by_tiles {
            constants.push(("near_inside", f64::from(u8::from(active_cuts.near_inside))));
        }
        let choice = choice::of(input);
        let file = match choice.walk {
            ReliefWalk::Cells => "lib/relief_crossing/cells.wgsl",
            ReliefWalk::Pyramid => {
                bindings.extend(pyramids(plan, scene));
                "lib/relief_crossing/pyramid.wgsl"
            }
        };
        (shader.with(file), choice.reason)
    } else {
        let how = match sheets {
            0 => "only planes, so no walk",
            _ => "only planes; the other clip-surfaces are drawn as sheets",
        };
        let shader = Shader::from("strategies/surface/raycast/planes.wgsl");
        (shader, how.to_owned())
    };
    if sheets != 0 {
        constants.push(("sheets", f64::from(sheets)));
    }
    let pass = Pass::new(
        "crossings",
        format!("the list of depths per pixel; {how}"),
        shader.with_all(&files).with(crossings.surfaces_file),
        bindings,
        work,
    );
    plan.add_pass(pass.with_constants(constants));
    plan.bounded.push(Bounded {
        what: "crossings per pixel".to_owned(),
        slot: NEED_OF_CROSSINGS,
        capacity,
        resizes: Some(Capacity::Crossings),
        exact: false,
    });
    if reliefs {
        let limits = active_cuts.surfaces.iter().map(|number| {
            let surface = &input.model.prepared.surfaces[*number];
            pack::cell_limit(surface, input.reach())
        });
        plan.bounded.push(Bounded {
            what: "cells of a relief along a ray".to_owned(),
            slot: NEED_OF_CELLS,
            capacity: limits.max().unwrap_or(0),
            resizes: None,
            exact: false,
        });
    }
    crossings
}
