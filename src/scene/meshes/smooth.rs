//! Vertices for drawing: positions split where the surface has a crease, each with a unit normal.
//!
//! Topology shares a position among all triangles around it; shading needs one normal per smooth patch. Around each
//! position, corners are grouped across edges whose triangles turn by less than the crease angle, and each group gets the
//! mean of its face normals weighted by the corner angles (Thürmer and Wüthrich 1998), which does not depend on how flat
//! regions are triangulated. Normals from the file take precedence. Normals never move a position or an edge.
//!
//! Cost: the corners are distributed to runs of positions and sorted there, then every position is taken on its own, in parallel; the result
//! does not depend on the number of threads. Limit: a triangle without area gets the normal of some adjacent triangle, or `+Z`.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::buckets::Buckets;

/// Default crease angle in degrees: edges that turn by more are drawn sharp.
pub const DEFAULT_CREASE_DEG: f32 = 40.0;

/// Positions per parallel task: enough to be worth a task, few enough to balance the load.
const CHUNK: usize = 1 << 14;

/// The triangles of a part or a cutter in scene space.
#[derive(Clone, Copy, Debug)]
pub struct Faces<'a> {
    /// Vertices.
    pub positions: &'a [Vec3],
    /// Indices of positions.
    pub triangles: &'a [[u32; 3]],
    /// Normals at the triangles' corners, if the mesh has its own.
    pub corner_normals: Option<&'a [[Vec3; 3]]>,
}

/// Triangles with vertices split for shading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShadingMesh {
    /// Per vertex, the index into [`Faces::positions`] of its position.
    pub positions_of_vertex: Vec<u32>,
    /// Per vertex, a unit normal in scene space.
    pub normals: Vec<Vec3>,
    /// The triangles in the same order, as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// Vertices for a run of positions.
struct Chunk {
    positions_of_vertex: Vec<u32>,
    normals: Vec<Vec3>,
}

/// A triangle corner in its position's bucket.
#[derive(Clone, Copy)]
struct TriangleCorner {
    /// Other ends of the two edges that meet at this corner.
    ends: [u32; 2],
    /// Unit normal of the triangle; zero if it has no area.
    face: DVec3,
    /// Face normal times corner angle, or the file's normal.
    pull: DVec3,
    /// Index of the first corner of the same group.
    group: u32,
    /// The group's vertex, once made.
    vertex: u32,
}

impl ShadingMesh {
    /// Splits the vertices of triangles for shading. An edge that turns by at least `crease_deg` is sharp; this is ignored if the
    /// triangles have their own normals.
    pub fn new(of: Faces<'_>, crease_deg: f32) -> Self {
        let number = of.positions.len().div_ceil(CHUNK);
        let buckets = Buckets::of(of.triangles, number, |index, t| {
            [0, 1, 2].map(|k| (t[k] as usize / CHUNK, (3 * index + k) as u32))
        });
        let normals: Vec<DVec3> = (of.triangles.par_iter())
            .map(|t| face_normal(t.map(|i| of.positions[i as usize])))
            .collect();
        // Of each corner, by its place in the list of triangles, its vertex within the run.
        let vertex_of_corner: Vec<AtomicU32> = (0..3 * of.triangles.len())
            .into_par_iter()
            .map(|_| AtomicU32::new(0))
            .collect();
        let least_cos = f64::from(crease_deg).to_radians().cos();
        let chunks: Vec<Chunk> = (buckets.par_iter().enumerate())
            .map(|(c, corners)| {
                let positions = c * CHUNK..((c + 1) * CHUNK).min(of.positions.len());
                let corners = SortedCorners::of(of.triangles, corners, positions);
                chunk(of, &corners, &normals, least_cos, &vertex_of_corner)
            })
            .collect();

        let mut all = Self::default();
        let vertices = chunks.iter().map(|c| c.normals.len()).sum();
        all.positions_of_vertex.reserve_exact(vertices);
        all.normals.reserve_exact(vertices);
        let mut first_vertex = Vec::with_capacity(number);
        for chunk in chunks {
            first_vertex.push(all.normals.len() as u32);
            all.positions_of_vertex.extend(chunk.positions_of_vertex);
            all.normals.extend(chunk.normals);
        }
        let vertices = vertex_of_corner.par_chunks_exact(3).zip(of.triangles);
        let vertices = vertices.map(|(within, t)| {
            [0, 1, 2]
                .map(|k| first_vertex[t[k] as usize / CHUNK] + within[k].load(Ordering::Relaxed))
        });
        all.triangles = vertices.collect();
        all
    }
}

/// Corners at a run of positions, by position, in order; a corner's number is three times its triangle's index plus its index in the
/// triangle.
struct SortedCorners {
    positions: Range<usize>,
    start: Vec<u32>,
    corners: Vec<u32>,
}

