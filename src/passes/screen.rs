//! The mesh on a screen: vertices in fixed point for one view, be it the frame's own or that of a sprite.
//!
//! One pass takes every vertex there once; any number of sweeps then look for the samples of its triangles. Cost: 16 bytes a
//! vertex, 8 bytes a triangle for the queue, which therefore cannot overflow, 32 KiB for the table of parts.
//!
//! Limits: [`MOST_DRAWN_PARTS`] parts, 2^23 vertices (a storage binding of core WebGPU). Nothing is clipped at the far plane:
//! views have it beyond all parts.

use super::Refusal;
use std::ops::Range;

use bytemuck::Zeroable;
use glam::DVec2;

use super::Recorder;
use super::sweep::groups_along;
use crate::plan::pack::{DrawnPart, MOST_DRAWN_PARTS, Sweep};
use crate::plan::{Binding, Clock, Contents, Resource, ResourceId, Role};
use crate::scene::View;
use crate::shader::Shader;

/// No point this near to the upper left corner is beyond the guard band of `screen.wgsl`, 16,000 px wide to the right and
/// below, and to the left and above by as much less as the picture is wide.
const SAFE_PX: f64 = 7000.0;

/// A place of a part that needs no inside test: `NO_LANE` in `shaders/lib/sweep.wgsl`.
pub const NO_LANE: u32 = u32::MAX;

/// What is to be taken to a screen.
#[derive(Clone, Debug)]
pub struct ScreenOf<'a> {
    /// What its passes and resources are named after; empty for the view of the frame.
    pub name: &'a str,
    /// The view.
    pub view: &'a View,
    /// The view as the shaders read it, under the name `frame`; of the same size.
    pub frame: Binding,
    /// When it is done again.
    pub clock: Clock,
    /// Ranks of the parts, in the order of the part table.
    pub ranks: &'a [usize],
    /// Whether groups of settled triangles have rows of their own.
    pub settles: bool,
    /// What each invocation sets back, one per pixel at least: file that fills `cutaway::fresh`.
    pub fresh: &'static str,
    /// What that binds.
    pub freshened: Vec<Binding>,
}

/// A mesh on a screen, ready to be swept.
#[derive(Clone, Debug)]
pub struct Screen {
    pub(super) name: String,
    pub(super) clock: Clock,
    pub(super) frame: Binding,
    pub(super) drawn_parts: Binding,
    pub(super) indices: Binding,
    /// The groups of settled triangles, where they have rows of their own.
    pub(super) settled: Option<Binding>,
    /// What a first sweep is told.
    pub(super) description: Sweep,
    pub(super) vertices: ResourceId,
    pub(super) queue: ResourceId,
    /// Some part may reach beyond the near plane or the guard band.
    pub(super) may_clip: bool,
}

impl Screen {
    /// The name of a pass or a resource of this screen.
    pub(super) fn named(&self, what: &str) -> String {
        named(self.name.as_str(), what)
    }

    /// The vertices, to be read.
    pub(super) fn vertices(&self) -> Binding {
        Binding::read("screen", self.vertices)
    }
}

fn named(screen: &str, what: &str) -> String {
    if screen.is_empty() {
        what.to_owned()
    } else {
        format!("{screen} {what}")
    }
}

