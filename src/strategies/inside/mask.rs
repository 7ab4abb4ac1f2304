//! `mask`: parity without storage.
//!
//! The crossings of every pixel are known before the mesh is drawn. One pass over the mesh XORs into the pixel's lane one bit
//! for each crossing that the fragment lies behind; bit i ends as the parity of the fragments behind crossing i, which is
//! whether crossing i is inside the solid. XOR commutes: no order, no sort, no list of fragments, no limit to depth
//! complexity. The top bit of a lane gets every fragment and ends at 0 wherever the mesh is closed. Ancestor: Eisemann &
//! Décoret, *Single-pass GPU solid voxelization* (2008), with uniform voxels in the place of the few depths that matter.
//!
//! Per frame: one mesh pass, one resolve; 2 to 32 bits per pixel and cut part. Exact for closed meshes up to ties of f32.
//! The resolve looks at every lane of a pixel, so its time grows with the number of cut parts.
//!
//! Cannot: repair an open mesh; it marks the pixels where the total is odd. Where the near plane meets a part's box an odd
//! total may as well say that the ray starts inside, so there it marks nothing.

use crate::passes::{DrawPass, MaskTarget, NEAREST_PLANES, Recorder, counted, pixels};
use crate::plan::{Binding, Capacities, Clock, Resource};
use crate::strategies::Rasteriser;
use crate::strategies::surface::raycast::{self, Crossings};

/// Records the frame of `raycast+mask`.
pub fn record(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), String> {
    let capacity = raycast::capacity(recorder, capacities);
    let lane_bits = (capacity + 1).next_power_of_two().max(2);
    recorder.lane_bits = lane_bits;
    let words = (recorder.relevance.lanes as u32).div_ceil(32 / lane_bits);
    let all_words = match rasteriser {
        Rasteriser::Hardware => words,
        Rasteriser::Compute => words + NEAREST_PLANES,
    };
    let bytes = pixels(recorder.view.size_px) * 4 * u64::from(all_words);
    let mask = recorder.once("mask", |_| Resource::storage("mask", bytes, Clock::Frame));
    let target = MaskTarget {
        mask,
        words,
        lane_bits,
    };
    let crossings = raycast::record(recorder, capacity, mask, all_words);
    match rasteriser {
        Rasteriser::Hardware => draw(recorder, target, &crossings),
        Rasteriser::Compute => recorder.rasterise(target, &crossings.bindings())?,
    }
    resolve(recorder, target, &crossings, rasteriser);
    Ok(())
}

/// The pass over the mesh by the GPU's own rasteriser.
fn draw(recorder: &mut Recorder<'_>, target: MaskTarget, crossings: &Crossings) {
    let (vertices, indices) = recorder.mesh();
    let mut bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.parts(),
        Binding::update("mask", target.mask),
    ];
    bindings.extend(crossings.bindings());
    let ranks = recorder.relevance.cut_parts().to_vec();
    recorder.draw(DrawPass {
        name: "solid".to_owned(),
        reason: format!(
            "{}: each fragment marks the crossings it is behind, and stays where it is kept",
            counted(ranks.len(), "cut part")
        ),
        shader: "strategies/inside/mask/solid.wgsl",
        bindings,
        constants: vec![("lane_bits", f64::from(target.lane_bits))],
        vertices,
        indices,
        draws: recorder.draws_of(&ranks),
    });
    recorder.draw_plain_parts(true);
}

fn resolve(
    recorder: &mut Recorder<'_>,
    target: MaskTarget,
    crossings: &Crossings,
    rasteriser: Rasteriser,
) {
    let layers = recorder.layers();
    let mut bindings = vec![recorder.frame(), recorder.cut_table(), recorder.parts()];
    match rasteriser {
        Rasteriser::Hardware => {
            let targets = recorder.targets();
            bindings.extend([
                Binding::read("surface_words", targets.words),
                Binding::read("surface_depth", targets.depth),
                Binding::read("mask", target.mask),
                Binding::write("layers", layers),
            ]);
        }
        Rasteriser::Compute => bindings.extend([
            Binding::read("mask", target.mask),
            Binding::update("layers", layers),
        ]),
    }
    bindings.extend(crossings.bindings());
    let reliefs = raycast::has_reliefs(recorder);
    if reliefs {
        bindings.push(recorder.heights());
    }
    recorder.compute(
        "resolve",
        Clock::Frame,
        "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it",
        match (rasteriser, reliefs) {
            (Rasteriser::Hardware, false) => "strategies/inside/mask/resolve_planes.wgsl",
            (Rasteriser::Hardware, true) => "strategies/inside/mask/resolve_reliefs.wgsl",
            (Rasteriser::Compute, false) => "strategies/inside/mask/compute/resolve_planes.wgsl",
            (Rasteriser::Compute, true) => "strategies/inside/mask/compute/resolve_reliefs.wgsl",
        },
        bindings,
        vec![
            ("lane_bits", f64::from(target.lane_bits)),
            ("lane_count", recorder.relevance.lanes as f64),
            (
                "near_inside",
                f64::from(u8::from(recorder.relevance.near_inside)),
            ),
        ],
        recorder.view.size_px,
    );
}
