//! The compute rasteriser: the pass over the mesh without the GPU's own rasteriser.
//!
//! Vertices are taken to fixed point once, 256 steps to a pixel; small triangles are covered by one invocation each, the rest
//! by workgroups, tile by tile; edge functions are exact integers and the top-left rule gives a sample on a shared edge to
//! exactly one triangle. Coverage is that of the GPU's own rasteriser, on devices that have few units for that.
//!
//! Two sweeps over the triangles in the place of one atomic of 64 bits, which core WebGPU lacks: marking XORs the mask and
//! finds the greatest depth-buffer value, claiming finds the first triangle at it. Both run the same pipelines, so that both
//! compute the same depths bit for bit. Cost per frame: 16 bytes a vertex, 4 bytes a triangle for the queue of large ones,
//! which therefore cannot overflow, and 8 bytes a pixel after the lanes of the mask.
//!
//! Limits: [`MOST_DRAWN_PARTS`] parts, 2^23 vertices (a storage binding of core WebGPU). Nothing is clipped at the far plane:
//! views have it beyond all parts. After Laine & Karras, *High-performance software rasterization on GPUs* (2011).

use bytemuck::Zeroable;

use super::recorder::{Recorder, pixels};
use super::{Crossings, Store};
use crate::plan::pack::{DrawnPart, MOST_DRAWN_PARTS, Sweep};
use crate::plan::{Access, Binding, Clock, Contents, Pass, Resource, ResourceId, Role, Work};
use crate::shader::Shader;

/// Invocations along x of a dispatch folded into two dimensions: `shaders/lib/sweep.wgsl`.
pub const INVOCATIONS_PER_ROW: u32 = 1 << 21;
/// Invocations of a workgroup that owns triangles or vertices.
const GROUP: u32 = 64;
/// Planes of one word per pixel: the nearest depth and who claims it.
const NEAREST_PLANES: u64 = 2;
/// Workgroups that share the queue of large triangles, and the rows of tiles of each: `large.wgsl` steps by them.
const QUEUE_GROUPS: [u32; 3] = [16, 8, 1];

/// No point this near to the upper left corner is beyond the guard band of `screen.wgsl`, 16,000 px wide to the right and
/// below, and to the left and above by as much less as the picture is wide.
const SAFE_PX: f64 = 7000.0;

struct Mesh {
    drawn_parts: Binding,
    indices: Binding,
    vertices: Binding,
    screen: ResourceId,
    nearest: ResourceId,
    queue: ResourceId,
    triangle_count: u32,
    vertex_count: u32,
    search_steps: u32,
    /// Some part may reach beyond the near plane or the guard band.
    may_clip: bool,
}

