//! Vertices for drawing: positions split where the surface has a crease, with a unit normal each.
//!
//! Topology shares a position among all triangles around it; shading needs one normal per smooth patch. Around each
//! position, corners are grouped across edges whose triangles turn by less than the crease angle, and each group gets the
//! mean of its face normals weighted by the corner angles (Thürmer and Wüthrich 1998), which does not depend on how flat
//! regions are triangulated. Normals of the file win where there are any. Normals never move a position or an edge.
//!
//! Cost: one bucket sort of the corners, then every position on its own, in parallel; the result does not depend on the
//! number of threads. Limit: a triangle without area gets the normal of its first usable neighbour group or `+Z`.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::PreparedPart;

/// Edges that turn more are drawn sharp.
pub const DEFAULT_CREASE_DEG: f32 = 40.0;

/// Positions per parallel task: enough to be worth a task, few enough to share out.
const CHUNK: usize = 1 << 14;

/// A part's triangles with vertices split for shading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShadingMesh {
    /// Per vertex, the index into [`PreparedPart::positions`] of its position.
    pub positions_of_vertex: Vec<u32>,
    /// Per vertex, a unit normal in scene space.
    pub normals: Vec<Vec3>,
    /// The part's triangles in the same order, as indices of vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// Vertices of a run of positions, and which of them each of the run's corners takes.
struct Chunk {
    positions_of_vertex: Vec<u32>,
    normals: Vec<Vec3>,
    vertex_of_corner: Vec<u32>,
}

/// A corner in a bucket of its position.
#[derive(Clone, Copy)]
struct Corner {
    /// Neighbours along the two edges that meet here.
    ends: [u32; 2],
    /// Unit normal of the triangle; zero if it has no area.
    face: DVec3,
    /// Normal times angle, or the file's normal.
    pull: DVec3,
    group: u32,
}

impl ShadingMesh {
    /// Splits the vertices of a part. `crease_deg` is the turn from which an edge is sharp; it is not asked where the part
    /// has normals of its own.
    pub fn of(part: &PreparedPart, crease_deg: f32) -> Self {
        let buckets = Buckets::of(part);
        let faces: Vec<DVec3> = part
            .triangles
            .par_iter()
            .map(|t| face_normal(t.map(|i| part.positions[i as usize])))
            .collect();
        let least_cos = f64::from(crease_deg).to_radians().cos();
        let chunks: Vec<Chunk> = (0..part.positions.len().div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let positions = c * CHUNK..((c + 1) * CHUNK).min(part.positions.len());
                chunk(part, &buckets, &faces, positions, least_cos)
            })
            .collect();

        let vertices = chunks.iter().map(|c| c.normals.len()).sum();
        let mut all = Self {
            positions_of_vertex: Vec::with_capacity(vertices),
            normals: Vec::with_capacity(vertices),
            triangles: vec![[0; 3]; part.triangles.len()],
        };
        let mut corners = buckets.corners.iter();
        for chunk in chunks {
            let first = all.normals.len() as u32;
            all.positions_of_vertex.extend(chunk.positions_of_vertex);
            all.normals.extend(chunk.normals);
            for (vertex, corner) in chunk.vertex_of_corner.iter().zip(corners.by_ref()) {
                all.triangles[(corner / 3) as usize][(corner % 3) as usize] = first + vertex;
            }
        }
        all
    }
}

/// Corners (three times the triangle plus the place in it) by position, in order.
struct Buckets {
    start: Vec<u32>,
    corners: Vec<u32>,
}

