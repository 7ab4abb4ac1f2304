//! Reusable slicing data of a part: its slicer, made when it is first sliced, the latest sections, and which of its triangles the
//! latest flat clip-surfaces classify.
//!
//! A part keeps both for as long as it keeps its mesh, its pose and its place ([`Model::updated`](super::model::Model::updated)), whatever
//! becomes of cuts and cameras. So a camera that moves slices nothing, and a plane that moves slices by what the slicer knows.
//! A part that the device poses is posed here as well, in f64, when it is sliced: each step of its motion then costs as much as
//! its first section. Memory: the slicer's, and that of [`MOST_KNOWN`] sections at most.

use std::fmt;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use super::classifiers::{Classifiers, Sorted};
use super::vertex::Vertex;
use crate::plan::Piece;
use crate::plan::pack::MAX_SURFACES;
use crate::scene::{Bounds, Fill, Part, PreparedPart, SceneSpace};
use crate::slice::{Section, SectionDefect, SlicePlane, Slicer};

/// Sections that are kept: as many as one frame can ask for.
const MOST_KNOWN: usize = MAX_SURFACES;

/// Distance beyond its box that doubt about a part reaches, as a share of the radius of the box.
const DOUBT_MARGIN: f64 = 1e-3;

/// Curves within this of their first point are rounding, as a share of the radius of the part's box.
const SPECK: f64 = 1e-6;

/// Section of a part by a plane, packed for upload.
#[derive(Clone)]
pub(crate) struct PackedSection {
    /// In the format of [`Vertices::Mesh`](crate::plan::Vertices::Mesh), in scene space; no shader reads their normals.
    pub(crate) vertices: Arc<[u8]>,
    pub(crate) vertex_count: u32,
    /// Three to a triangle: those of the section, and after them those of all that its plane can meet of the part.
    pub(crate) indices: Arc<[u8]>,
    /// Indices of the section.
    pub(crate) index_count: u32,
    /// Indices of all that the plane can meet of the part; none unless some of that may have no cap, or one where there should be
    /// none.
    pub(crate) doubt_count: u32,
}

/// A section, and what it was made by.
struct CachedSection {
    plane: SlicePlane,
    rule: Fill,
    section: Arc<PackedSection>,
}

/// The slicer of a part, and its sections of late.
#[derive(Default)]
pub(crate) struct Sliced {
    /// Source of a part that the device poses.
    posed: Option<(Part, SceneSpace)>,
    /// The box of the posed vertices, once it is needed.
    bounds: OnceLock<Bounds>,
    slicer: OnceLock<Slicer>,
    /// The latest last.
    known: Mutex<Vec<CachedSection>>,
    sorted: Mutex<Option<SortedBy>>,
}

/// Inputs and result of the last sorting of triangles.
struct SortedBy {
    by: Classifiers,
    sorted: Option<Arc<Sorted>>,
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

    /// Returns true if a part with the same mesh and motion stands as this one does.
    pub(crate) fn stands_as(&self, part: &Part, space: &SceneSpace) -> bool {
        self.posed.as_ref().is_some_and(|(known, known_space)| {
            known.pose == part.pose
                && known.world_from_part == part.world_from_part
                && known_space == space
        })
    }

    /// The section by a plane, filled by a rule, if it is known.
    pub(crate) fn known(&self, plane: &SlicePlane, rule: Fill) -> Option<Arc<PackedSection>> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |k: &CachedSection| k.plane == *plane && k.rule == rule;
        let at = known.iter().position(same)?;
        let latest = known.remove(at);
        let section = latest.section.clone();
        known.push(latest);
        Some(section)
    }

    /// Stores a section, replacing the least recently requested one.
    pub(crate) fn keep(&self, plane: SlicePlane, rule: Fill, section: Arc<PackedSection>) {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        // Two cuts may have the same plane.
        if known.iter().any(|k| k.plane == plane && k.rule == rule) {
            return;
        }
        if known.len() == MOST_KNOWN {
            known.remove(0);
        }
        known.push(CachedSection {
            plane,
            rule,
            section,
        });
    }

    /// The indices of the part with triangles that are preclassified at the end; nothing where none is.
    pub(crate) fn sorted(
        &self,
        part: &PreparedPart,
        by: &Classifiers,
        indices: (&[u8], &[u32]),
    ) -> Option<Arc<Sorted>> {
        let mut last = self.sorted.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some(last) if last.by == *by => last.sorted.clone(),
            _ => {
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
                let sorted = sorted.map(Arc::new);
                *last = Some(SortedBy {
                    by: by.clone(),
                    sorted: sorted.clone(),
                });
                sorted
            }
        }
    }

    /// Returns true if the slicer is made.
    pub(crate) fn has_slicer(&self) -> bool {
        self.slicer.get().is_some()
    }

    /// The smallest box around the part in scene space. That of a part which the device poses is larger, for it is found without its
    /// vertices; here they are posed, once for each pose.
    pub(crate) fn bounds(&self, part: &PreparedPart) -> Bounds {
        match &self.posed {
            None => part.bounds,
            Some((of, space)) => *(self.bounds)
                .get_or_init(|| Bounds::from_points(positions_of(of, space).iter().copied())),
        }
    }

    /// Makes the slicer, if there is none.
    pub(crate) fn prepare(&self, part: &PreparedPart) {
        self.slicer.get_or_init(|| self.new_slicer(part));
    }

    /// A slicer of the part; one that the device poses is posed for it.
    pub(crate) fn new_slicer(&self, part: &PreparedPart) -> Slicer {
        let positions: Vec<DVec3> = match &self.posed {
            Some((part, space)) => positions_of(part, space),
            None => part.positions.par_iter().map(|p| p.as_dvec3()).collect(),
        };
        Slicer::new(positions, &part.triangles).in_scene(SceneSpace::ITSELF, part.plane_tolerance)
    }

    /// Slices the part, and fills the section by its rule.
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

/// Returns true if some of the part met by the plane may lack a visible cap. An open curve no longer than rounding bounds nothing: a
/// triangle without area, of which two sides meet the plane in one place, leaves such curves.
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

/// A box with a margin for points that rounding moves out.
fn with_margin(bounds: &Bounds) -> Bounds {
    let margin = DVec3::splat(bounds.radius() * DOUBT_MARGIN);
    Bounds {
        min: bounds.min - margin,
        max: bounds.max + margin,
    }
}