impl Recorder<'_> {
    /// Records the pass that takes parts to a screen; the reason where they are too many.
    pub fn screen(&mut self, of: ScreenOf<'_>) -> Result<Screen, Refusal> {
        let groups = if of.settles {
            self.settled_groups().len()
        } else {
            0
        };
        let rows = of.ranks.len() + groups;
        if rows > MOST_DRAWN_PARTS {
            return Err(Refusal::amount(format!(
                "the compute rasteriser draws {MOST_DRAWN_PARTS} parts and groups of faces in clip-surfaces, there are {rows}"
            )));
        }
        // Vertices from the first to the last that some part needs.
        let (first_vertex, end_vertex) = (of.ranks.iter())
            .map(|rank| self.vertices_of(*rank))
            .fold((u32::MAX, 0), |(first, end), range| {
                (first.min(range.start), end.max(range.end))
            });
        let first_vertex = first_vertex.min(end_vertex);
        let (table, triangle_count) = self.drawn_parts(of.ranks, of.settles, first_vertex);
        let vertex_count = end_vertex - first_vertex;
        let description = Sweep {
            triangle_count,
            vertex_count,
            search_steps: rows.next_power_of_two().ilog2(),
            again: 0,
            first_vertex,
            first_group: of.ranks.len() as u32,
        };
        let table = Contents::of(&table);
        let drawn_parts = self.uniform(&named(of.name, "drawn_parts"), table, of.clock);
        let (vertices, indices) = self.mesh_in_storage(of.clock);
        let settled = of.settles.then(|| self.settled());
        let mut made = |what, words: u64| {
            let name = named(of.name, what);
            self.once(&name, |_| Resource::storage(&name, words * 4, of.clock))
        };
        let screen = Screen {
            name: of.name.to_owned(),
            clock: of.clock,
            frame: of.frame,
            drawn_parts: Binding::read("drawn_parts", drawn_parts),
            indices,
            settled,
            vertices: made("screen", u64::from(vertex_count).max(1) * 4),
            queue: made("queue", 2 * u64::from(triangle_count) + 3),
            description,
            may_clip: of.ranks.iter().any(|rank| self.may_clip(of.view, *rank)),
        };
        let pixel_count = of.view.size_px[0] * of.view.size_px[1];
        let mut bindings = vec![
            screen.frame.clone(),
            self.told(&screen, false),
            vertices,
            Binding::write("screen", screen.vertices),
            Binding::write("queue", screen.queue),
        ];
        let items = if of.freshened.is_empty() {
            vertex_count
        } else {
            vertex_count.max(pixel_count)
        };
        bindings.extend(of.freshened);
        self.over(
            &screen,
            "transform",
            "each vertex goes to fixed point once; what samples raise begins empty, as does the queue of triangles that are not small",
            Shader::from("passes/rasterise/transform.wgsl").with(of.fresh),
            bindings,
            Vec::new(),
            groups_along(items),
        );
        Ok(screen)
    }

    /// The table of drawn parts, those of settled triangles at its end, and how many triangles they have.
    fn drawn_parts(
        &self,
        ranks: &[usize],
        settles: bool,
        first_vertex: u32,
    ) -> (Vec<DrawnPart>, u32) {
        let groups = if settles {
            self.settled_groups()
        } else {
            Vec::new()
        };
        let of_rank = |rank: &usize| {
            let mut indices = self.model.ranges[*rank].indices.clone();
            if let Some((_, first)) = groups.iter().find(|(r, _)| r == rank) {
                indices.end = first.indices.start;
            }
            (*rank, indices)
        };
        let of_groups = groups.iter().map(|(rank, g)| (*rank, g.indices.clone()));
        let rows: Vec<_> = ranks.iter().map(of_rank).chain(of_groups).collect();
        let mut table = vec![DrawnPart::zeroed(); MOST_DRAWN_PARTS];
        let lanes = self.lane_table().places;
        let mut triangle_count = 0;
        for (row, (rank, indices)) in table.iter_mut().zip(&rows) {
            let range = &self.model.ranges[*rank];
            let place = self.relevance.place_of(*rank);
            let [lane_word, lane_shift] = lanes.get(place).copied().unwrap_or_default();
            *row = DrawnPart {
                first_triangle: triangle_count,
                first_index: indices.start,
                base_vertex: range.base_vertex.cast_unsigned() - first_vertex,
                cuts: self.relevance.cuts_of(*rank),
                lane_word,
                lane_shift,
                place: if place < self.relevance.lanes {
                    place as u32
                } else {
                    NO_LANE
                },
                part: self.model.prepared.parts[*rank].part as u32,
            };
            triangle_count += (indices.end - indices.start) / 3;
        }
        for row in &mut table[rows.len()..] {
            row.first_triangle = u32::MAX;
        }
        (table, triangle_count)
    }

    /// The mesh of all parts in storage bindings, for passes on a clock: vertices and indices.
    pub(super) fn mesh_in_storage(&mut self, clock: Clock) -> (Binding, Binding) {
        let indices = match clock {
            Clock::Frame => self.indices(),
            Clock::Solid | Clock::Cut => self.solid_indices(),
        };
        (
            Binding::read("vertices", self.vertices()),
            Binding::read("indices", indices),
        )
    }

    /// What a first sweep over a screen is told, or one that comes again.
    pub(super) fn told(&mut self, screen: &Screen, again: bool) -> Binding {
        let name = screen.named(if again { "sweep again" } else { "sweep" });
        let sweep = Sweep {
            again: u32::from(again),
            ..screen.description
        };
        let id = self.uniform(&name, Contents::of(&[sweep]), screen.clock);
        Binding::read("sweep", id)
    }

    /// A table that changes with the cuts, if what reads it is not done more rarely.
    fn uniform(&mut self, name: &str, contents: Contents, reader: Clock) -> ResourceId {
        let clock = reader.min(Clock::Cut);
        self.once(name, |_| {
            Resource::upload(name, Role::Uniform, contents, clock)
        })
    }

    /// Numbers of the vertices of a part.
    fn vertices_of(&self, rank: usize) -> Range<u32> {
        let range = &self.model.ranges[rank];
        let first = range.base_vertex.cast_unsigned();
        first..first + range.vertex_count
    }

    /// Whether a part reaches beyond the near plane or anywhere near the guard band, by its box.
    fn may_clip(&self, view: &View, rank: usize) -> bool {
        let corners = self.model.prepared.parts[rank].bounds.corners();
        corners.into_iter().any(|corner| {
            let (at, depth) = view.project(corner);
            // Rounding is kept far away from: what is clipped needlessly costs an empty pass.
            depth < view.near * 1.001 || !at.abs().cmplt(DVec2::splat(SAFE_PX)).all()
        })
    }
}