impl SortedCorners {
    fn of(
        triangles: &[[u32; 3]],
        corners: impl Iterator<Item = u32>,
        positions: Range<usize>,
    ) -> Self {
        let all: Vec<u32> = corners.collect();
        let place = |corner: u32| {
            triangles[corner as usize / 3][corner as usize % 3] as usize - positions.start
        };
        let mut start = vec![0_u32; positions.len() + 1];
        for corner in &all {
            start[place(*corner) + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut corners = vec![0; all.len()];
        for corner in all {
            let slot = &mut next[place(corner)];
            corners[*slot as usize] = corner;
            *slot += 1;
        }
        Self {
            positions,
            start,
            corners,
        }
    }

    fn at(&self, position: usize) -> &[u32] {
        let place = position - self.positions.start;
        &self.corners[self.start[place] as usize..self.start[place + 1] as usize]
    }
}

fn face_normal(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero()
}

fn chunk(
    faces: Faces<'_>,
    corners: &SortedCorners,
    normals: &[DVec3],
    least_cos: f64,
    vertex_of_corner: &[AtomicU32],
) -> Chunk {
    let positions = corners.positions.clone();
    let mut out = Chunk {
        positions_of_vertex: Vec::with_capacity(positions.len()),
        normals: Vec::with_capacity(positions.len()),
    };
    let mut around: Vec<TriangleCorner> = Vec::new();
    let mut ends: Vec<(u32, u32)> = Vec::new();
    for position in positions {
        around.clear();
        let at_position = corners.at(position);
        around.extend(at_position.iter().zip(0..).map(|(corner, group)| {
            let (t, k) = ((corner / 3) as usize, (corner % 3) as usize);
            let given = faces.corner_normals.map(|n| n[t][k].as_dvec3());
            let given = given.filter(|n| n.is_finite() && *n != DVec3::ZERO);
            let triangle = faces.triangles[t];
            let ends = [triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
            let at = |i: u32| faces.positions[i as usize].as_dvec3();
            let from = faces.positions[position].as_dvec3();
            TriangleCorner {
                ends,
                face: normals[t],
                pull: given
                    .unwrap_or_else(|| normals[t] * angle(at(ends[0]) - from, at(ends[1]) - from)),
                group,
                vertex: 0,
            }
        }));
        if faces.corner_normals.is_none() {
            group(&mut around, &mut ends, least_cos);
        }
        append(&mut out, position as u32, &mut around);
        for (corner, at) in at_position.iter().zip(&around) {
            // The leader is the first corner of its group, so its vertex is known by now.
            let vertex = around[at.group as usize].vertex;
            vertex_of_corner[*corner as usize].store(vertex, Ordering::Relaxed);
        }
    }
    out
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    // Accurate for tiny and for nearly straight angles, and 0 if an edge has no length. That of the crate takes half the time of glibc's,
    // and gives the same normals on every platform.
    libm::atan2(a.cross(b).length(), a.dot(b))
}

/// Puts corners that share a smooth edge into one group, identified by the least index among them.
fn group(around: &mut [TriangleCorner], ends: &mut Vec<(u32, u32)>, least_cos: f64) {
    ends.clear();
    for (i, corner) in around.iter().enumerate() {
        ends.extend(corner.ends.map(|end| (end, i as u32)));
    }
    ends.sort_unstable();
    for pair in ends.windows(2) {
        let (i, j) = (pair[0].1 as usize, pair[1].1 as usize);
        // An edge of a face without area is never smooth.
        if pair[0].0 == pair[1].0 && around[i].face.dot(around[j].face) > least_cos {
            let (a, b) = (root(around, i), root(around, j));
            around[a.max(b)].group = a.min(b) as u32;
        }
    }
    for i in 0..around.len() {
        around[i].group = root(around, i) as u32;
    }
}

fn root(around: &[TriangleCorner], mut i: usize) -> usize {
    while around[i].group as usize != i {
        i = around[i].group as usize;
    }
    i
}

/// Adds a vertex for each different normal at a position.
fn append(out: &mut Chunk, position: u32, around: &mut [TriangleCorner]) {
    let first = out.normals.len();
    let fallback = around
        .iter()
        .map(|c| c.face)
        .find(|n| *n != DVec3::ZERO)
        .unwrap_or(DVec3::Z);
    for i in 0..around.len() {
        let leader = around[i].group as usize;
        if leader != i {
            let pull = around[i].pull;
            around[leader].pull += pull;
        }
    }
    for (i, corner) in around.iter_mut().enumerate() {
        if corner.group as usize == i {
            let unit = corner.pull.try_normalize().unwrap_or(fallback);
            corner.vertex = vertex_of(out, first, position, unit.as_vec3());
        }
    }
}

/// The vertex with the given normal among those from `first` on; added if there is none.
fn vertex_of(out: &mut Chunk, first: usize, position: u32, normal: Vec3) -> u32 {
    let known = out.normals[first..].iter().position(|n| *n == normal);
    let vertex = known.map_or(out.normals.len(), |k| first + k);
    if known.is_none() {
        out.normals.push(normal);
        out.positions_of_vertex.push(position);
    }
    vertex as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Mesh, Part, Prepared, PreparedPart, Scene};

    fn prepared(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> PreparedPart {
        let mesh = Mesh {
            positions: positions.iter().copied().map(DVec3::from).collect(),
            triangles: triangles.to_vec(),
            corner_normals: None,
            vertex_paint: None,
        };
        let scene = Scene {
            parts: vec![Part::new("p", mesh)],
            ..Scene::default()
        };
        Prepared::new(&scene).parts.remove(0)
    }

    /// A closed ring of `n` quads around the z axis with two caps.
    fn cylinder(n: u32) -> PreparedPart {
        let mut positions = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        let mut triangles = Vec::new();
        for i in 0..n {
            let a = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            positions.extend([[a.cos(), a.sin(), -1.0], [a.cos(), a.sin(), 1.0]]);
            let (low, next) = (2 + 2 * i, 2 + 2 * ((i + 1) % n));
            triangles.extend([[low, next, next + 1], [low, next + 1, low + 1]]);
            triangles.extend([[0, next, low], [1, low + 1, next + 1]]);
        }
        prepared(&positions, &triangles)
    }

    #[test]
    fn a_cylinder_is_smooth_around_and_sharp_at_its_rims() {
        let part = cylinder(24);
        let mesh = ShadingMesh::new(part.faces(), DEFAULT_CREASE_DEG);
        assert_eq!(
            mesh.normals.len(),
            2 + 24 * 2 * 2,
            "rim positions have two vertices each"
        );
        for (v, n) in mesh.positions_of_vertex.iter().zip(&mesh.normals) {
            let p = part.positions[*v as usize] - part.bounds.centre().as_vec3();
            let radial = Vec3::new(p.x, p.y, 0.0).normalize_or_zero();
            let nearest = n.dot(radial).max(n.z.abs());
            assert!(nearest > 0.999_9, "normal {n} at {p}");
        }
        let flat = ShadingMesh::new(part.faces(), 1.0);
        assert_eq!(flat.normals.len(), 2 + 24 * 2 * 3, "every face on its own");
    }

    #[test]
    fn order_and_positions_are_kept() {
        let part = cylinder(7);
        let mesh = ShadingMesh::new(part.faces(), DEFAULT_CREASE_DEG);
        for (t, of) in mesh.triangles.iter().zip(part.triangles.iter()) {
            assert_eq!(t.map(|v| mesh.positions_of_vertex[v as usize]), *of);
        }
        assert_eq!(mesh, ShadingMesh::new(part.faces(), DEFAULT_CREASE_DEG));
    }

    #[test]
    fn weights_are_angles_so_triangulation_does_not_show() {
        // At a cube's corner, one face has two triangles and the other two faces have one each.
        let positions = [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, 1.0, 0.0],
        ];
        let part = prepared(&positions, &[[0, 1, 4], [0, 4, 2], [0, 2, 3], [0, 3, 1]]);
        let mesh = ShadingMesh::new(part.faces(), 179.0);
        let at = mesh.triangles[0][0] as usize;
        let diagonal = Vec3::splat(1.0 / 3.0_f32.sqrt());
        assert!(
            (mesh.normals[at] - diagonal).length() < 1e-6,
            "{}",
            mesh.normals[at]
        );
    }

    #[test]
    fn triangles_without_area_give_unit_normals() {
        let positions = [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [5.0; 3],
        ];
        let part = prepared(&positions, &[[0, 1, 2], [0, 2, 3], [4, 4, 4]]);
        let mesh = ShadingMesh::new(part.faces(), DEFAULT_CREASE_DEG);
        for n in &mesh.normals {
            assert!((n.length() - 1.0).abs() < 1e-6, "{n}");
        }
    }

    #[test]
    fn normals_of_the_file_win() {
        let mut part = cylinder(5);
        let given = vec![[Vec3::X, Vec3::X, Vec3::Y]; part.triangles.len()];
        part.corner_normals = Some(std::sync::Arc::new(given));
        let mesh = ShadingMesh::new(part.faces(), DEFAULT_CREASE_DEG);
        assert!(mesh.normals.iter().all(|n| *n == Vec3::X || *n == Vec3::Y));
        assert_eq!(mesh.normals[mesh.triangles[3][2] as usize], Vec3::Y);
    }
}