impl Recorder<'_> {
    /// Rasterises all parts into what an inside test wants, and what the nearest kept surfaces are into the layers, where they wait for the
    /// resolve with depth-buffer values for depths; the reason where there are too many parts.
    pub(super) fn rasterise(&mut self, store: &Store, crossings: &Crossings) -> Result<(), String> {
        let mesh = self.mesh_in_compute()?;
        let [marking, claiming] =
            [("sweep marking", 0), ("sweep claiming", 1)].map(|(name, claims)| {
                let sweep = Sweep {
                    triangle_count: mesh.triangle_count,
                    vertex_count: mesh.vertex_count,
                    search_steps: mesh.search_steps,
                    claims,
                };
                let id = self.once(name, |_| {
                    Resource::upload(name, Role::Uniform, Contents::of(&[sweep]), Clock::Cut)
                });
                Binding::read("sweep", id)
            });
        let frame = self.frame();
        let pixel_count = pixels(self.view.size_px) as u32;
        self.over(
            "transform",
            "each vertex goes to fixed point once; depths and the queue of large triangles begin empty",
            "passes/rasterise/transform.wgsl",
            vec![
                frame,
                marking.clone(),
                mesh.vertices.clone(),
                Binding::write("screen", mesh.screen),
                Binding::write("nearest", mesh.nearest),
                Binding::write("queue", mesh.queue),
            ],
            Vec::new(),
            groups_along(mesh.vertex_count.max(pixel_count)),
        );
        self.sweep("mark", &mesh, &marking, store, crossings);
        self.sweep("claim", &mesh, &claiming, store, crossings);

        let layers = self.layers();
        let bindings = vec![
            self.frame(),
            marking,
            mesh.drawn_parts,
            mesh.indices,
            mesh.vertices,
            Binding::read("screen", mesh.screen),
            Binding::read("nearest", mesh.nearest),
            Binding::write("layers", layers),
        ];
        self.compute(
            "surfaces",
            Clock::Frame,
            "the triangle that claimed a pixel gives it part, side and normal",
            "passes/rasterise/surfaces.wgsl",
            bindings,
            Vec::new(),
            self.view.size_px,
        );
        Ok(())
    }

    fn mesh_in_compute(&mut self) -> Result<Mesh, String> {
        let order = self.relevance.order.clone();
        if order.len() > MOST_DRAWN_PARTS {
            return Err(format!(
                "the compute rasteriser draws {MOST_DRAWN_PARTS} parts, there are {}",
                order.len()
            ));
        }
        let mut table = vec![DrawnPart::zeroed(); MOST_DRAWN_PARTS];
        let lanes = self.lane_table().places;
        let mut triangle_count = 0;
        for (row, (place, rank)) in table.iter_mut().zip(order.iter().enumerate()) {
            let range = &self.model.ranges[*rank];
            let [lane_word, lane_shift] = lanes.get(place).copied().unwrap_or_default();
            *row = DrawnPart {
                first_triangle: triangle_count,
                first_index: range.indices.start,
                base_vertex: range.base_vertex.cast_unsigned(),
                cuts: self.relevance.cuts_of(*rank),
                lane_word,
                lane_shift,
                has_lane: u32::from(place < self.relevance.lanes),
                part: self.model.prepared.parts[*rank].part as u32,
            };
            triangle_count += (range.indices.end - range.indices.start) / 3;
        }
        for row in &mut table[order.len()..] {
            row.first_triangle = u32::MAX;
        }
        let drawn_parts = self.uploaded("drawn_parts", Role::Uniform, Clock::Cut, |_| {
            Contents::of(&table)
        });
        let vertices = self.uploaded("vertices", Role::Vertex, Clock::Solid, |r| {
            r.model.vertices.clone()
        });
        let indices = self.uploaded("indices", Role::Index, Clock::Solid, |r| {
            r.model.indices.clone()
        });
        let vertex_count = (self.model.vertices.0.len() / 16) as u32;
        let size_px = self.view.size_px;
        let mut made = |name, words: u64| {
            self.once(name, |_| Resource::storage(name, words * 4, Clock::Frame))
        };
        Ok(Mesh {
            drawn_parts,
            indices,
            vertices,
            screen: made("screen", u64::from(vertex_count) * 4),
            nearest: made("nearest", NEAREST_PLANES * pixels(size_px)),
            queue: made("queue", u64::from(triangle_count) + 2),
            triangle_count,
            vertex_count,
            search_steps: order.len().next_power_of_two().ilog2(),
            may_clip: order.iter().any(|rank| self.may_clip(*rank)),
        })
    }

    /// Whether a part reaches beyond the near plane or anywhere near the guard band, by its box.
    fn may_clip(&self, rank: usize) -> bool {
        let corners = self.model.prepared.parts[rank].bounds.corners();
        corners.into_iter().any(|corner| {
            let (at, depth) = self.view.project(corner);
            // Rounding is kept far away from: what is clipped needlessly costs an empty pass.
            depth < self.view.near * 1.001 || !at.abs().cmplt(glam::DVec2::splat(SAFE_PX)).all()
        })
    }

    /// Small triangles, then the others.
    fn sweep(
        &mut self,
        name: &str,
        mesh: &Mesh,
        sweep: &Binding,
        store: &Store,
        crossings: &Crossings,
    ) {
        let marks = name == "mark";
        let constants = vec![("lane_bits", f64::from(self.lane_bits))];
        let shader = |path: &'static str| {
            Shader::from(path)
                .with("lib/sample/ranked.wgsl")
                .with(store.file)
        };
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            sweep.clone(),
            mesh.drawn_parts.clone(),
            mesh.indices.clone(),
            Binding::read("screen", mesh.screen),
            Binding::update("nearest", mesh.nearest),
        ];
        bindings.extend(store.bindings.iter().cloned());
        bindings.extend(crossings.bindings());
        let mut small = bindings.clone();
        small.push(Binding {
            access: if marks {
                Access::ReadWrite
            } else {
                Access::Read
            },
            ..Binding::read("queue", mesh.queue)
        });
        self.over(
            &format!("{name} small"),
            if marks {
                "each sample marks the crossings it is behind, and raises the depth of its pixel where it is kept"
            } else {
                "the first triangle at the depth of a pixel claims it"
            },
            shader("passes/rasterise/small.wgsl"),
            small,
            constants.clone(),
            groups_along(mesh.triangle_count),
        );
        bindings.push(Binding::read("queue", mesh.queue));
        if mesh.may_clip {
            self.over(
                &format!("{name} clipped"),
                "the same for triangles that the near plane or the guard band cuts",
                shader("passes/rasterise/clipped.wgsl"),
                bindings.clone(),
                constants.clone(),
                QUEUE_GROUPS,
            );
        }
        self.over(
            &format!("{name} large"),
            "the same for triangles of many samples",
            shader("passes/rasterise/large.wgsl"),
            bindings,
            constants,
            QUEUE_GROUPS,
        );
    }

    fn over(
        &mut self,
        name: &str,
        reason: &str,
        shader: impl Into<Shader>,
        bindings: Vec<Binding>,
        constants: Vec<(&'static str, f64)>,
        groups: [u32; 3],
    ) {
        self.plan.add_pass(Pass {
            name: name.to_owned(),
            clock: Clock::Frame,
            reason: reason.to_owned(),
            shader: shader.into(),
            bindings,
            constants,
            work: Work::Compute { groups },
        });
    }
}

/// Workgroups for one invocation per item, folded into two dimensions where one is not enough.
fn groups_along(items: u32) -> [u32; 3] {
    let groups = items.div_ceil(GROUP).max(1);
    let row = INVOCATIONS_PER_ROW / GROUP;
    [groups.min(row), groups.div_ceil(row), 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folded_dispatches_cover_every_item_within_the_limits() {
        for items in [
            0,
            1,
            64,
            65,
            INVOCATIONS_PER_ROW,
            INVOCATIONS_PER_ROW + 1,
            u32::MAX,
        ] {
            let [x, y, z] = groups_along(items);
            assert!(x.max(y) <= 65_535 && z == 1, "{items}: {x} x {y}");
            assert!(
                y == 1 || x * GROUP == INVOCATIONS_PER_ROW,
                "{items}: rows of another length"
            );
            assert!(
                u64::from(x) * u64::from(y) * u64::from(GROUP) >= u64::from(items),
                "{items}"
            );
        }
    }
}
