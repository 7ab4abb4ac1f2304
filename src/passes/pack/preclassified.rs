//! Preclassified triangles as uploads: a part's triangles with the same classification are stored together, after its other indices. So are
//! coincident triangles, of which the one facing the eye is shown, and those in a plane that parts share
//! ([`SharedPlanes`](crate::scene::SharedPlanes)), of which the part first in rank is shown.
//!
//! For a triangle in a clip-surface, or right next to it, its side of the clip-surface is known beforehand
//! ([`PreclassifiedTriangle`](crate::scene::PreclassifiedTriangle)). Fragments are identified by their draw: a group has a draw of
//! its own, or a row in the compute rasteriser's table; all other triangles are drawn as usual. Without preclassified triangles
//! there is no group, no pass and no binding.
//!
//! Cost per cut: one test of every vertex of the parts that a flat clip-surface passes through, and, if a triangle is preclassified, a copy
//! of the part's indices. For this, parts that the device places without bending are also placed here.
//!
//! Cannot: distinguish more than [`MOST_PRECLASSIFIED_GROUPS`](crate::plan::pack::MOST_PRECLASSIFIED_GROUPS) parts and groups (others keep
//! their depths). A part's face that is coplanar with a thin cutter's face and next to it may be mistaken for one that lies in it.

use super::classifiers::{ClassifiedBy, ClassifiedGroup, Classifiers, NumberedSurface};
use super::packed::{Packed, Room};
use crate::plan::{Contents, INDEX_BYTES, Piece};
use crate::scene::{Prepared, PreparedPart};

/// The preclassified triangles of a scene.
#[derive(Clone, Debug)]
pub(crate) struct PreclassifiedTriangles {
    /// Groups by rank, with their ranges of `indices`.
    pub(crate) groups: Vec<Vec<ClassifiedGroup>>,
    /// Indices of all parts.
    pub(crate) indices: Contents,
}

impl PreclassifiedTriangles {
    /// The preclassified triangles of a scene, reusing whatever is still valid; `None` if no triangle is preclassified.
    pub(crate) fn of(
        prepared: &Prepared,
        packed: &[Packed],
        rooms: &[Room],
        before: Option<&Self>,
    ) -> Option<Self> {
        let by = |(rank, part): (usize, &PreparedPart)| Classifiers {
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
            let moved = groups.map(|g| ClassifiedGroup {
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

/// The clip-surfaces close enough to a part to classify some of its triangles.
fn surfaces_near(prepared: &Prepared, part: &PreparedPart) -> Vec<NumberedSurface> {
    if part.is_posed {
        return Vec::new();
    }
    let numbers = part.cuts.iter().flat_map(|c| &prepared.cuts[*c].surfaces);
    let classifying = |number: &usize| {
        let surface = &prepared.surfaces[*number];
        match &surface.volume {
            Some(volume) => Some(ClassifiedBy::Volume(volume.clone())),
            None => {
                let flat = surface.flat();
                let flat = flat.filter(|f| f.comes_near(&part.bounds, part.plane_tolerance));
                flat.map(ClassifiedBy::Flat)
            }
        }
    };
    numbers
        .filter_map(|n| Some((*n as u16, classifying(n)?)))
        .collect()
}
