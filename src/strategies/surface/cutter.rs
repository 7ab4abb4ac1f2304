//! Cutters: closed meshes drawn as sheets, whatever the cap surface is.
//!
//! Each relevant cutter is drawn once to store its fragments; they go into the per-pixel list of crossings with normals for shading, and
//! from there on a cutter is a clip-surface like any other. The side on which a ray begins follows from parity: it begins inside if an odd
//! number of the cutter's fragments lies ahead. So the eye may be in the cutter, and the near plane may cut it. If neither is the case, an
//! odd number of fragments marks the pixel.
//!
//! Per frame: the cutters' triangles, by the hardware rasteriser, and the cost of [`Sheets`]. Per cut: the vertices of the cutters that
//! moved.
//!
//! Cannot: tell on which side of a cutter a point lies unless it is on a ray of the picture. The paper's rule needs that.

use super::raycast::{self, WalkedPixels};
use crate::passes::{Crossings, Input, Refusal, SceneBuffers, SheetDraw, Sheets, Store};
use crate::plan::{Binding, BufferRole, Clock, Draw, Plan, Resource, Vertices};
use crate::shader::Shader;

/// Bit set of the clip-surfaces that are cutters; bits are table indices.
pub(super) fn bits(input: &Input<'_>) -> u32 {
    let numbers = input.active_cuts.surfaces.iter().enumerate();
    numbers
        .filter(|(_, number)| input.model.is_cutter(**number))
        .fold(0, |bits, (index, _)| bits | 1 << index)
}

/// Records the passes that write the list of crossings where no other clip-surface is made of triangles: planes and reliefs as in
/// `raycast`, then the cutters, if any.
pub(super) fn list(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    capacity: u32,
    store: &Store,
) -> Result<Crossings, Refusal> {
    let bits = bits(scene.input);
    let crossings = raycast::record(plan, scene, capacity, &WalkedPixels::All(store), bits);
    if bits != 0 {
        let mut sheets = Sheets::default();
        add(plan, scene, &mut sheets);
        sheets.merge(plan, scene, &crossings)?;
    }
    Ok(crossings)
}

/// Adds the cutters to the sheets of a frame.
pub(super) fn add(plan: &mut Plan, scene: &SceneBuffers<'_>, sheets: &mut Sheets) {
    let input = scene.input;
    let bits = bits(input);
    if bits == 0 {
        return;
    }
    let cutters = &input.model.cutters;
    let mut draws = Vec::new();
    for (index, number) in input.active_cuts.surfaces.iter().enumerate() {
        let surface = &input.model.prepared.surfaces[*number];
        let (Some(volume), Some(range)) = (&surface.volume, cutters.range(*number)) else {
            continue;
        };
        if volume.keeps_inside {
            sheets.keeps_inside |= 1 << index;
        }
        if !input.view.near_plane_meets(&volume.bounds) {
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
    let [vertices, faces, indices] = [
        ("cutter vertices", BufferRole::Vertex, &cutters.vertices),
        ("cutter_faces", BufferRole::Storage, &cutters.faces),
        ("cutter indices", BufferRole::Index, &cutters.indices),
    ]
    .map(|(name, role, contents)| {
        plan.add_resource(Resource::upload(name, role, contents.clone(), Clock::Cut))
    });
    sheets.by_parity |= bits;
    sheets.draws.push(SheetDraw {
        name: "cutter".to_owned(),
        shader: Shader::from("strategies/surface/cutter/draw.wgsl"),
        bindings: vec![scene.frame.clone(), Binding::read("cutter_faces", faces)],
        constants: Vec::new(),
        vertices: Vertices::Mesh(vertices),
        indices,
        draws,
    });
}
