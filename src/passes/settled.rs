//! Settled triangles as uploads: those of a part that lie alike go together, at the end of its indices; and those that lie on each
//! other likewise, of which the one that faces the eye is to be seen, and those in a plane that parts share
//! ([`SharedPlanes`](crate::scene::SharedPlanes)), of which the first part in rank is.
//!
//! On which side of a clip-surface a triangle lies that is in it, or just beside it, is known
//! ([`Settled`](crate::scene::Settled)). Its fragments are identified by the draw that they belong to: a group of triangles has a draw of
//! its own, or a row in the table of the compute rasteriser, and every other triangle of the scene is drawn as ever. Where no triangle
//! is settled there is no group, no pass and no binding.
//!
//! Per cut: a look at every vertex of the parts that a flat clip-surface passes through, and where something is settled the indices of
//! the part once more. Parts that the device places without bending them are placed here as well for that.
//!
//! Cannot: tell more than [`MOST_SETTLED_GROUPS`] parts and groups apart; the triangles of further parts are left to their depths. A face of a
//! part beside a face of a thin cutter, in one plane with it, may be taken for a face in it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use bytemuck::Zeroable;
use glam::Vec3;

use super::Input;
use super::packed::{Packed, Room};
use crate::plan::pack::{MOST_SETTLED_GROUPS, SettledGroup};
use crate::plan::{Clock, Contents, Draw, INDEX_BYTES, Piece};
use crate::scene::{FlatSurface, Prepared, PreparedPart, PreparedVolume, Side};

/// What triangles may be settled by.
#[derive(Clone, Debug)]
pub(super) enum Settling {
    /// A clip-surface without relief.
    Flat(FlatSurface),
    /// A cutter.
    Volume(Arc<PreparedVolume>),
}

impl PartialEq for Settling {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Flat(a), Self::Flat(b)) => a == b,
            (Self::Volume(a), Self::Volume(b)) => Arc::ptr_eq(&a.positions, &b.positions),
            _ => false,
        }
    }
}

/// A clip-surface with its number.
pub(super) type Numbered = (u16, Settling);

/// What triangles of a part may be settled by.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settlers {
    /// Clip-surfaces that pass close by.
    pub(super) surfaces: Vec<Numbered>,
    /// Triangles in planes that parts share, each with the number of its plane.
    pub(super) shared: Arc<[(u32, u16)]>,
}

impl Settlers {
    /// Whether there is nothing.
    pub(super) fn is_empty(&self) -> bool {
        self.surfaces.is_empty() && self.shared.is_empty()
    }
}

/// So many steps of a component of a normal tell planes apart.
const NORMAL_STEPS: f32 = 4096.0;

/// How triangles lie.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Lie {
    /// Sides by number of the clip-surface.
    sides: Vec<(u16, Side)>,
    /// Numbers of the clip-surfaces that they lie in.
    flush: Vec<u16>,
    /// Numbers of the cutters in faces of which they lie.
    in_cutters: Vec<u16>,
    /// Normal of those faces, either way round, in steps of 1 / [`NORMAL_STEPS`].
    normal: [i32; 3],
    /// On other triangles.
    is_doubled: bool,
    /// Number of the plane that they share with triangles of other parts.
    plane: Option<u16>,
}

/// Triangles of a part that lie alike.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Group {
    lie: Lie,
    pub(super) indices: Range<u32>,
}

/// The indices of a part with its settled triangles at the end.
#[derive(Debug)]
pub(super) struct Sorted {
    /// With ranges among the part's own indices, in order.
    groups: Vec<Group>,
    indices: Arc<[u8]>,
}

