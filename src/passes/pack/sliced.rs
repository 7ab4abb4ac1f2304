//! Reusable slicing data of a part: its slicer, made when first needed, its latest sections, and its triangles sorted by the
//! latest flat clip-surfaces that classify them.
//!
//! A part keeps them as long as its mesh, pose and placement stay the same ([`Model::updated`](super::model::Model::updated)), however
//! cuts and cameras change. So a moving camera slices nothing, and a moving plane reuses the slicer.
//! A part that the device poses is also posed here, in f64, when it is sliced: each step of its motion then costs as much as
//! its first section. Memory: that of the slicer and of at most [`MOST_KNOWN`] sections.

use std::fmt;
use std::sync::{Arc, OnceLock};

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::classifiers::{Classifiers, Sorted};
use super::packed_closing::PackedClosing;
use super::vertex::Vertex;
use crate::plan::Piece;
use crate::plan::pack::MAX_SURFACES;
use crate::scene::memo::Memo;
use crate::scene::{Bounds, Fill, Part, PreparedPart, SceneSpace};
use crate::slice::{Section, SectionDefect, SlicePlane, Slicer};

/// Number of cached sections: as many as one frame can request.
const MOST_KNOWN: usize = MAX_SURFACES;

/// Margin around a part's box within which its section may be doubtful, as a share of the box's radius.
const DOUBT_MARGIN: f64 = 1e-3;

/// Curves that stay this close to their first point are rounding errors, as a share of the radius of the part's box.
const SPECK: f64 = 1e-6;

/// Section of a part by a plane, packed for upload.
#[derive(Clone)]
pub(crate) struct PackedSection {
    /// In the format of [`Vertices::Mesh`](crate::plan::Vertices::Mesh), in scene space; no shader reads their normals.
    pub(crate) vertices: Arc<[u8]>,
    pub(crate) vertex_count: u32,
    /// Three per triangle: first the section's triangles, then triangles that cover everything in which its plane can meet the part.
    pub(crate) indices: Arc<[u8]>,
    /// Number of indices of the section.
    pub(crate) index_count: u32,
    /// Number of indices after those of the section; 0 unless a cap may be missing somewhere, or may be drawn where there should be none.
    pub(crate) doubt_count: u32,
}

/// The slicer of a part, and its recent sections.
pub(crate) struct Sliced {
    /// Original part, if the device poses it.
    posed: Option<(Part, SceneSpace)>,
    /// Box of the posed vertices, computed on first use.
    bounds: OnceLock<Bounds>,
    slicer: OnceLock<Slicer>,
    /// Sections by plane and rule.
    pub(crate) sections: Memo<(SlicePlane, Fill), Arc<PackedSection>>,
    sorted: Memo<Classifiers, Option<Arc<Sorted>>>,
    /// Tree of the closing triangles, if the part is open.
    closing_tree: OnceLock<Arc<[u8]>>,
}

impl Default for Sliced {
    fn default() -> Self {
        Self {
            posed: None,
            bounds: OnceLock::new(),
            slicer: OnceLock::new(),
            sections: Memo::with_capacity(MOST_KNOWN),
            sorted: Memo::with_capacity(1),
            closing_tree: OnceLock::new(),
        }
    }
}

impl fmt::Debug for Sliced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self.slicer.get() {
            Some(_) => "sliced",
            None => "not sliced",
        })
    }
}

impl Sliced {
    /// Slicing data of a part that the device poses.
    pub(crate) fn posed(part: &Part, space: &SceneSpace) -> Self {
        Self {
            posed: Some((part.clone(), *space)),
            ..Self::default()
        }
    }

    /// Returns true if a part has the same mesh, motion and placement as this one.
    pub(crate) fn stands_as(&self, part: &Part, space: &SceneSpace) -> bool {
        self.posed.as_ref().is_some_and(|(known, known_space)| {
            known.pose == part.pose
                && known.world_from_part == part.world_from_part
                && known_space == space
        })
    }

    /// The part's indices, preclassified triangles last; `None` if no triangle is preclassified.
    pub(crate) fn sorted(
        &self,
        part: &PreparedPart,
        by: &Classifiers,
        indices: (&[u8], &[u32]),
    ) -> Option<Arc<Sorted>> {
        self.sorted.get_or_make(by.clone(), |by| {
            let sort = |at: &[Vec3]| {
                let mesh = (at, part.triangles.as_slice());
                Sorted::of(by, mesh, part.plane_tolerance, indices)
            };
            let sorted = match &self.posed {
                Some((of, space)) if !by.surfaces.is_empty() => {
                    let at: Vec<Vec3> = (positions_of(of, space).iter())
                        .map(|p| p.as_vec3())
                        .collect();
                    sort(&at)
                }
                _ => sort(&part.positions),
            };
            sorted.map(Arc::new)
        })
    }

