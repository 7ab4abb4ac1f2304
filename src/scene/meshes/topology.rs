//! Properties of a mesh as the boundary of a solid: closed or open, number of connected components, depth complexity.
//!
//! An edge is an unordered pair of vertex indices; its *uses* are the triangles that contain it. Vertices that no triangle
//! refers to are not counted.
//!
//! Cost: parallel sorts of three keys per triangle, of the positions and of the triangles; three passes over them. Limit: 2^31 vertices.

mod edges;
mod rays;

use glam::DVec3;
use rayon::prelude::*;

pub use edges::{EdgeCount, Edges, Sets};
pub(crate) use edges::{EdgeUse, EdgeUses};
use rays::Rays;

use crate::scene::winding::Closing;
use crate::scene::{Bounds, Mesh, Part};

/// Number of open edges kept as examples.
const EXAMPLES: usize = 16;

/// The properties of a mesh that decide how well it can be capped.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Topology {
    /// Vertices that triangles use.
    pub vertices: usize,
    /// Triangles.
    pub faces: usize,
    /// True if every edge has an even number of uses; then every ray crosses the surface an even number of times and the solid
    /// is well defined by parity. A closed mesh may still have non-manifold or inconsistent edges.
    pub closed: bool,
    /// Faces with the same three positions as another face, in either orientation; both of a pair count. A mesh with such faces may
    /// be closed, but has no volume between them.
    pub coincident_faces: usize,
    /// Edges with one use.
    pub boundary_edges: usize,
    /// Loops of directed edges that do not cancel: rims of holes, and outlines of faces with inconsistent orientation.
    pub boundary_loops: usize,
    /// Edges with more than two uses.
    pub non_manifold_edges: usize,
    /// Edges whose two uses run in the same direction: the triangles disagree on which side is outside.
    pub inconsistent_edges: usize,
    /// Number of connected components; no vertex belongs to two of them.
    pub components: usize,
    /// Vertices minus edges plus faces.
    pub euler: i64,
    /// Signed volume, exact up to rounding if the mesh is closed and consistent.
    pub volume: f64,
    /// Surface area.
    pub area: f64,
    /// The box around the vertices in use.
    pub bounds: Extent,
    /// Crossing counts of axis-parallel rays with the surface.
    pub depth_complexity: DepthComplexity,
    /// Share of the rays with an odd number of crossings; 0 for a closed mesh.
    pub odd_ray_share: f64,
    #[cfg_attr(feature = "serde", serde(skip))]
    open_at: Vec<DVec3>,
    #[cfg_attr(feature = "serde", serde(skip))]
    rays: Rays,
}

/// A box in the form used by reports.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Extent {
    /// Least corner.
    pub min: [f64; 3],
    /// Greatest corner.
    pub max: [f64; 3],
}

/// Crossings of the surface along rays of a 256 x 256 grid over the bounds, parallel to each axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthComplexity {
    /// Maximum number of crossings of any ray, along any axis.
    pub largest: u32,
    /// Mean over the rays of all three axes that hit anything.
    pub mean: f64,
}

impl Topology {
    /// Measures a mesh. Indices must be in range ([`Mesh::defect`]).
    pub fn new(mesh: &Mesh) -> Self {
        let edges = Edges::of(&mesh.triangles);
        let count = edges.count();
        let (vertices, components) = pieces(mesh.positions.len(), &mesh.triangles);
        let in_use = bounds_in_use(mesh);
        let rays = Rays::through(mesh, in_use);
        let open_at = edges
            .open()
            .take(EXAMPLES)
            .map(|[a, b]| (mesh.positions[a as usize] + mesh.positions[b as usize]) * 0.5)
            .collect();
        let mut facts = Self {
            vertices,
            faces: mesh.triangles.len(),
            closed: count.open == 0,
            coincident_faces: crate::scene::doubled_faces(mesh).len(),
            boundary_edges: count.boundary,
            boundary_loops: match count.boundary + count.inconsistent + count.non_manifold {
                0 => 0,
                _ => Closing::of(&mesh.triangles).loops,
            },
            non_manifold_edges: count.non_manifold,
            inconsistent_edges: count.inconsistent,
            components,
            euler: vertices as i64 - count.edges as i64 + mesh.triangles.len() as i64,
            volume: mesh.volume(),
            area: mesh.area(),
            bounds: in_use.into(),
            open_at,
            ..Self::default()
        };
        facts.set_rays(rays);
        facts
    }

