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

use crate::passes::{Inside, Rasteriser, Recorder, Store};
use crate::plan::{Binding, Capacities};
use crate::strategies::surface::raycast;

/// Records the frame of `raycast+mask`.
pub fn record(
    recorder: &mut Recorder<'_>,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), String> {
    let capacity = raycast::capacity(recorder, capacities);
    recorder.lay_lanes(capacity);
    let mask = recorder.mask();
    let store = Store {
        file: "lib/store/mask.wgsl",
        bindings: vec![Binding::update("mask", mask)],
    };
    let crossings = raycast::record(recorder, capacity, &store);
    recorder.over_mesh(rasteriser, &store, &crossings)?;
    recorder.resolve(rasteriser, Inside::mask(mask), &crossings);
    Ok(())
}
