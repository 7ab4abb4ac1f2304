//! The mesh on a screen: vertices in fixed point for one view, either the frame's own or a sprite's.
//!
//! One pass transforms every vertex once; any number of sweeps then rasterise the triangles. Cost: 16 bytes per
//! vertex, 12 bytes per triangle for the queue, which therefore cannot overflow, 32 KiB for the table of parts.
//!
//! Limits: [`MOST_DRAWN_PARTS`] parts, 2^23 vertices (a storage binding of core WebGPU). Nothing is clipped at the far plane, because
//! every view places it beyond all parts.

use std::ops::Range;

use bytemuck::Zeroable;
use glam::DVec2;

use super::share::{Share, first_piece_at};
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::closings::ClosedPart;
use crate::passes::frame::dispatch::groups_along;
use crate::passes::frame::input::Input;
use crate::passes::frame::lanes::Lanes;
use crate::passes::frame::on_screen::ScreenMesh;
use crate::passes::frame::refusal::Refusal;
use crate::plan::pack::{DrawnPart, MOST_DRAWN_PARTS, Sweep};
use crate::plan::{
    Access, Binding, BufferRole, Clock, Contents, DISPATCH_ARGUMENT_BYTES, Pass, Plan, Resource,
    Work,
};
use crate::scene::View;
use crate::shader::Shader;

/// The guard band of `screen.wgsl` extends 16,000 px to the right and down, and 16,000 px minus the picture's size to the left and up.
/// Points within this distance of the upper left corner are inside the guard band.
const SAFE_PX: f64 = 7000.0;

/// Table position of a part that needs no inside test; must match `NO_LANE` in `shaders/lib/rasterise/sweep.wgsl`.
pub const NO_LANE: u32 = u32::MAX;

/// Inputs for transforming the mesh to a screen.
#[derive(Clone, Debug)]
pub(crate) struct ScreenOf<'a> {
    /// Prefix of the names of its passes and resources; empty for the frame's own view.
    pub name: &'a str,
    pub view: &'a View,
    /// The view as the shaders read it, bound as `frame`; its picture size is that of the frame's view.
    pub frame: Binding,
    /// Clock on which the screen is made again.
    pub clock: Clock,
    /// Ranks of the parts, in the order of the part table.
    pub ranks: &'a [usize],
    /// True if groups of preclassified triangles have their own rows in the table of drawn parts.
    pub classifies: bool,
    /// Distribution of samples among invocations.
    pub share: Share,
    /// Further data to reset with the screen.
    pub fresh: Fresh,
}

/// Data that is reset together with a screen's queue.
#[derive(Clone, Debug)]
pub(crate) struct Fresh {
    /// Files that fill `cutaway::fresh`, and the files that those need.
    pub files: Vec<&'static str>,
    /// Bindings of the files.
    pub bindings: Vec<Binding>,
    /// Number of items to reset: the files are called once for each.
    pub items: u32,
}

impl Fresh {
    /// Nothing to reset.
    pub(crate) fn nothing() -> Self {
        Self {
            files: vec!["lib/fresh/nothing.wgsl"],
            bindings: Vec::new(),
            items: 0,
        }
    }
}

impl ScreenMesh {
    /// Name of a pass or resource of this screen.
    pub(crate) fn named(&self, what: &str) -> String {
        named(self.name.as_str(), what)
    }