impl Sorted {
    /// Sorts the triangles of a part; nothing where none is settled. `indices` are the triangles as they are drawn, in the same order;
    /// `doubled` are those that lie on another one.
    pub(super) fn of(
        by: &Settlers,
        (positions, triangles): (&[Vec3], &[[u32; 3]]),
        plane_tolerance: f64,
        (indices, doubled): (&[u8], &[u32]),
    ) -> Option<Self> {
        let mut lies: BTreeMap<u32, Lie> = BTreeMap::new();
        for (number, surface) in &by.surfaces {
            match surface {
                Settling::Flat(flat) => {
                    for settled in flat.settled(positions, triangles, plane_tolerance) {
                        let lie = lies.entry(settled.triangle).or_default();
                        lie.sides.push((*number, settled.side));
                        if settled.is_in {
                            lie.flush.push(*number);
                        }
                    }
                }
                Settling::Volume(volume) => {
                    for triangle in volume.shared_faces(positions, triangles) {
                        let lie = lies.entry(triangle).or_default();
                        lie.in_cutters.push(*number);
                        lie.normal =
                            normal_of(triangles[triangle as usize].map(|i| positions[i as usize]));
                    }
                }
            }
        }
        for triangle in doubled {
            lies.entry(*triangle).or_default().is_doubled = true;
        }
        for (triangle, plane) in by.shared.iter() {
            lies.entry(*triangle).or_default().plane = Some(*plane);
        }
        if lies.is_empty() {
            return None;
        }
        let drawn: &[[u32; 3]] = bytemuck::cast_slice(indices);
        let rest = (0..drawn.len() as u32).filter(|t| !lies.contains_key(t));
        let mut sorted: Vec<[u32; 3]> = rest.map(|t| drawn[t as usize]).collect();
        let mut alike: BTreeMap<Lie, Vec<u32>> = BTreeMap::new();
        for (triangle, lie) in lies {
            alike.entry(lie).or_default().push(triangle);
        }
        let mut groups = Vec::new();
        for (lie, triangles) in alike {
            let first = 3 * sorted.len() as u32;
            sorted.extend(triangles.iter().map(|t| drawn[*t as usize]));
            groups.push(Group {
                lie,
                indices: first..3 * sorted.len() as u32,
            });
        }
        Some(Self {
            groups,
            indices: Piece::from_values(0, sorted.as_flattened()).bytes,
        })
    }
}

/// The normal of a triangle, in steps, with the sign that makes its first component that is not 0 positive.
fn normal_of([a, b, c]: [Vec3; 3]) -> [i32; 3] {
    let cross = (b - a).as_dvec3().cross((c - a).as_dvec3());
    let steps = (cross.normalize_or_zero().as_vec3() * NORMAL_STEPS).round();
    let steps = steps.to_array().map(|s| s as i32);
    let first = steps.into_iter().find(|s| *s != 0).unwrap_or(0);
    steps.map(|s| s * first.signum())
}

/// The settled triangles of a scene.
#[derive(Clone, Debug)]
pub(super) struct SettledParts {
    /// Groups by rank, with ranges of `indices`.
    groups: Vec<Vec<Group>>,
    /// Of all parts.
    indices: Contents,
}

impl SettledParts {
    /// Those of a scene, with what is still right of them; nothing where none is settled.
    pub(super) fn of(
        prepared: &Prepared,
        packed: &[Packed],
        rooms: &[Room],
        before: Option<&Self>,
    ) -> Option<Self> {
        let by = |(rank, part): (usize, &PreparedPart)| Settlers {
            surfaces: surfaces_near(prepared, part),
            shared: prepared.shared.faces(rank),
        };
        let sorted: Vec<_> = (prepared.parts.iter().enumerate())
            .map(|(rank, part)| packed[part.part].sorted(part, &by((rank, part))))
            .collect();
        if sorted.iter().all(Option::is_none) {
            return None;
        }
        let groups = prepared.parts.iter().zip(&sorted).map(|(part, sorted)| {
            let first = rooms[part.part].first_index;
            let groups = sorted.iter().flat_map(|s| &s.groups);
            let moved = groups.map(|g| Group {
                indices: first + g.indices.start..first + g.indices.end,
                ..g.clone()
            });
            moved.collect()
        });
        let mut pieces: Vec<Piece> = (prepared.parts.iter().zip(&sorted))
            .map(|(part, sorted)| Piece {
                offset: u64::from(rooms[part.part].first_index) * INDEX_BYTES,
                bytes: match sorted {
                    Some(sorted) => sorted.indices.clone(),
                    None => packed[part.part].indices.clone(),
                },
            })
            .collect();
        pieces.sort_by_key(|p| p.offset);
        let end = rooms.last().map_or(0, Room::end_index);
        let indices = Contents::in_pieces(u64::from(end) * INDEX_BYTES, pieces, true);
        Some(Self {
            groups: groups.collect(),
            indices: match before {
                Some(before) if before.indices == indices => before.indices.clone(),
                _ => indices,
            },
        })
    }
}

/// The clip-surfaces that pass by a part so close that they may settle some of it.
fn surfaces_near(prepared: &Prepared, part: &PreparedPart) -> Vec<Numbered> {
    if part.is_posed {
        return Vec::new();
    }
    let numbers = part.cuts.iter().flat_map(|c| &prepared.cuts[*c].surfaces);
    let settling = |number: &usize| {
        let surface = &prepared.surfaces[*number];
        match &surface.volume {
            Some(volume) => Some(Settling::Volume(volume.clone())),
            None => {
                let flat = surface.flat();
                let flat = flat.filter(|f| f.comes_near(&part.bounds, part.plane_tolerance));
                flat.map(Settling::Flat)
            }
        }
    };
    numbers
        .filter_map(|n| Some((*n as u16, settling(n)?)))
        .collect()
}

/// A group of settled triangles, with the rank of its part.
pub(crate) type GroupOfPart<'a> = (usize, &'a Group);