    /// The tree of the part's closing triangles.
    pub(crate) fn closing_tree(&self, part: &PreparedPart, closing: &PackedClosing) -> Arc<[u8]> {
        let tree = || match &self.posed {
            Some((of, space)) => {
                let positions = positions_of(of, space);
                let positions: Vec<Vec3> = positions.iter().map(|p| p.as_vec3()).collect();
                closing.tree(&positions)
            }
            None => closing.tree(&part.positions),
        };
        self.closing_tree.get_or_init(tree).clone()
    }

    /// Returns true if the slicer has been made.
    pub(crate) fn has_slicer(&self) -> bool {
        self.slicer.get().is_some()
    }

    /// The smallest box around the part in scene space. The stored box of a part that the device poses is larger, because it is found
    /// without vertices; here the vertices are posed, once per pose.
    pub(crate) fn bounds(&self, part: &PreparedPart) -> Bounds {
        match &self.posed {
            None => part.bounds,
            Some((of, space)) => *(self.bounds)
                .get_or_init(|| Bounds::from_points(positions_of(of, space).iter().copied())),
        }
    }

    /// Makes the slicer if there is none yet.
    pub(crate) fn prepare(&self, part: &PreparedPart) {
        self.slicer.get_or_init(|| self.new_slicer(part));
    }

    /// A slicer of the part; if the device poses the part, it is posed here first.
    pub(crate) fn new_slicer(&self, part: &PreparedPart) -> Slicer {
        let positions: Vec<DVec3> = match &self.posed {
            Some((part, space)) => positions_of(part, space),
            None => part.positions.par_iter().map(|p| p.as_dvec3()).collect(),
        };
        Slicer::new(positions, &part.triangles).in_scene(SceneSpace::ITSELF, part.plane_tolerance)
    }

    /// Slices the part, and fills the section by the part's rule.
    pub(crate) fn slice(&self, part: &PreparedPart, plane: &SlicePlane) -> PackedSection {
        let slicer = self.slicer.get_or_init(|| self.new_slicer(part));
        let cap = slicer.cap_by(plane, part.fill);
        PackedSection::of(&cap, plane, &part.bounds)
    }
}

/// Positions of a part's vertices in scene space, as in the exact reference.
fn positions_of(part: &Part, space: &SceneSpace) -> Vec<DVec3> {
    let mesh = part.posed_mesh();
    let placed = |p: &DVec3| space.point(part.world_from_part.transform_point3(*p));
    let at = mesh.positions.par_iter().map(placed);
    at.map(|p| p.as_vec3().as_dvec3()).collect()
}

impl PackedSection {
    fn of(section: &Section, plane: &SlicePlane, bounds: &Bounds) -> Self {
        let doubted = match is_doubtful(section, bounds) {
            true => plane.across(&with_margin(bounds)),
            false => Vec::new(),
        };
        let first = section.points.len() as u32;
        let fan = (first + 2..first + doubted.len() as u32).map(|i| [first, i - 1, i]);
        let own = section.triangles.iter().copied();
        let triangles: Vec<[u32; 3]> = own.chain(fan).collect();
        let vertex = |p: DVec3| Vertex {
            position: p.as_vec3().to_array(),
            normal: 0,
        };
        let lifted = |p: &DVec2| vertex(plane.point(*p));
        let vertices: Vec<Vertex> = (section.points.iter().map(lifted))
            .chain(doubted.iter().map(lifted))
            .collect();
        let indices = triangles.as_flattened();
        let index_count = 3 * section.triangles.len() as u32;
        Self {
            vertex_count: vertices.len() as u32,
            index_count,
            doubt_count: indices.len() as u32 - index_count,
            vertices: Piece::from_values(0, &vertices).bytes,
            indices: Piece::from_values(0, indices).bytes,
        }
    }
}

/// Returns true if some of the part met by the plane may lack a visible cap. An open curve no longer than rounding bounds nothing: it
/// comes from a triangle without area, two of whose sides meet the plane in one point.
fn is_doubtful(section: &Section, bounds: &Bounds) -> bool {
    let least = bounds.radius() * SPECK;
    let is_speck = |chain: &Vec<u32>| {
        let mut points = chain.iter().map(|i| section.points[*i as usize]);
        let first = points.next().unwrap_or_default();
        points.all(|p| p.distance(first) <= least)
    };
    let is_open = |d: &SectionDefect| matches!(d, SectionDefect::Open { .. });
    let mut losses = section.defects.iter().filter(|d| d.loses_cap());
    losses.any(|d| !is_open(d)) || !section.open.iter().all(is_speck)
}

/// A box with a margin for points that rounding moves outside.
fn with_margin(bounds: &Bounds) -> Bounds {
    let margin = DVec3::splat(bounds.radius() * DOUBT_MARGIN);
    Bounds {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}
