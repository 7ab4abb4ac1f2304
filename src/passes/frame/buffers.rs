//! A frame's scene on the device: handles of the uploads that passes share.
//!
//! All uploads are described, and those that no pass uses are dropped from the plan ([`Plan::without_unused`]). Describing an upload only
//! copies a few rows, or shares bytes that the model already holds. Passes take these handles, so the scene, including its moving parts,
//! must be described before any pass is recorded.

use bytemuck::Zeroable;

use super::input::Input;
use super::lanes::{Lanes, MOST_LANE_WORDS};
use super::on_screen::OnScreen;
use super::pose::pose_parts;
use super::refusal::Refusal;
use crate::plan::pack::{self, CutTable, NO_CLOSING, Part};
use crate::plan::{
    Access, Binding, BufferRole, Clock, Contents, Format, Plan, Resource, ResourceId, Vertices,
    Work,
};
use crate::scene::Fill;

/// Scene buffers that passes bind.
#[derive(Clone, Debug)]
pub(crate) struct SceneBuffers<'a> {
    /// The input from which they were made.
    pub input: &'a Input<'a>,
    /// Positions of the parts' words within a pixel's words.
    pub lanes: Lanes,
    /// The view.
    pub frame: Binding,
    /// The active cuts and clip-surfaces.
    pub cut_table: Binding,
    /// The clip-surfaces in ray form.
    pub ray_table: Binding,
    /// The drawn parts, in table order, and the table position of each part of the scene.
    pub parts: Binding,
    /// Vertices of all parts.
    pub vertices: ResourceId,
    /// Indices of all parts in this frame, each part's preclassified triangles last.
    pub indices: ResourceId,
    /// Indices of all parts in their original order, independent of cuts.
    pub solid_indices: ResourceId,
    /// The groups of preclassified triangles, if there are any.
    pub preclassified: Option<Binding>,
    /// Trees of the closing triangles of open parts, if the inside test closes them.
    pub closings: Option<Binding>,
    /// The heights of all reliefs.
    pub heights: Binding,
    /// Bindings for reading heights at points, through the hardware sampler if that is selected.
    pub filtered_heights: Vec<Binding>,
    /// Depths at the resolution of the view.
    pub depth: ResourceId,
    /// Indices of the triangle that covers the picture.
    pub screen_indices: ResourceId,
    /// The mesh on the screen, if it was transformed before all other passes.
    pub on_screen: Option<OnScreen>,
}

impl<'a> SceneBuffers<'a> {
    /// Uploads the scene and poses the moving parts that are drawn; returns the reason if one cannot be posed.
    pub(crate) fn upload(
        plan: &mut Plan,
        input: &'a Input<'a>,
        lanes: Lanes,
    ) -> Result<Self, Refusal> {
        if lanes.words > MOST_LANE_WORDS {
            return Err(Refusal::amount(format!(
                "{} words of crossings per pixel are more than the {MOST_LANE_WORDS} that passes can process",
                lanes.words
            )));
        }
        let scene = Self::unposed(plan, input, lanes);
        pose_parts(plan, input, scene.vertices)?;
        Ok(scene)
    }