impl<'a> Input<'a> {
    /// The groups of the parts that are drawn, in table order: of as many parts as there are numbers for. None where no clip-surface that
    /// matters settles a triangle of these parts, none lie on each other, and none share a plane.
    pub(super) fn find_settled(&self) -> Option<Vec<GroupOfPart<'a>>> {
        let (model, order) = (self.model, &self.relevance.order);
        let of_parts = &model.settled.as_ref()?.groups;
        let settles = |group: &Group| {
            let [surfaces, _, cutters, _] = self.bits_of(group);
            group.lie.is_doubled || group.lie.plane.is_some() || surfaces | cutters != 0
        };
        if !order.iter().any(|rank| of_parts[*rank].iter().any(settles)) {
            return None;
        }
        // Of a part all groups or none; with the parts themselves no more than the compute rasteriser has rows for.
        let most = MOST_SETTLED_GROUPS.saturating_sub(order.len());
        let mut all = Vec::new();
        for rank in order {
            let groups = &of_parts[*rank];
            if all.len() + groups.len() <= most {
                all.extend(groups.iter().map(|g| (*rank, g)));
            }
        }
        Some(all)
    }

    /// The groups that the frame settles.
    pub(super) fn settled_groups(&self) -> &[GroupOfPart<'a>] {
        self.settled.as_deref().unwrap_or_default()
    }

    /// Bits of the clip-surfaces that settle a group, of those it lies on the removed side of, of cutters that it shares faces with, and
    /// of clip-surfaces that it lies in.
    fn bits_of(&self, group: &Group) -> [u32; 4] {
        let mut bits = [0; 4];
        for (slot, number) in self.relevance.surfaces.iter().enumerate() {
            let is_shared = group.lie.in_cutters.contains(&(*number as u16));
            bits[2] |= u32::from(is_shared) << slot;
            // Of triangles that lie on each other the depths tell which is seen.
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
    pub(super) fn settled_table(&self) -> Contents {
        let mut table = vec![SettledGroup::zeroed(); MOST_SETTLED_GROUPS];
        for (row, (rank, group)) in table.iter_mut().zip(self.settled_groups()) {
            let [surfaces, removed, cutters, flush] = self.bits_of(group);
            let [x, y, z] = group.lie.normal.map(|n| n as f32 / NORMAL_STEPS);
            *row = SettledGroup {
                place: self.relevance.place_of(*rank) as u32,
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

    /// The plane that a group shares with other parts, as [`SettledGroup::plane`] has it.
    fn plane_of(&self, rank: usize, group: &Group) -> [f32; 4] {
        let shared = self.model.prepared.shared.planes();
        let plane = group.lie.plane.map(|number| &shared[usize::from(number)]);
        let seen = plane.and_then(|plane| Some((plane, plane.in_view(self.view)?)));
        seen.map_or([0.0; 4], |(plane, [right, down, corner])| {
            let centre = corner + 0.5 * (right + down);
            [right, down, centre, f64::from(plane.level(rank))].map(|v| v as f32)
        })
    }

    /// How often the table of groups changes: depths of shared planes are those of a view.
    pub(super) fn settled_clock(&self) -> Clock {
        let mut groups = self.settled_groups().iter();
        match groups.any(|(_, group)| group.lie.plane.is_some()) {
            true => Clock::Frame,
            false => Clock::Cut,
        }
    }

    /// The indices of all parts with settled triangles at the end of each, where some are settled in the frame.
    pub(super) fn sorted_indices(&self) -> Option<&Contents> {
        let settled = self.model.settled.as_ref();
        settled
            .filter(|_| self.settled.is_some())
            .map(|s| &s.indices)
    }

    /// The draws of some parts less their groups, by rank; the instance is the part's place in the table.
    pub(crate) fn draws_of_rest(&self, ranks: &[usize]) -> Vec<Draw> {
        let mut draws = self.draws_of(ranks);
        for (draw, rank) in draws.iter_mut().zip(ranks) {
            draw.indices.end = self.end_of_rest(*rank);
        }
        if self.settled.is_some() {
            draws.retain(|d| !d.indices.is_empty());
        }
        draws
    }

    /// The end of the indices of a part less its groups, by rank.
    pub(super) fn end_of_rest(&self, rank: usize) -> u32 {
        let mut groups = self.settled_groups().iter();
        let first = groups.find(|(r, _)| *r == rank);
        first.map_or(self.model.ranges[rank].indices.end, |(_, g)| {
            g.indices.start
        })
    }

    /// The draws of the groups of some parts, by rank; the instance is the number of the group.
    pub(crate) fn draws_of_groups(&self, ranks: &[usize]) -> Vec<Draw> {
        let numbered = self.settled_groups().iter().enumerate();
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