    /// The file that fills `cutaway::rows`.
    pub(crate) fn rows(&self) -> &'static str {
        match self.has_one_row {
            true => "lib/rows/one.wgsl",
            false => "lib/rows/any.wgsl",
        }
    }

    /// Bindings for every pass over the screen's triangles.
    pub(crate) fn bindings(&self) -> Vec<Binding> {
        vec![
            self.frame.clone(),
            self.sweep.clone(),
            self.drawn_parts.clone(),
            self.indices.clone(),
            self.vertices(),
        ]
    }

    /// The queue of triangles.
    pub(crate) fn queue(&self, access: Access) -> Binding {
        Binding {
            access,
            ..Binding::read("queue", self.queue)
        }
    }

    /// The vertices, for reading.
    pub(crate) fn vertices(&self) -> Binding {
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

impl ScreenMesh {
    /// Records the pass that transforms parts to a screen; returns the reason if there are too many.
    pub(crate) fn record(
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        of: ScreenOf<'_>,
    ) -> Result<Self, Refusal> {
        let input = scene.input;
        let preclassified = scene.preclassified.as_ref().filter(|_| of.classifies);
        let closed = match of.clock {
            Clock::Frame => input.closed_parts(),
            Clock::Solid | Clock::Cut => &[],
        };
        let rows = input.rows(of.ranks, closed, preclassified.is_some());
        if rows.len() > MOST_DRAWN_PARTS {
            return Err(Refusal::amount(format!(
                "the compute rasteriser draws at most {MOST_DRAWN_PARTS} parts and groups of faces in clip-surfaces; there are {}",
                rows.len()
            )));
        }
        // Vertices from the first to the last that any part needs.
        let (first_vertex, end_vertex) = (of.ranks.iter())
            .map(|rank| input.vertices_of(*rank))
            .fold((u32::MAX, 0), |(first, end), range| {
                (first.min(range.start), end.max(range.end))
            });
        let first_vertex = first_vertex.min(end_vertex);
        let (table, triangle_count) = input.drawn_parts(&rows, &scene.lanes, first_vertex);
        let vertex_count = end_vertex - first_vertex;
        let sweep = Sweep {
            triangle_count,
            vertex_count,
            search_steps: rows.len().next_power_of_two().ilog2(),
            again: 0,
            first_vertex,
            first_group: (of.ranks.len() + closed.len()) as u32,
        };
        let [vertices, indices] = scene.mesh_in_storage(of.clock);
        let mut made = |what, words: u64| {
            let name = named(of.name, what);
            plan.add_resource(Resource::storage(name, words * 4, of.clock))
        };
        let screen_vertices = made("screen", u64::from(vertex_count).max(1) * 4);
        let queue_words = u64::from(first_piece_at(triangle_count)) + u64::from(triangle_count);
        let queue = made("queue", queue_words);
        let name = named(of.name, "pieces");
        let pieces =
            plan.add_resource(Resource::arguments(name, DISPATCH_ARGUMENT_BYTES, of.clock));
        // These tables are uploaded when a cut changes, or less often if the passes that read them run on a slower clock.
        let mut table_of = |variable, what, contents| {
            let (name, clock) = (named(of.name, what), of.clock.min(Clock::Cut));
            let table = Resource::upload(name, BufferRole::Uniform, contents, clock);
            Binding::read(variable, plan.add_resource(table))
        };
        let again = Sweep { again: 1, ..sweep };
        let screen = Self {
            name: of.name.to_owned(),
            clock: of.clock,
            frame: of.frame,
            drawn_parts: table_of("drawn_parts", "drawn_parts", Contents::from_values(&table)),
            indices,
            preclassified: preclassified.cloned(),
            vertices: screen_vertices,
            queue,
            pieces,
            share: of.share,
            is_queued: false,
            sweep: table_of("sweep", "sweep", Contents::from_values(&[sweep])),
            sweep_again: table_of("sweep", "sweep again", Contents::from_values(&[again])),
            triangle_count,
            has_one_row: rows.len() == 1,
            may_clip: of.ranks.iter().any(|rank| input.may_clip(of.view, *rank)),
        };
        let mut bindings = vec![
            screen.frame.clone(),
            screen.sweep.clone(),
            vertices,
            Binding::write("screen", screen.vertices),
            Binding::write("queue", screen.queue),
        ];
        bindings.extend(of.fresh.bindings);
        let pass = Pass::new(
            screen.named("transform"),
            "converts each vertex to fixed point once, and empties the queue of large triangles and the list of tiles",
            Shader::from("passes/rasterise/transform.wgsl").with_all(&of.fresh.files),
            bindings,
            Work::Compute {
                groups: groups_along(vertex_count.max(of.fresh.items)),
            },
        );
        plan.add_pass(pass.on(of.clock));
        Ok(screen)
    }
}

/// A row of the table of drawn parts.
struct DrawnRow {
    rank: usize,
    indices: Range<u32>,
    /// Bits of the cuts that apply.
    cuts: u32,
}

impl Input<'_> {
    /// The rows of the table of drawn parts: parts, closing triangles, then groups of preclassified triangles.
    fn rows(&self, ranks: &[usize], closed: &[ClosedPart], classifies: bool) -> Vec<DrawnRow> {
        let groups = match classifies {
            true => self.preclassified_groups(),
            false => &[],
        };
        let row = |rank: usize, indices: &Range<u32>| DrawnRow {
            rank,
            indices: indices.clone(),
            cuts: self.active_cuts.cuts_of(rank),
        };
        let of_rank = |rank: &usize| {
            let mut whole = row(*rank, &self.model.ranges[*rank].indices);
            if classifies {
                whole.indices.end = self.end_of_rest(*rank);
            }
            whole
        };
        let of_closed = |part: &ClosedPart| DrawnRow {
            cuts: self.cut_of_everything(),
            ..row(part.rank, &part.indices)
        };
        (ranks.iter().map(of_rank))
            .chain(closed.iter().map(of_closed))
            .chain(groups.iter().map(|(rank, g)| row(*rank, &g.indices)))
            .collect()
    }

    /// The table of drawn parts, and the total number of triangles.
    fn drawn_parts(
        &self,
        rows: &[DrawnRow],
        lanes: &Lanes,
        first_vertex: u32,
    ) -> (Vec<DrawnPart>, u32) {
        let mut table = vec![DrawnPart::zeroed(); MOST_DRAWN_PARTS];
        let mut triangle_count = 0;
        for (row, drawn) in table.iter_mut().zip(rows) {
            let range = &self.model.ranges[drawn.rank];
            let place = self.active_cuts.place_of(drawn.rank);
            let [lane_word, lane_shift] = lanes.of_place(place);
            *row = DrawnPart {
                first_triangle: triangle_count,
                first_index: drawn.indices.start,
                base_vertex: range.base_vertex.cast_unsigned() - first_vertex,
                cuts: drawn.cuts,
                lane_word,
                lane_shift,
                place: if place < self.active_cuts.lanes {
                    place as u32
                } else {
                    NO_LANE
                },
                part: self.model.prepared.parts[drawn.rank].part as u32,
            };
            triangle_count += (drawn.indices.end - drawn.indices.start) / 3;
        }
        for row in &mut table[rows.len()..] {
            row.first_triangle = u32::MAX;
        }
        (table, triangle_count)
    }

    /// Index range of a part's vertices.
    fn vertices_of(&self, rank: usize) -> Range<u32> {
        let range = &self.model.ranges[rank];
        let first = range.base_vertex.cast_unsigned();
        first..first + range.vertex_count
    }

    /// Returns true if a part's box reaches beyond the near plane or close to the guard band.
    fn may_clip(&self, view: &View, rank: usize) -> bool {
        let corners = self.model.prepared.parts[rank].bounds.corners();
        corners.into_iter().any(|corner| {
            let (at, depth) = view.project(corner);
            // The margin covers rounding errors: clipping needlessly costs only an empty pass.
            depth < view.near * 1.001 || !at.abs().cmplt(DVec2::splat(SAFE_PX)).all()
        })
    }
}