    /// As [`Self::upload`], for passes that read no vertices: moving parts are not posed.
    pub(crate) fn unposed(plan: &mut Plan, input: &'a Input<'a>, lanes: Lanes) -> Self {
        let model = input.model;
        let mut upload = |name: &'static str, role, clock, contents| {
            let id = plan.add_resource(Resource::upload(name, role, contents, clock));
            Binding::read(name, id)
        };
        let frame = Contents::from_values(&[pack::frame(input.view, &input.active_cuts.cut_box)]);
        let frame = upload("frame", BufferRole::Uniform, Clock::Frame, frame);
        let vertices = upload(
            "vertices",
            BufferRole::Vertex,
            Clock::Solid,
            model.vertices.clone(),
        );
        let indices = upload(
            "indices",
            BufferRole::Index,
            Clock::Solid,
            input.with_closings(&model.indices),
        );
        let sorted = input.sorted_indices().map(|sorted| {
            let sorted = upload(
                "sorted indices",
                BufferRole::Index,
                Clock::Cut,
                input.with_closings(sorted),
            );
            sorted.resource
        });
        let cut_table = upload(
            "cut_table",
            BufferRole::Uniform,
            Clock::Cut,
            cut_table(input),
        );
        let ray_table = upload(
            "ray_table",
            BufferRole::Uniform,
            Clock::Frame,
            ray_table(input),
        );
        let parts = upload(
            "parts",
            BufferRole::Storage,
            Clock::Cut,
            parts(input, &lanes),
        );
        let preclassified = (input.preclassified.as_ref()).map(|_| {
            upload(
                "preclassified",
                BufferRole::Uniform,
                input.preclassified_clock(),
                input.preclassified_table(),
            )
        });
        let closings = input.closings.as_ref().map(|closings| {
            upload(
                "closings",
                BufferRole::Storage,
                Clock::Solid,
                closings.trees.clone(),
            )
        });
        let heights = upload(
            "heights",
            BufferRole::Storage,
            Clock::Cut,
            model.heights.clone(),
        );
        let filtered_heights = match input.sampled() {
            None => vec![heights.clone()],
            Some(maps) => maps.upload(plan, model.heights.clone()),
        };
        let format = Format::Depth32Float;
        let depth = Resource::texture("surface_depth", input.view.size_px, 1, format, Clock::Frame);
        let depth = plan.add_resource(depth);
        let triangle = Contents::from_values(&[0_u32, 1, 2]);
        let triangle =
            Resource::own_upload("screen indices", BufferRole::Index, triangle, Clock::Cut);
        Self {
            input,
            lanes,
            frame,
            cut_table,
            ray_table,
            parts,
            vertices: vertices.resource,
            indices: sorted.unwrap_or(indices.resource),
            solid_indices: indices.resource,
            preclassified,
            heights,
            filtered_heights,
            depth,
            closings,
            screen_indices: plan.add_resource(triangle),
            on_screen: None,
        }
    }

    /// The pixels that a pass over the frame's pixels processes: the file that fills `cutaway::share`, the dispatch, and the list of
    /// touched tiles if only these are processed.
    pub(crate) fn pixels(&self) -> (&'static str, Work, Option<Binding>) {
        match &self.on_screen {
            Some(on_screen) => {
                let touched = on_screen.touched;
                let tiles = Some(touched.binding(Access::Read));
                ("lib/share/touched.wgsl", touched.shared(), tiles)
            }
            None => {
                let picture = Work::over(self.input.view.size_px);
                ("lib/share/picture.wgsl", picture, None)
            }
        }
    }

    /// The mesh of all parts, for draws of the frame: vertices and indices.
    pub(crate) fn mesh(&self) -> (Vertices, ResourceId) {
        (Vertices::Mesh(self.vertices), self.indices)
    }

    /// The mesh of all parts, for draws on the clock of the solid.
    pub(crate) fn solid_mesh(&self) -> (Vertices, ResourceId) {
        (Vertices::Mesh(self.vertices), self.solid_indices)
    }

    /// The mesh of all parts in storage bindings, for passes on a clock.
    pub(crate) fn mesh_in_storage(&self, clock: Clock) -> [Binding; 2] {
        let indices = match clock {
            Clock::Frame => self.indices,
            Clock::Solid | Clock::Cut => self.solid_indices,
        };
        [
            Binding::read("vertices", self.vertices),
            Binding::read("indices", indices),
        ]
    }
}

fn cut_table(input: &Input<'_>) -> Contents {
    let (active_cuts, model) = (&input.active_cuts, input.model);
    let mut table = CutTable::zeroed();
    table.surface_count = active_cuts.surfaces.len() as u32;
    table.cut_count = active_cuts.cuts.len() as u32;
    table.has_normals = u32::from(input.has_cutters());
    for (i, bits) in active_cuts.cuts.iter().enumerate() {
        table.surfaces_of_cut[i / 4][i % 4] = *bits;
    }
    let reach = input.reach();
    for (slot, number) in table.surfaces.iter_mut().zip(&active_cuts.surfaces) {
        let surface = &model.prepared.surfaces[*number];
        *slot = pack::clip_surface(surface, *number, model.first_texel[*number], reach);
    }
    Contents::from_values(&[table])
}

fn ray_table(input: &Input<'_>) -> Contents {
    let surfaces = input.active_cuts.surfaces.iter();
    let surfaces = surfaces.map(|number| &input.model.prepared.surfaces[*number]);
    Contents::from_values(&[pack::ray_table(surfaces, input.view)])
}

fn parts(input: &Input<'_>, lanes: &Lanes) -> Contents {
    let (active_cuts, style) = (&input.active_cuts, &input.model.prepared.style);
    let prepared = &input.model.prepared.parts;
    let mut rows: Vec<Part> = (active_cuts.order.iter().enumerate())
        .map(|(place, rank)| {
            let part = &prepared[*rank];
            let [lane_word, lane_shift] = lanes.of_place(place);
            Part {
                cuts: active_cuts.cuts_of(*rank),
                lane_word,
                lane_shift,
                part: part.part as u32,
                closing: input.closing_of(*rank).unwrap_or(NO_CLOSING),
                is_nonzero: u32::from(part.fill == Fill::Nonzero),
                color: style.surface_color(&part.material).extend(1.0).to_array(),
                cap_color: style.cap_color(&part.material).extend(1.0).to_array(),
                ..Part::zeroed()
            }
        })
        .collect();
    // One row per part of the scene, drawn or not, because part numbers in layers are looked up here.
    rows.resize(rows.len().max(prepared.len()), Part::zeroed());
    for (place, rank) in active_cuts.order.iter().enumerate() {
        rows[prepared[*rank].part].place = place as u32;
    }
    let of_closed = input.closed_parts().iter().map(|closed| Part {
        cuts: input.cut_of_everything(),
        ..rows[active_cuts.place_of(closed.rank)]
    });
    rows.extend(of_closed.collect::<Vec<_>>());
    Contents::from_values(&or_one(rows))
}

/// WebGPU has no empty bindings: a table without rows gets one row of zeros.
pub(crate) fn or_one<T: Zeroable>(mut rows: Vec<T>) -> Vec<T> {
    if rows.is_empty() {
        rows.push(T::zeroed());
    }
    rows
}
