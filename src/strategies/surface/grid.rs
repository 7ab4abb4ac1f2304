//! `grid:N`: the paper's cap surface, a quad refined N x N and displaced by the offset map in the vertex shader.
//!
//! As in the paper, the mesh is clipped by chi at every fragment and the grid is drawn into the same depth buffer, each
//! fragment tested against the depth sprite of its part, or its layered depth image. Two approximations of one surface meet at
//! the rim: between grid vertices the cap runs straight where the clip test bends, and the *gap* shows what lies behind. No
//! finite N closes it where a solid meets the clip-surface at a grazing angle; it is counted (`crack_px`), not hidden.
//!
//! Per cut: a quad of 48 bytes and N² x 24 bytes of indices. Per frame: the mesh once, (N + 1)² vertices for each part and
//! clip-surface, d loads for each cap fragment. Cannot: cap at the near plane.

use std::sync::{Mutex, PoisonError};

use glam::DVec3;

use crate::passes::{DrawPass, Recorder, Volume, counted};
use crate::plan::pack::{self, Quad};
use crate::plan::{Binding, Clock, Contents, Draw, Resource, ResourceId, Role, Vertices};
use crate::scene::{Bounds, PreparedSurface};
use crate::shader::Shader;

/// Records the frame of `grid:N+vds:RES` or `grid:N+ldi:RES`: each image of volumes with the parts that it answers for.
pub fn record(
    recorder: &mut Recorder<'_>,
    cells: u32,
    images: impl FnOnce(&mut Recorder<'_>, &[usize]) -> Result<Vec<(Vec<usize>, Volume)>, String>,
) -> Result<(), String> {
    let ranks: Vec<usize> = recorder.relevance.cut_parts().to_vec();
    // Parts that only the near plane opens have no clip-surface to draw a grid on.
    let capped: Vec<usize> = ranks
        .iter()
        .copied()
        .filter(|r| recorder.relevance.cuts_of(*r) != 0)
        .collect();
    let images = if capped.is_empty() {
        Vec::new()
    } else {
        images(recorder, &capped)?
    };

    let (vertices, indices) = recorder.mesh();
    let bindings = vec![
        recorder.frame(),
        recorder.cut_table(),
        recorder.parts(),
        recorder.heights(),
    ];
    recorder.draw(DrawPass {
        name: "clip".to_owned(),
        reason: format!(
            "{}: chi decides at every fragment",
            counted(ranks.len(), "cut part")
        ),
        shader: "strategies/surface/grid/clip.wgsl".into(),
        bindings,
        constants: Vec::new(),
        vertices,
        indices,
        draws: recorder.draws_of(&ranks),
    });
    recorder.draw_plain_parts(false);

    if images.is_empty() {
        recorder.gather();
        return Ok(());
    }
    let grid = indices_of_grid(recorder, cells);
    let quads = quads(recorder, cells);
    for (ranks, volume) in images {
        let draws = (ranks.iter())
            .flat_map(|rank| caps_of(recorder, *rank, cells))
            .collect();
        let names: Vec<String> = (ranks.iter())
            .map(|rank| format!("`{}`", recorder.model.prepared.parts[*rank].name))
            .collect();
        let first = ranks.first().map_or(0, |r| recorder.relevance.place_of(*r));
        let mut bindings = vec![
            recorder.frame(),
            recorder.cut_table(),
            recorder.parts(),
            recorder.heights(),
            quads.clone(),
        ];
        bindings.extend(volume.bindings);
        recorder.draw(DrawPass {
            name: format!("cap {first}"),
            reason: format!(
                "the displaced grid of {}, cut to the solid by its sprite",
                names.join(", ")
            ),
            shader: Shader::from("strategies/surface/grid/cap.wgsl").with(volume.file),
            bindings,
            constants: vec![("cells", f64::from(cells))],
            vertices: Vertices::None,
            indices: grid,
            draws,
        });
    }
    recorder.gather();
    Ok(())
}

/// The grids of a part: one for each clip-surface that cuts it.
fn caps_of(recorder: &Recorder<'_>, rank: usize, cells: u32) -> Vec<Draw> {
    let relevance = &recorder.relevance;
    let place = relevance.place_of(rank) as u32;
    let bits = (0..relevance.cuts.len())
        .filter(|c| relevance.cuts_of(rank) >> c & 1 == 1)
        .fold(0, |b, c| b | relevance.cuts[c]);
    (0..relevance.surfaces.len() as u32)
        .filter(|s| bits >> s & 1 == 1)
        .map(|s| Draw {
            indices: 0..cells * cells * 6,
            base_vertex: 0,
            vertex_count: 0,
            instance: place * 32 + s,
            arguments: None,
        })
        .collect()
}

/// Two triangles per cell, the diagonal from the first to the last corner.
fn indices_of_grid(recorder: &mut Recorder<'_>, cells: u32) -> ResourceId {
    recorder.once("grid indices", |_| {
        let contents = grid_contents(cells);
        let resource = Resource::upload("grid indices", Role::Index, contents, Clock::Cut);
        Resource {
            is_scene: false,
            ..resource
        }
    })
}

/// The indices of a grid of so many cells; the last one asked for is kept, for every frame asks again.
fn grid_contents(cells: u32) -> Contents {
    static LAST: Mutex<Option<(u32, Contents)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((of, contents)) = &*last
        && *of == cells
    {
        return contents.clone();
    }
    let row = cells + 1;
    let indices: Vec<u32> = (0..cells * cells)
        .flat_map(|cell| {
            let a = cell / cells * row + cell % cells;
            [a, a + 1, a + row + 1, a, a + row + 1, a + row]
        })
        .collect();
    let contents = Contents::of(&indices);
    *last = Some((cells, contents.clone()));
    contents
}

fn quads(recorder: &mut Recorder<'_>, cells: u32) -> Binding {
    let id = recorder.once("quads", |r| {
        let quads: Vec<Quad> = r
            .relevance
            .surfaces
            .iter()
            .map(|s| quad(&r.model.prepared.surfaces[*s], &r.relevance.cut_box, cells))
            .collect();
        let resource = Resource::upload("quads", Role::Storage, Contents::of(&quads), Clock::Cut);
        Resource {
            is_scene: false,
            ..resource
        }
    });
    Binding::read("quads", id)
}

/// The rectangle on the plane, along `U` and `V`, that covers the box of the cut solids.
fn quad(surface: &PreparedSurface, cut_box: &Bounds, cells: u32) -> Quad {
    let range = |axis: DVec3| {
        let at = cut_box.corners().map(|c| (c - surface.origin).dot(axis));
        let low = at.iter().copied().fold(f64::INFINITY, f64::min);
        let high = at.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let margin = 1e-3 * (high - low);
        (low - margin, (high - low + 2.0 * margin) / f64::from(cells))
    };
    let (u_hat, v_hat) = (surface.frame.u_hat, surface.frame.v_hat);
    let ((u, u_step), (v, v_step)) = (range(u_hat), range(v_hat));
    let row = |p: DVec3| p.as_vec3().extend(0.0).to_array();
    // A flat map is a plane, which the vertex shader does not displace: its height goes into the corner.
    let lift = surface.frame.normal * -pack::flat_height(surface).unwrap_or(0.0);
    Quad {
        corner: row(surface.origin + lift + u_hat * u + v_hat * v),
        step_u: row(u_hat * u_step),
        step_v: row(v_hat * v_step),
    }
}