    /// Measures placed parts together: vertices are not shared between parts, but each ray crosses all parts.
    pub fn from_parts(parts: &[Part]) -> Self {
        let mut all = Mesh::default();
        for part in parts {
            let first = all.positions.len() as u32;
            let place = part.world_from_part;
            let mirrored = place.matrix3.determinant() < 0.0;
            all.positions.extend(
                part.mesh
                    .positions
                    .iter()
                    .map(|p| place.transform_point3(*p)),
            );
            all.triangles.extend(part.mesh.triangles.iter().map(|t| {
                let [a, b, c] = t.map(|i| i + first);
                if mirrored { [a, c, b] } else { [a, b, c] }
            }));
        }
        Self::new(&all)
    }

    /// The totals of several meshes, as if no ray crossed two of them: `largest` is the largest of any mesh. For parts that overlap
    /// along rays, use [`Topology::from_parts`].
    pub fn total(of: &[Self]) -> Self {
        let mut sum = Self {
            closed: of.iter().all(|t| t.closed),
            ..Self::default()
        };
        let mut bounds = Bounds::EMPTY;
        let mut rays = Rays::default();
        for t in of {
            sum.vertices += t.vertices;
            sum.faces += t.faces;
            sum.coincident_faces += t.coincident_faces;
            sum.boundary_edges += t.boundary_edges;
            sum.boundary_loops += t.boundary_loops;
            sum.non_manifold_edges += t.non_manifold_edges;
            sum.inconsistent_edges += t.inconsistent_edges;
            sum.components += t.components;
            sum.euler += t.euler;
            sum.volume += t.volume;
            sum.area += t.area;
            if t.faces > 0 {
                bounds = bounds.union(Bounds {
                    min: t.bounds.min.into(),
                    max: t.bounds.max.into(),
                });
            }
            let room = EXAMPLES - sum.open_at.len();
            sum.open_at.extend(t.open_at.iter().take(room));
            rays = rays.and(t.rays);
        }
        sum.bounds = bounds.into();
        sum.set_rays(rays);
        sum
    }

    /// Midpoints of at most 16 open edges, in part space, as examples of where the holes are.
    pub fn where_open(&self) -> &[DVec3] {
        &self.open_at
    }

    fn set_rays(&mut self, rays: Rays) {
        let hit = rays.hit.max(1) as f64;
        self.depth_complexity = DepthComplexity {
            largest: rays.largest,
            mean: rays.crossings as f64 / hit,
        };
        self.odd_ray_share = rays.odd as f64 / hit;
        self.rays = rays;
    }
}

impl Mesh {
    /// Edges with an odd number of uses, as pairs of vertices: there the solid is open. Indices must be in range ([`Mesh::defect`]).
    pub fn open_edges(&self) -> Vec<[u32; 2]> {
        Edges::of(&self.triangles).open().collect()
    }
}

impl From<Bounds> for Extent {
    fn from(bounds: Bounds) -> Self {
        if bounds.is_empty() {
            return Self::default();
        }
        Self {
            min: bounds.min.to_array(),
            max: bounds.max.to_array(),
        }
    }
}

