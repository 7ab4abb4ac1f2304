//! PreclassifiedTriangle triangles as uploads: those of a part that lie alike go together, at the end of its indices; and those that lie on each
//! other likewise, of which the one that faces the eye is to be seen, and those in a plane that parts share
//! ([`SharedPlanes`](crate::scene::SharedPlanes)), of which the first part in rank is.
//!
//! On which side of a clip-surface a triangle lies that is in it, or just next to it, is known
//! ([`PreclassifiedTriangle`](crate::scene::PreclassifiedTriangle)). Its fragments are identified by the draw that they belong to: a group of triangles has a draw of
//! its own, or a row in the table of the compute rasteriser, and every other triangle of the scene is drawn as ever. Where no triangle
//! is preclassified there is no group, no pass and no binding.
//!
//! Per cut: a look at every vertex of the parts that a flat clip-surface passes through, and where something is preclassified the indices of
//! the part once more. Parts that the device places without bending them are placed here as well for that.
//!
//! Cannot: distinguish more than [`MOST_PRECLASSIFIED_GROUPS`](crate::plan::pack::MOST_PRECLASSIFIED_GROUPS) parts and groups (others keep their
//! depths). A face of a part next to a face of a thin cutter, in one plane with it, may be taken for a face in it.

use super::classifiers::{ClassifiedBy, Classifiers, Group, Numbered};
use super::packed::{Packed, Room};
use crate::plan::{Contents, INDEX_BYTES, Piece};
use crate::scene::{Prepared, PreparedPart};

/// The preclassified triangles of a scene.
#[derive(Clone, Debug)]
pub(crate) struct PreclassifiedTriangles {
    /// Groups by rank, with ranges of `indices`.
    pub(crate) groups: Vec<Vec<Group>>,
    /// Indices of all parts.
    pub(crate) indices: Contents,
}

impl PreclassifiedTriangles {
    /// Those of a scene, with what is still right of them; nothing where none is preclassified.
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

/// The clip-surfaces that pass a part so closely that they may classify some of its triangles.
fn surfaces_near(prepared: &Prepared, part: &PreparedPart) -> Vec<Numbered> {
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
