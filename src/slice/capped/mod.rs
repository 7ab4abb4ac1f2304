//! Divides a mesh into the kept and the removed half, each a mesh with caps.
//!
//! A cut removes the intersection of its planes' removed sides, a scene the union of its cuts. Regions are removed one after the
//! other, and each by one plane after the other: what is above a plane stays, what is below all of them is removed, and the caps of the
//! removed part, reversed, close what stays ([`complex`]). Throughout, the triangles form one surface, so that no wall
//! remains between touching regions; triangles divided by planes outside the planes' regions are reassembled ([`restore`]), and edges
//! of nearly zero length that the division made are collapsed ([`slivers`]).
//!
//! A closed mesh whose faces agree about the outside gives two closed meshes whose faces do too, whatever the planes meet and however often
//! the mesh intersects itself. Both share their cap vertices to the last bit, and their volumes add up to that of the mesh except
//! for rounding. An open mesh stays open where it was, and where a section curve does not close.
//!
//! Cost: each plane tests all triangles, in parallel; then n log n in the elements it meets. Memory: about 60 bytes per triangle on top of
//! the mesh and the result.
//!
//! Reliefs and cutters are not planes: parts that they cut are divided by Boolean operations, with the feature `boolean`.
//!
//! Limits: 2^31 triangles. Triangles with coordinates beyond 1e300 are left out and reported. Normals and colours of corners
//! are not carried over: [`Half::sources`] names the source triangle of each face.

mod cap;
mod complex;
mod groups;
mod in_scene;
mod restore;
mod scene;
mod slivers;

use std::ops::Range;

use glam::DVec3;

#[doc(hidden)]
pub use self::scene::planes_of;
pub use self::scene::{CappedPart, RELIEF_CELLS, capped, capped_with};

use self::complex::{Complex, ComplexFace, FaceState};
use self::in_scene::InScene;
use super::plane::is_within;
use super::{SectionDefect, SlicePlane};
use crate::scene::Mesh;
use crate::scene::meshes::weld::has_three;

/// Kept and removed half of a mesh.
#[derive(Clone, Debug, Default)]
pub struct Halves {
    /// Kept half.
    pub kept: Half,
    /// Removed half.
    pub removed: Half,
    /// Defects of the mesh that make caps unreliable, plane by plane.
    pub defects: Vec<SectionDefect>,
}

/// One of the two parts that a mesh is divided into.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Half {
    /// Faces of the mesh, then caps; they share vertices. It has no triangles if nothing is left.
    pub mesh: Mesh,
    /// Per face, the triangle of the mesh that contains it.
    pub sources: Vec<u32>,
    /// The caps, plane by plane.
    pub caps: Vec<Cap>,
}

/// A cap of a half.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cap {
    /// Index of the region that was removed.
    pub region: usize,
    /// Index of the plane in the region; for a scene, of the clip-surface in the cut, where the cutter comes after all others.
    pub plane: usize,
    /// Its triangles.
    pub triangles: Range<usize>,
}

impl Half {
    /// Number of triangles that are faces of the mesh; the caps follow them.
    pub fn surface_triangles(&self) -> usize {
        self.sources.len()
    }

