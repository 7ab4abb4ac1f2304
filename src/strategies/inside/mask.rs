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

use crate::passes::{DrawPass, Recorder, counted, pixels};
use crate::plan::{Binding, Capacities, Clock, Resource};
use crate::strategies::surface::raycast;

/// Records the frame of `raycast+mask`.
pub fn record(recorder: &mut Recorder<'_>, capacities: &Capacities) -> Result<(), String> {
    let capacity = raycast::capacity(recorder, capacities);
    let lane_bits = (capacity + 1).next_power_of_two().max(2);
    recorder.lane_bits = lane_bits;
    let lanes = recorder.relevance.lanes as u32;
    let words = lanes.div_ceil(32 / lane_bits);
    let bytes = pixels(recorder.view.size_px) * 4 * u64::from(words);
    let mask = recorder.once("mask", |_| Resource::storage("mask", bytes, Clock::Frame));
    let crossings = raycast::record(recorder, capacity, mask, words);

    let (vertices, indices) = recorder.mesh();
    let mut bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.parts(),
        Binding::update("mask", mask),
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
        constants: vec![("lane_bits", f64::from(lane_bits))],
        vertices,
        indices,
        draws: recorder.draws_of(&ranks),
    });
    recorder.draw_plain_parts(true);

    let targets = recorder.targets();
    let layers = recorder.layers();
    let mut bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.parts(),
        Binding::read("surface_words", targets.words),
        Binding::read("surface_depth", targets.depth),
        Binding::read("mask", mask),
        Binding::write("layers", layers),
    ];
    bindings.extend(crossings.bindings());
    let shader = if raycast::has_reliefs(recorder) {
        bindings.push(recorder.heights());
        "strategies/inside/mask/resolve_reliefs.wgsl"
    } else {
        "strategies/inside/mask/resolve_planes.wgsl"
    };
    recorder.compute(
        "resolve",
        Clock::Frame,
        "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it",
        shader,
        bindings,
        vec![
            ("lane_bits", f64::from(lane_bits)),
            ("lane_count", f64::from(lanes)),
            ("near_inside", f64::from(u8::from(recorder.relevance.near_inside))),
        ],
        recorder.view.size_px,
    );
    Ok(())
}
