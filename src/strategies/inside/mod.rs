//! Inside tests.
//!
//! Those of rays record the frame of a cap surface themselves. Those of points record images, which are asked about every crossing of
//! the camera's rays here, or by the paper's rule ([`paper`](super::surface::paper)) about every fragment of a cap.

pub mod abuffer;
pub mod kbuffer;
pub mod ldi;
pub mod mask;
pub mod stencil;
pub mod vds;

use super::row::{CapSurface, RecordImages};
use super::surface;
use crate::passes::{Inside, Rasteriser, Recorder, Refusal, Store};
use crate::plan::{Binding, Capacities};

/// Records the frame of listed crossings with images of volumes, of so many texels along a side.
pub(super) fn probed(
    recorder: &mut Recorder<'_>,
    surface: CapSurface,
    images: RecordImages,
    resolution: u32,
    rasteriser: Rasteriser,
    capacities: &Capacities,
) -> Result<(), Refusal> {
    let capacity = surface::capacity(recorder, capacities);
    recorder.lay_lanes(capacity);
    let images = images(recorder, resolution, rasteriser, capacities)?;
    let mask = recorder.reduced_mask();
    let emptied = Store::nothing(vec![Binding::write("mask", mask)]);
    let crossings = surface::list(recorder, surface, capacity, &emptied, capacities)?;
    recorder.over_mesh(rasteriser, &Store::nothing(Vec::new()), &crossings)?;
    for (places, volume) in images {
        let name = format!("probe {}", places.start);
        recorder.probe(name, places, &volume, mask, &crossings);
    }
    recorder.resolve(rasteriser, Inside::mask(mask), &crossings);
    Ok(())
}
