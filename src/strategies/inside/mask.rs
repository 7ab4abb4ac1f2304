//! `mask`: parity without storage.
//!
//! The crossings of every pixel are known before the mesh is drawn, except as stated below. One pass over the mesh XORs into the pixel's
//! lane one bit for each crossing that the fragment lies behind; bit i ends as the parity of the fragments behind crossing i, that is,
//! whether crossing i is inside the solid. XOR commutes: no order, no sort, no fragment list, no limit on depth complexity. Every fragment
//! toggles the top bit of a lane, which ends at 0 wherever the mesh is closed. Ancestor: Eisemann & Décoret, *Single-pass GPU solid
//! voxelization* (2008), with uniform voxels instead of the few relevant depths.
//!
//! A part filled by the nonzero rule has counts instead of bits: a fragment adds 1 or -1, depending on its facing, to one byte for each
//! crossing that it lies behind, and crossing i is inside where its byte is not 0. One more word holds the sum over all fragments, which is
//! 0 for a closed mesh, and their number, which shows whether a byte may have overflowed: pixels with more than 254 fragments are marked.
//! The other parts of the scene keep their bits.
//!
//! If there are reliefs among up to eight clip-surfaces, the compute rasteriser marks lanes by their slabs first, and lists the crossings of
//! those pixels alone in which they can matter (`mark_by_slabs`).
//!
//! If up to eight planes are the only clip-surfaces, the compute rasteriser needs no list: each sample tests the planes, in sweeps
//! that run the same code.
//!
//! Why the nearest kept fragment is a true boundary although inner shells are fragments too: if the ray were inside the part both before
//! and after it, it would have entered by a fragment, which would be kept and nearer; or by leaving the removed region, at a cap that is
//! nearer; or at the near plane, which has its own cap.
//!
//! Per frame: one mesh pass, one resolve; 2 to 32 bits per pixel and cut part, 8 to 36 bytes if the part is filled nonzero, and more where
//! a pixel has more than 31 crossings. Exact for closed meshes up to ties of f32. The resolve reads every lane of a pixel, so its time
//! grows with the number of cut parts.
//!
//! Cannot: repair an open mesh; it marks the pixels where the total is odd or, under the nonzero rule, not 0, which inconsistently oriented
//! faces also cause. Where the near plane meets a part's box an odd total may also mean that the ray starts inside, so nothing is marked
//! there.

use crate::effects::{FrameOutput, finish};
use crate::passes::{
    CrossingSource, Input, Inside, Lanes, Refusal, SceneBuffers, Store, capacity_for_slabs,
    mark_by_slabs, over_mesh, resolve,
};
use crate::plan::{Binding, Plan};
use crate::strategies::inside::winding;
use crate::strategies::row::{Abilities, CapSurface, InsideTestKind, InsideTestRow, StrategyInfo};
use crate::strategies::surface;
use crate::strategies::surface::raycast::{self, WalkedPixels};

/// The inside test's row in the strategy table.
pub(crate) static ROW: InsideTestRow = InsideTestRow {
    facts: StrategyInfo {
        name: "mask",
        parameter: None,
        about: "parity bits, XORed by the one pass that draws the mesh; counts of windings where a part is nonzero",
        limit: "",
        rebuilds: "",
        can: Abilities::ALL,
        hard_cases: &[
            ("raycast+mask", true),
            ("raycast+mask@compute", true),
            ("adaptive:0.5+mask", false),
            ("grid:256+mask", false),
        ],
    },
    answers: InsideTestKind::Rays(record),
};

/// Records the frame of a cap surface with `mask`, or with `winding` if the input closes open parts.
pub(super) fn record(
    plan: &mut Plan,
    input: &Input<'_>,
    surface: CapSurface,
    _: u32,
) -> Result<FrameOutput, Refusal> {
    let mut capacity = surface::capacity(input);
    let counts = input.has_nonzero() || input.closings.is_some();
    let by_slabs = match surface == CapSurface::RAYCAST && !counts {
        true => capacity_for_slabs(input, capacity),
        false => None,
    };
    capacity = by_slabs.unwrap_or(capacity);
    let (lanes, file, rounds) = match counts {
        true => {
            let words = 1 + capacity.div_ceil(4);
            let lanes = Lanes::with_counts(input, capacity, words);
            (lanes, "lib/store/winding.wgsl", words)
        }
        false => {
            let lanes = Lanes::of_bits(input, capacity);
            let words = lanes.bits.div_ceil(32);
            (lanes, "lib/store/mask.wgsl", words)
        }
    };
    let scene = SceneBuffers::upload(plan, input, lanes)?;
    let mask = scene.lanes.mask(plan, input, winding::settled_words(input));
    let store = Store {
        file,
        bindings: vec![Binding::update("mask", mask)],
        rounds,
    };
    if by_slabs.is_some() {
        let marks = mark_by_slabs(plan, &scene, &store, mask)?;
        let pixels = WalkedPixels::Listed(marks.pixels, mask);
        let crossings = raycast::record(plan, &scene, capacity, &pixels, 0);
        let nearest = marks.finish(plan, &scene, &crossings);
        let layered = resolve(
            plan,
            &scene,
            nearest,
            Inside::mask(mask),
            &crossings.asked(),
        );
        return Ok(finish(plan, &scene, layered));
    }
    // Planes are never drawn as sheets.
    let planes = input
        .needs_no_list()
        .then(|| CrossingSource::of_planes(&scene));
    let to_come = || CrossingSource::to_come(input, capacity);
    let scene = scene.on_screen_first(plan, &store, &planes.clone().unwrap_or_else(to_come))?;
    let crossings = match planes {
        Some(planes) => planes,
        None => surface::list(plan, &scene, surface, capacity, &store)?.asked(),
    };
    let nearest = over_mesh(plan, &scene, &store, &crossings)?;
    winding::reduce(plan, &scene, mask, &crossings);
    let inside = match counts {
        true => Inside::winding(input, mask),
        false => Inside::mask(mask),
    };
    let layered = resolve(plan, &scene, nearest, inside, &crossings);
    Ok(finish(plan, &scene, layered))
}
