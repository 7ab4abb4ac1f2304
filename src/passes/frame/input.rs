//! Input from which a frame is recorded. It does not change while a plan is made; the handles of pass resources are kept separately.

use super::active_cuts::ActiveCuts;
use super::closings::Closings;
use super::preclassified::GroupOfPart;
use super::rasteriser::Rasteriser;
use super::refusal::Refusal;
use super::relief_walk::ReliefWalk;
use crate::passes::pack::model::Model;
use crate::plan::pack::{MOST_PLANES, most_box_margin};
use crate::plan::{Capacities, Draw};
use crate::scene::{Fill, HeightFilter, PreparedPart, View};

/// Input from which a frame is recorded.
#[derive(Clone, Debug)]
pub(crate) struct Input<'a> {
    /// The scene.
    pub model: &'a Model,
    pub view: &'a View,
    /// The cuts that affect the frame.
    pub active_cuts: ActiveCuts,
    /// Sizes of bounded buffers.
    pub capacities: &'a Capacities,
    /// Rasteriser of the mesh.
    pub rasteriser: Rasteriser,
    /// True if the compute rasteriser may use 64-bit atomics.
    pub wide_atomics: bool,
    /// How rays traverse reliefs; `None` chooses by the view.
    pub relief_walk: Option<ReliefWalk>,
    /// True if the crossing list is made even where a plane could be evaluated instead, including crossings that are near no part.
    pub keeps_list: bool,
    /// Interpolation of heights at points.
    pub height_filter: HeightFilter,
    /// The groups of preclassified triangles; none if the frame classifies nothing.
    pub preclassified: Option<Vec<GroupOfPart<'a>>>,
    /// Open parts that are closed for counting, if the inside test closes them.
    pub closings: Option<Closings>,
}

impl<'a> Input<'a> {
    /// A scene in a view, using only features that every device has; returns the reason if the scene exceeds a frame's limits.
    pub(crate) fn new(
        model: &'a Model,
        view: &'a View,
        capacities: &'a Capacities,
    ) -> Result<Self, Refusal> {
        let mut input = Self {
            model,
            view,
            active_cuts: ActiveCuts::new(&model.prepared, view)?,
            capacities,
            rasteriser: Rasteriser::Hardware,
            wide_atomics: false,
            relief_walk: None,
            keeps_list: false,
            height_filter: HeightFilter::Exact,
            preclassified: None,
            closings: None,
        };
        input.preclassified = input.find_preclassified();
        Ok(input)
    }

    /// Returns true if passes may intersect rays with the clip-surfaces, because these are a few planes, so that no list is needed. The
    /// GPU's own rasteriser needs a list, because only the list pass prepares its pixels for fragments, and hosts clip by lists.
    pub(crate) fn needs_no_list(&self) -> bool {
        self.rasteriser == Rasteriser::Compute
            && !self.keeps_list
            && (1..=MOST_PLANES).contains(&self.active_cuts.surfaces.len())
            && !self.has_reliefs()
            && !self.has_cutters()
    }

    /// Returns true if lists hold crossings with only one clip-surface, without stored normals.
    pub(crate) fn has_one_surface(&self) -> bool {
        self.active_cuts.surfaces.len() < 2 && !self.has_cutters()
    }

    /// Longest distance along which a ray is followed: through the box of the cut parts and its margins.
    pub(crate) fn reach(&self) -> f64 {
        self.active_cuts.cut_box.size().length() + 4.0 * most_box_margin(self.view.precision)
    }

    /// Number of pixels in the picture.
    pub(crate) fn pixel_count(&self) -> u64 {
        pixels(self.view.size_px)
    }

    /// Returns true if some active clip-surface is a relief.
    pub(crate) fn has_reliefs(&self) -> bool {
        let surfaces = &self.active_cuts.surfaces;
        surfaces.iter().any(|s| self.model.is_relief(*s))
    }

    /// Returns true if some active clip-surface is a cutter.
    pub(crate) fn has_cutters(&self) -> bool {
        let surfaces = &self.active_cuts.surfaces;
        surfaces.iter().any(|s| self.model.is_cutter(*s))
    }

    /// Returns true if some part that needs an inside test is filled by the nonzero rule.
    pub(crate) fn has_nonzero(&self) -> bool {
        let parts = &self.model.prepared.parts;
        let mut ranks = self.active_cuts.cut_parts().iter();
        ranks.any(|r| parts[*r].fill == Fill::Nonzero)
    }

    /// The first part that needs an inside test and whose box meets the near plane. The near plane is not limited to the picture.
    pub(crate) fn cut_part_in_near_plane(&self) -> Option<&PreparedPart> {
        let meets = |rank: usize| {
            let part = &self.model.prepared.parts[rank];
            // A posed part's box is conservative: the tight box can only be computed from its vertices.
            let is_met = self.view.near_plane_meets(&part.bounds)
                && (self.view).near_plane_meets(&self.model.sliced(rank).bounds(part));
            is_met.then_some(part)
        };
        self.active_cuts.cut_parts().iter().find_map(|r| meets(*r))
    }

    /// Returns true if overlaps of solids are shown and at least two parts could overlap.
    pub(crate) fn shows_overlaps(&self) -> bool {
        self.model.prepared.interference.is_some() && self.active_cuts.lanes > 1
    }

    /// Returns true if the picture is made pixel by pixel from the layers alone.
    pub(crate) fn is_plain(&self) -> bool {
        self.model.prepared.style.is_plain() && self.model.cap_materials.is_none()
    }

    /// The draws of the parts with given ranks; the instance is the part's position in the table.
    pub(crate) fn draws_of(&self, ranks: &[usize]) -> Vec<Draw> {
        ranks
            .iter()
            .map(|rank| {
                let range = &self.model.ranges[*rank];
                Draw {
                    indices: range.indices.clone(),
                    base_vertex: range.base_vertex,
                    vertex_count: range.vertex_count,
                    instance: self.active_cuts.place_of(*rank) as u32,
                    arguments: None,
                }
            })
            .collect()
    }
}

/// `1 part`, `2 parts`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Number of pixels in a picture.
pub(crate) fn pixels(size: [u32; 2]) -> u64 {
    u64::from(size[0]) * u64::from(size[1])
}
