//! Cutters: closed meshes drawn as sheets, whatever the cap surface is.
//!
//! Each cutter that matters is drawn once to count its fragments and once to keep them; they go into the one list of crossings
//! with the normals of their triangles, and from there on a cutter is a clip-surface like any other. Which side of it a ray begins
//! on is told by parity: an odd number of its fragments ahead is inside. So the eye may be in the cutter, and the near plane may
//! cut it. Where neither is so an odd number of fragments marks the pixel.
//!
//! Per frame: the triangles of the cutters twice, by the GPU's rasteriser, and what [`Sheets`] cost. Per cut: the vertices of the
//! cutters that moved.
//!
//! Cannot: say on which side of a cutter a point lies that is on no ray of the picture. The paper's rule asks that.

use super::raycast;
use crate::passes::Refusal;
use crate::passes::{Crossings, Recorder, SheetDraw, Sheets, Store};
use crate::plan::{Capacities, Clock, Draw, Role, Vertices};
use crate::shader::Shader;

/// Bits of the clip-surfaces that are cutters, by their index in the table.
pub(super) fn bits(recorder: &Recorder<'_>) -> u32 {
    let numbers = recorder.relevance.surfaces.iter().enumerate();
    numbers
        .filter(|(_, number)| recorder.model.is_cutter(**number))
        .fold(0, |bits, (index, _)| bits | 1 << index)
}

/// Records the passes that write the list of crossings where no other clip-surface is made of triangles: planes and reliefs as
/// `raycast` finds them, then the cutters, if there are some.
pub(super) fn list(
    recorder: &mut Recorder<'_>,
    capacity: u32,
    store: &Store,
    capacities: &Capacities,
) -> Result<Crossings, Refusal> {
    let bits = bits(recorder);
    let crossings = raycast::record(recorder, capacity, store, bits);
    if bits != 0 {
        let mut sheets = Sheets::default();
        add(recorder, &mut sheets);
        recorder.merge_sheets(&sheets, &crossings, capacity, capacities)?;
    }
    Ok(crossings)
}

/// Adds the cutters to the sheets of a frame.
pub(super) fn add(recorder: &mut Recorder<'_>, sheets: &mut Sheets) {
    let bits = bits(recorder);
    if bits == 0 {
        return;
    }
    let mut draws = Vec::new();
    for (index, number) in recorder.relevance.surfaces.iter().enumerate() {
        let surface = &recorder.model.prepared.surfaces[*number];
        let (Some(volume), Some(range)) = (&surface.volume, recorder.model.cutters.range(*number))
        else {
            continue;
        };
        if volume.keeps_inside {
            sheets.keeps_inside |= 1 << index;
        }
        if !recorder.view.near_plane_meets(&volume.bounds) {
            sheets.closed |= 1 << index;
        }
        draws.push(Draw {
            indices: range.indices.clone(),
            base_vertex: range.base_vertex,
            vertex_count: range.vertex_count,
            instance: index as u32,
            arguments: None,
        });
    }
    let vertices = recorder.uploaded("cutter vertices", Role::Vertex, Clock::Cut, |r| {
        r.model.cutters.vertices.clone()
    });
    let indices = recorder.uploaded("cutter indices", Role::Index, Clock::Cut, |r| {
        r.model.cutters.indices.clone()
    });
    sheets.by_parity |= bits;
    sheets.draws.push(SheetDraw {
        name: "cutter".to_owned(),
        shader: Shader::from("strategies/surface/cutter/draw.wgsl"),
        bindings: vec![recorder.frame()],
        constants: Vec::new(),
        vertices: Vertices::Mesh(vertices.resource),
        indices: indices.resource,
        draws,
    });
}