impl Buckets {
    fn of(part: &PreparedPart) -> Self {
        let mut start = vec![0_u32; part.positions.len() + 1];
        for i in part.triangles.iter().flatten() {
            start[*i as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut corners = vec![0; part.triangles.len() * 3];
        for (corner, i) in (0..).zip(part.triangles.iter().flatten()) {
            let slot = &mut next[*i as usize];
            corners[*slot as usize] = corner;
            *slot += 1;
        }
        Self { start, corners }
    }

    fn at(&self, position: usize) -> &[u32] {
        &self.corners[self.start[position] as usize..self.start[position + 1] as usize]
    }
}

fn face_normal(corners: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero()
}

fn chunk(
    part: &PreparedPart,
    buckets: &Buckets,
    faces: &[DVec3],
    positions: std::ops::Range<usize>,
    least_cos: f64,
) -> Chunk {
    let mut out = Chunk {
        positions_of_vertex: Vec::with_capacity(positions.len()),
        normals: Vec::with_capacity(positions.len()),
        vertex_of_corner: Vec::with_capacity(positions.len() * 6),
    };
    let mut around: Vec<Corner> = Vec::new();
    let mut ends: Vec<(u32, u32)> = Vec::new();
    for position in positions {
        around.clear();
        around.extend(buckets.at(position).iter().zip(0..).map(|(corner, group)| {
            let (t, k) = ((corner / 3) as usize, (corner % 3) as usize);
            let given = part.corner_normals.as_ref().map(|n| n[t][k].as_dvec3());
            let given = given.filter(|n| n.is_finite() && *n != DVec3::ZERO);
            let triangle = part.triangles[t];
            let ends = [triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
            let at = |i: u32| part.positions[i as usize].as_dvec3();
            let from = part.positions[position].as_dvec3();
            Corner {
                ends,
                face: faces[t],
                pull: given
                    .unwrap_or_else(|| faces[t] * angle(at(ends[0]) - from, at(ends[1]) - from)),
                group,
            }
        }));
        if part.corner_normals.is_none() {
            group(&mut around, &mut ends, least_cos);
        }
        append(&mut out, position as u32, &around);
    }
    out
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    // Good for tiny and for nearly straight angles alike, and 0 where an edge has no length.
    a.cross(b).length().atan2(a.dot(b))
}

/// Gives corners that meet in a smooth edge the same group: the least index among them.
fn group(around: &mut [Corner], ends: &mut Vec<(u32, u32)>, least_cos: f64) {
    ends.clear();
    for (i, corner) in around.iter().enumerate() {
        ends.extend(corner.ends.map(|end| (end, i as u32)));
    }
    ends.sort_unstable();
    for pair in ends.windows(2) {
        let (i, j) = (pair[0].1 as usize, pair[1].1 as usize);
        // A face without area is at an angle to everything.
        if pair[0].0 == pair[1].0 && around[i].face.dot(around[j].face) > least_cos {
            let (a, b) = (root(around, i), root(around, j));
            around[a.max(b)].group = a.min(b) as u32;
        }
    }
    for i in 0..around.len() {
        around[i].group = root(around, i) as u32;
    }
}

fn root(around: &[Corner], mut i: usize) -> usize {
    while around[i].group as usize != i {
        i = around[i].group as usize;
    }
    i
}

/// Makes a vertex for each different normal at a position.
fn append(out: &mut Chunk, position: u32, around: &[Corner]) {
    let first = out.normals.len();
    let fallback = around
        .iter()
        .map(|c| c.face)
        .find(|n| *n != DVec3::ZERO)
        .unwrap_or(DVec3::Z);
    let mut vertex_of_group = [u32::MAX; 32];
    for (i, corner) in around.iter().enumerate() {
        let known = vertex_of_group.get(corner.group as usize);
        let vertex = match known {
            Some(vertex) if *vertex != u32::MAX => *vertex,
            _ => {
                let members = around.iter().skip(corner.group as usize);
                let sum: DVec3 = members
                    .filter(|c| c.group == corner.group)
                    .map(|c| c.pull)
                    .sum();
                let unit = sum.try_normalize().unwrap_or(fallback);
                vertex_of(out, first, position, unit.as_vec3())
            }
        };
        if let Some(slot) = vertex_of_group.get_mut(corner.group as usize) {
            *slot = vertex;
        }
        debug_assert!(
            corner.group as usize <= i,
            "a group is named by its first corner"
        );
        out.vertex_of_corner.push(vertex);
    }
}

/// The vertex with a normal among those since `first`, made if there is none.
fn vertex_of(out: &mut Chunk, first: usize, position: u32, normal: Vec3) -> u32 {
    let known = out.normals[first..].iter().position(|n| *n == normal);
    let vertex = known.map_or(out.normals.len(), |k| first + k);
    if known.is_none() {
        out.normals.push(normal);
        out.positions_of_vertex.push(position);
    }
    vertex as u32
}
