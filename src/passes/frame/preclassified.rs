//! The preclassified triangles of a frame: the groups of the drawn parts, their table, and the draws of groups and all other triangles
//! ([`PreclassifiedTriangles`](crate::passes::pack::preclassified::PreclassifiedTriangles)).

use bytemuck::Zeroable;

use super::input::Input;
use crate::passes::pack::classifiers::{ClassifiedGroup, NORMAL_STEPS};
use crate::plan::pack::{MOST_PRECLASSIFIED_GROUPS, PreclassifiedGroup};
use crate::plan::{Clock, Contents, Draw};
use crate::scene::Side;

/// A group of preclassified triangles, with the rank of its part.
pub(crate) type GroupOfPart<'a> = (usize, &'a ClassifiedGroup);

impl<'a> Input<'a> {
    /// The groups of the drawn parts, in table order, for as many parts as the table has room for. None if no active clip-surface
    /// classifies any of these parts' triangles, none coincide, and none share a plane.
    pub(crate) fn find_preclassified(&self) -> Option<Vec<GroupOfPart<'a>>> {
        let (model, order) = (self.model, &self.active_cuts.order);
        let of_parts = &model.preclassified.as_ref()?.groups;
        let classifies = |group: &ClassifiedGroup| {
            let [surfaces, _, cutters, _] = self.bits_of(group);
            group.lie.is_doubled || group.lie.plane.is_some() || surfaces | cutters != 0
        };
        if !order
            .iter()
            .any(|rank| of_parts[*rank].iter().any(classifies))
        {
            return None;
        }
        // Either all groups of a part are included or none; parts and groups together fit the compute rasteriser's rows.
        let most =
            MOST_PRECLASSIFIED_GROUPS.saturating_sub(order.len() + self.closed_parts().len());
        let mut all = Vec::new();
        for rank in order {
            let groups = &of_parts[*rank];
            if all.len() + groups.len() <= most {
                all.extend(groups.iter().map(|g| (*rank, g)));
            }
        }
        Some(all)
    }

    /// The groups that the frame classifies.
    pub(crate) fn preclassified_groups(&self) -> &[GroupOfPart<'a>] {
        self.preclassified.as_deref().unwrap_or_default()
    }

    /// Four bit sets of clip-surfaces for a group: those that classify it, those on whose removed side it lies, cutters that share
    /// faces with it, and clip-surfaces that it lies in.
    fn bits_of(&self, group: &ClassifiedGroup) -> [u32; 4] {
        let mut bits = [0; 4];
        for (slot, number) in self.active_cuts.surfaces.iter().enumerate() {
            let is_shared = group.lie.in_cutters.contains(&(*number as u16));
            bits[2] |= u32::from(is_shared) << slot;
            // For coincident triangles the depth test decides which one is visible.
            let is_alone = !group.lie.is_doubled && group.lie.plane.is_none();
            let is_flush = is_alone && group.lie.flush.contains(&(*number as u16));
            bits[3] |= u32::from(is_flush) << slot;
            let side = group
                .lie
                .sides
                .iter()
                .find(|(n, _)| usize::from(*n) == *number);
            if let Some((_, side)) = side {
                bits[0] |= 1 << slot;
                bits[1] |= u32::from(*side == Side::Removed) << slot;
            }
        }
        bits
    }

    /// The table of groups.
    pub(crate) fn preclassified_table(&self) -> Contents {
        let mut table = vec![PreclassifiedGroup::zeroed(); MOST_PRECLASSIFIED_GROUPS];
        for (row, (rank, group)) in table.iter_mut().zip(self.preclassified_groups()) {
            let [surfaces, removed, cutters, flush] = self.bits_of(group);
            let [x, y, z] = group.lie.normal.map(|n| n as f32 / NORMAL_STEPS);
            *row = PreclassifiedGroup {
                place: self.active_cuts.place_of(*rank) as u32,
                surfaces,
                removed,
                flush,
                doubled: u32::from(group.lie.is_doubled),
                cutters,
                padding: [0; 2],
                normal: [x, y, z, 0.0],
                plane: self.plane_of(*rank, group),
            };
        }
        Contents::from_values(&table)
    }

    /// The plane that a group shares with other parts, encoded as [`PreclassifiedGroup::plane`].
    fn plane_of(&self, rank: usize, group: &ClassifiedGroup) -> [f32; 4] {
        let shared = self.model.prepared.shared.planes();
        let plane = group.lie.plane.map(|number| &shared[usize::from(number)]);
        let seen = plane.and_then(|plane| Some((plane, plane.in_view(self.view)?)));
        seen.map_or([0.0; 4], |(plane, [right, down, corner])| {
            let centre = corner + 0.5 * (right + down);
            [right, down, centre, f64::from(plane.level(rank))].map(|v| v as f32)
        })
    }

    /// Clock of the group table: the depths of shared planes depend on the view.
    pub(crate) fn preclassified_clock(&self) -> Clock {
        let mut groups = self.preclassified_groups().iter();
        match groups.any(|(_, group)| group.lie.plane.is_some()) {
            true => Clock::Frame,
            false => Clock::Cut,
        }
    }

    /// The indices of all parts, each part's preclassified triangles last; `None` if the frame preclassifies none.
    pub(crate) fn sorted_indices(&self) -> Option<&Contents> {
        let preclassified = self.model.preclassified.as_ref();
        preclassified
            .filter(|_| self.preclassified.is_some())
            .map(|s| &s.indices)
    }

    /// Draws of the triangles that are in no group, for the parts with given ranks; the instance is the part's position in the table.
    pub(crate) fn draws_of_rest(&self, ranks: &[usize]) -> Vec<Draw> {
        let mut draws = self.draws_of(ranks);
        for (draw, rank) in draws.iter_mut().zip(ranks) {
            draw.indices.end = self.end_of_rest(*rank);
        }
        if self.preclassified.is_some() {
            draws.retain(|d| !d.indices.is_empty());
        }
        draws
    }

    /// End of the index range of a part's triangles that are in no group; `rank` identifies the part.
    pub(crate) fn end_of_rest(&self, rank: usize) -> u32 {
        let mut groups = self.preclassified_groups().iter();
        let first = groups.find(|(r, _)| *r == rank);
        first.map_or(self.model.ranges[rank].indices.end, |(_, g)| {
            g.indices.start
        })
    }

    /// The draws of the groups of the parts with given ranks; the instance is the group's number.
    pub(crate) fn draws_of_groups(&self, ranks: &[usize]) -> Vec<Draw> {
        let numbered = self.preclassified_groups().iter().enumerate();
        numbered
            .filter(|(_, (rank, _))| ranks.contains(rank))
            .map(|(number, (rank, group))| Draw {
                indices: group.indices.clone(),
                instance: number as u32,
                ..self.draws_of(&[*rank]).remove(0)
            })
            .collect()
    }
}