/// Number of vertices in use, and of connected components that they form.
fn pieces(vertices: usize, triangles: &[[u32; 3]]) -> (usize, usize) {
    let mut sets = Sets::new(vertices);
    let mut used = vec![false; vertices];
    for &[a, b, c] in triangles {
        sets.join(a, b);
        sets.join(b, c);
        for i in [a, b, c] {
            used[i as usize] = true;
        }
    }
    let roots = (0..vertices as u32)
        .filter(|&i| used[i as usize] && sets.find(i) == i)
        .count();
    (used.iter().filter(|u| **u).count(), roots)
}

fn bounds_in_use(mesh: &Mesh) -> Bounds {
    mesh.triangles
        .par_chunks(1 << 14)
        .map(|some| Bounds::from_points(some.iter().flatten().map(|i| mesh.positions[*i as usize])))
        .reduce(|| Bounds::EMPTY, Bounds::union)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box, counter-clockwise from outside, from its corners.
    fn cuboid(min: DVec3, max: DVec3) -> Mesh {
        let positions = Bounds { min, max }.corners().to_vec();
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
        Mesh {
            positions,
            triangles,
            corner_normals: None,
            vertex_paint: None,
        }
    }

    /// A torus around the z axis, `n` by `m` quads.
    fn torus(n: u32, m: u32) -> Mesh {
        use std::f64::consts::TAU;
        let at = |i: u32, j: u32| {
            let (a, b) = (
                TAU * f64::from(i) / f64::from(n),
                TAU * f64::from(j) / f64::from(m),
            );
            let r = 2.0 + 0.5 * b.cos();
            DVec3::new(r * a.cos(), r * a.sin(), 0.5 * b.sin())
        };
        let index = |i: u32, j: u32| (i % n) * m + j % m;
        let cells = || (0..n).flat_map(move |i| (0..m).map(move |j| (i, j)));
        Mesh {
            positions: cells().map(|(i, j)| at(i, j)).collect(),
            triangles: cells()
                .flat_map(|(i, j)| {
                    let q = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(k, l)| index(i + k, j + l));
                    [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
                })
                .collect(),
            corner_normals: None,
            vertex_paint: None,
        }
    }

    fn joined(a: &Mesh, b: &Mesh) -> Mesh {
        let n = a.positions.len() as u32;
        Mesh {
            positions: [a.positions.clone(), b.positions.clone()].concat(),
            triangles: a
                .triangles
                .iter()
                .copied()
                .chain(b.triangles.iter().map(|t| t.map(|i| i + n)))
                .collect(),
            corner_normals: None,
            vertex_paint: None,
        }
    }

    #[test]
    fn a_cube_is_closed() {
        let t = Topology::new(&cuboid(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)));
        assert!(t.closed && t.inconsistent_edges == 0);
        assert_eq!((t.vertices, t.faces, t.components, t.euler), (8, 12, 1, 2));
        assert!((t.volume - 6.0).abs() < 1e-12 && (t.area - 22.0).abs() < 1e-12);
        assert_eq!((t.depth_complexity.largest, t.odd_ray_share), (2, 0.0));
        assert_eq!(
            t.depth_complexity.mean, 2.0,
            "every ray through a box is deep 2"
        );
        assert!(t.where_open().is_empty());
    }

    #[test]
    fn a_torus_has_euler_zero_and_even_rays() {
        // 64 and 256 put vertices and edges exactly on rays, 37 does not.
        for (n, m) in [(64, 32), (256, 256), (37, 19)] {
            let t = Topology::new(&torus(n, m));
            assert!(t.closed, "{n} x {m} torus is open");
            assert_eq!((t.euler, t.components), (0, 1));
            assert_eq!(t.odd_ray_share, 0.0, "odd rays through the {n} x {m} torus");
            assert_eq!(t.depth_complexity.largest, 4);
            assert!(t.volume > 0.0);
        }
    }

    #[test]
    fn a_missing_triangle_is_counted_and_found() {
        let mut mesh = cuboid(DVec3::ZERO, DVec3::ONE);
        mesh.triangles.pop();
        let t = Topology::new(&mesh);
        assert!(!t.closed);
        assert_eq!((t.boundary_edges, t.non_manifold_edges), (3, 0));
        assert_eq!(t.boundary_loops, 1);
        assert_eq!(t.where_open().len(), 3);
        assert!(
            t.where_open().iter().all(|p| p.x == 1.0),
            "the hole is at x = 1"
        );
        assert!(t.odd_ray_share > 0.0);
    }

    #[test]
    fn faces_on_each_other_are_counted_by_position_whichever_way_they_face() {
        let cube = cuboid(DVec3::ZERO, DVec3::ONE);
        assert_eq!(Topology::new(&cube).coincident_faces, 0);
        // A second copy with its own vertices, two triangles with a different corner order, one of them flipped.
        let mut doubled = joined(&cube, &cube);
        doubled.positions[8].x = -0.0;
        doubled.triangles[12].rotate_left(1);
        doubled.triangles[13].swap(0, 1);
        let t = Topology::new(&doubled);
        assert_eq!((t.coincident_faces, t.closed), (24, true));
        doubled.triangles.truncate(13);
        assert_eq!(
            Topology::new(&doubled).coincident_faces,
            2,
            "both of a pair"
        );
    }

    #[test]
    fn a_turned_triangle_is_inconsistent_but_closed() {
        let mut mesh = cuboid(DVec3::ZERO, DVec3::ONE);
        mesh.triangles[0].swap(1, 2);
        let t = Topology::new(&mesh);
        assert!(t.closed);
        assert_eq!(t.inconsistent_edges, 3);
    }

    #[test]
    fn two_boxes_are_two_pieces_and_add_up() {
        let (a, b) = (
            cuboid(DVec3::ZERO, DVec3::ONE),
            cuboid(DVec3::splat(2.0), DVec3::splat(3.0)),
        );
        let both = Topology::new(&joined(&a, &b));
        assert_eq!((both.components, both.euler), (2, 4));
        let sum = Topology::total(&[Topology::new(&a), Topology::new(&b)]);
        assert_eq!((sum.components, sum.euler, sum.closed), (2, 4, true));
        assert_eq!(sum.bounds, both.bounds);
        assert!((sum.volume - both.volume).abs() < 1e-12);
    }

    #[test]
    fn boxes_that_share_an_edge_are_closed_and_non_manifold() {
        // The second box shares the first one's edge from (1, 1, 0) to (1, 1, 1), by index.
        let mut mesh = joined(
            &cuboid(DVec3::ZERO, DVec3::ONE),
            &cuboid(DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, 2.0, 1.0)),
        );
        for t in &mut mesh.triangles {
            *t = t.map(|i| match i {
                8 => 3,
                12 => 7,
                other => other,
            });
        }
        let t = Topology::new(&mesh);
        assert!(t.closed, "four uses are even");
        assert_eq!((t.non_manifold_edges, t.boundary_edges), (1, 0));
        assert_eq!((t.vertices, t.odd_ray_share), (14, 0.0));
    }

    #[test]
    fn unused_vertices_do_not_count() {
        let mut mesh = cuboid(DVec3::ZERO, DVec3::ONE);
        mesh.positions.push(DVec3::splat(1e9));
        let t = Topology::new(&mesh);
        assert_eq!((t.vertices, t.euler, t.bounds.max), (8, 2, [1.0; 3]));
    }

    #[test]
    fn placed_parts_are_measured_in_the_world() {
        let mut part = Part::new("a", cuboid(DVec3::ZERO, DVec3::ONE));
        part.world_from_part = glam::DAffine3::from_scale(DVec3::new(-2.0, 1.0, 1.0));
        let t = Topology::from_parts(&[part.clone(), part]);
        assert!((t.volume - 4.0).abs() < 1e-12, "volume {}", t.volume);
        assert_eq!(t.depth_complexity.largest, 4, "rays cross both");
    }
}