    /// Total area of all caps, in square units.
    pub fn cap_area(&self) -> f64 {
        let caps = self.surface_triangles()..self.mesh.triangles.len();
        caps.map(|t| {
            let [a, b, c] = self.mesh.corners(t);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum()
    }
}

/// Divides a mesh into what lies below all planes of any region, which is removed, and the rest. Planes are in the mesh's
/// space; a region without planes is the whole mesh.
///
/// ```
/// use cutaway::generate::shapes::shape;
/// use cutaway::slice::{SlicePlane, halves};
/// use cutaway::scene::ClipSurface;
/// use glam::DVec3;
///
/// let cube = &shape("cube")?[0].mesh;
/// let plane = SlicePlane::from(&ClipSurface::plane(DVec3::ZERO, DVec3::ONE));
/// let halves = halves(cube, &[vec![plane]]);
/// assert!(halves.kept.mesh.open_edges().is_empty());
/// assert!((halves.kept.mesh.volume() - 0.5).abs() < 1e-12);
/// // Through the middle of six edges: a hexagon.
/// assert!((halves.kept.cap_area() - 0.75 * 3.0_f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), cutaway::Error>(())
/// ```
pub fn halves(mesh: &Mesh, regions: &[Vec<SlicePlane>]) -> Halves {
    halves_in(mesh, regions, None)
}

/// [`halves`], with the faces that lie in planes decided in a scene.
fn halves_in(mesh: &Mesh, regions: &[Vec<SlicePlane>], decided: Option<&InScene>) -> Halves {
    let planes: Vec<SlicePlane> = regions.concat();
    let usable: Vec<bool> = mesh.triangles.iter().map(|t| is_usable(mesh, t)).collect();
    let unusable = usable.iter().filter(|u| !**u).count();
    let mut complex = Complex::new(mesh, &planes, |t| usable[t]);
    if let Some(decided) = decided {
        complex.take_in(decided);
    }
    if unusable > 0 {
        complex.defects.push(SectionDefect::Unusable {
            triangles: unusable,
        });
    }
    let mut first = 0;
    for region in regions {
        let of_region = first..first + region.len();
        first = of_region.end;
        if planes[of_region.clone()].iter().all(SlicePlane::is_usable) {
            complex.remove(of_region);
        } else {
            complex.defects.push(SectionDefect::Plane);
        }
    }
    if planes.len() > 1 {
        complex.restore();
    }
    complex.collapse();
    let (mut kept, mut removed) = (Vec::new(), Vec::new());
    for face in &complex.faces {
        let [a, b, c] = face.corners;
        match face.state {
            FaceState::Removed => removed.push(*face),
            _ => kept.push(*face),
        }
        if face.plane().is_some() {
            removed.push(ComplexFace {
                corners: [a, c, b],
                ..*face
            });
        }
    }
    let starts: Vec<usize> = (regions.iter())
        .scan(0, |next, region| {
            Some(std::mem::replace(next, *next + region.len()))
        })
        .collect();
    let half = |faces| half(&complex.positions, faces, &starts);
    let (kept, removed) = rayon::join(|| half(kept), || half(removed));
    Halves {
        kept,
        removed,
        defects: complex.defects,
    }
}

fn is_usable(mesh: &Mesh, triangle: &[u32; 3]) -> bool {
    let is_there = |i: &u32| {
        mesh.positions
            .get(*i as usize)
            .is_some_and(|p| is_within(*p))
    };
    has_three(triangle) && triangle.iter().all(is_there)
}

/// The mesh of the given faces, keeping the order of the vertices that they use.
fn half(positions: &[DVec3], mut faces: Vec<ComplexFace>, first_planes: &[usize]) -> Half {
    // Caps after faces, by plane; a stable sort, so that faces stay in mesh order except for divided ones.
    faces.sort_by_key(|f| f.source);
    let mut caps = Vec::new();
    let mut first = 0;
    for run in faces.chunk_by(|a, b| a.plane() == b.plane()) {
        let triangles = first..first + run.len();
        first = triangles.end;
        if let Some(plane) = run[0].plane() {
            let region = first_planes.partition_point(|start| *start <= plane) - 1;
            let plane = plane - first_planes[region];
            caps.push(Cap {
                region,
                plane,
                triangles,
            });
        }
    }
    Half {
        mesh: of_used(positions, faces.iter().map(|f| f.corners).collect()),
        sources: (faces.iter().filter(|f| f.plane().is_none()))
            .map(|f| f.source)
            .collect(),
        caps,
    }
}

/// The mesh of the given triangles, keeping the order of the vertices that they use.
pub(super) fn of_used(positions: &[DVec3], mut triangles: Vec<[u32; 3]>) -> Mesh {
    let mut number_of = vec![u32::MAX; positions.len()];
    for i in triangles.iter().flatten() {
        number_of[*i as usize] = 0;
    }
    let mut used = Vec::new();
    for (number, at) in number_of.iter_mut().zip(positions) {
        if *number == 0 {
            *number = used.len() as u32;
            used.push(*at);
        }
    }
    for i in triangles.iter_mut().flatten() {
        *i = number_of[*i as usize];
    }
    Mesh {
        positions: used,
        triangles,
        ..Mesh::default()
    }
}
