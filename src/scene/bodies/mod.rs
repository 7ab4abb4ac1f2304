//! The bodies of a mesh: fragments that can be removed without tearing the surface.
//!
//! A *shell* is an edge-connected component of the surface (see [`shells`]); a shared vertex alone does not connect. A body is a shell
//! with its cavities. Closed shells nest: the parent of a shell is the smallest shell that wholly contains it.
//!
//! | a shell | is |
//! |---|---|
//! | without a parent | a body |
//! | whose parent is a body that faces the same way | a body of its own: the solids overlap |
//! | whose parent is a body that faces the other way | a cavity of that body |
//! | whose parent is a cavity | a body, whichever way it faces |
//! | that is open | a body: it contains nothing |
//!
//! So a mesh that is inside out as a whole has the same bodies as its correctly oriented version. Where orientation is undefined, because a
//! shell is flat or its triangles are inconsistently oriented, parity decides: every child of a body is its cavity.
//!
//! Bodies are numbered in the order of their first triangles.
//!
//! Cost: one parallel sort of three numbers per triangle; if some shells do not face out, also a box tree over the triangles of closed
//! shells and up to eight rays per shell ([`inside`]). Cannot: join the sheets of a solid whose edges are open, or distinguish a surface
//! that has every face twice, in opposite orientations, from two coincident solids.

mod around_edge;
mod inside;
mod pieces;
mod shells;

use rayon::prelude::*;

use self::inside::Insides;
pub(super) use self::pieces::bound_of;
pub use self::pieces::{GeometryId, Pieces, body_name};
use self::shells::{ShellOrientation, Shells};
use super::Mesh;

/// Body of each triangle of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    of_triangles: Vec<u32>,
    /// Per body, true if it is closed.
    is_closed: Vec<bool>,
}

impl Bodies {
    /// The bodies of a mesh. Indices must be in range and coordinates finite ([`Mesh::defect`]).
    pub fn of(mesh: &Mesh) -> Self {
        let shells = Shells::of(mesh);
        let heads = heads(mesh, &shells);
        // Bodies are ordered by their first triangle, which may be in any of their shells.
        let mut numbers: Vec<Option<u32>> = vec![None; heads.len()];
        let mut is_closed = Vec::new();
        let of_triangles = (shells.of_triangles.iter())
            .map(|shell| {
                let head = heads[*shell as usize] as usize;
                *numbers[head].get_or_insert_with(|| {
                    is_closed.push(shells.shells[head].is_closed);
                    is_closed.len() as u32 - 1
                })
            })
            .collect();
        Self {
            of_triangles,
            is_closed,
        }
    }

    /// Number of bodies.
    pub fn count(&self) -> usize {
        self.is_closed.len()
    }

    /// Number of open bodies.
    pub fn open(&self) -> usize {
        self.is_closed.iter().filter(|closed| !**closed).count()
    }

    /// Per body: true if it is closed.
    pub(crate) fn closed(&self) -> &[bool] {
        &self.is_closed
    }

    /// The number of the body of each triangle, from 0.
    pub fn of_triangles(&self) -> &[u32] {
        &self.of_triangles
    }

    /// The triangles of each body, in mesh order.
    pub fn triangles(&self) -> Vec<Vec<u32>> {
        let mut triangles = vec![Vec::new(); self.count()];
        for (triangle, body) in (0..).zip(&self.of_triangles) {
            triangles[*body as usize].push(triangle);
        }
        triangles
    }
}

/// Per shell, the outer shell of its body: itself, or the shell whose cavity it is.
fn heads(mesh: &Mesh, shells: &Shells) -> Vec<u32> {
    let all = &shells.shells;
    let mut heads: Vec<u32> = (0..all.len() as u32).collect();
    let faces_out = |s: &shells::Shell| s.facing == Some(ShellOrientation::Out);
    if all.iter().all(|s| !s.is_closed || faces_out(s)) {
        // All closed shells face out, so no shell is a cavity.
        return heads;
    }
    let insides = Insides::of(mesh, shells);
    let around: Vec<Option<u32>> = (0..all.len() as u32)
        .into_par_iter()
        .map(|shell| insides.smallest_around(shell))
        .collect();
    // A shell's parent is larger, so it comes first.
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    order.sort_by(|a, b| all[*b as usize].by_size(&all[*a as usize]).then(b.cmp(a)));
    for shell in order {
        let Some(outer) = around[shell as usize] else {
            continue;
        };
        let is_cavity = heads[outer as usize] != outer;
        let [inner_facing, outer_facing] = [shell, outer].map(|s| all[s as usize].facing);
        let overlaps = inner_facing.is_some() && inner_facing == outer_facing;
        if !is_cavity && !overlaps {
            heads[shell as usize] = outer;
        }
    }
    heads
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Part;
    use glam::DVec3;

    /// A box with its corners, inside out if `faces_in`.
    fn cuboid(min: [f64; 3], max: [f64; 3], faces_in: bool) -> Mesh {
        let at = |i: usize| {
            let of = |axis: usize| [min, max][(i >> axis) & 1][axis];
            DVec3::new(of(0), of(1), of(2))
        };
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
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Mesh {
            positions: (0..8).map(at).collect(),
            triangles: triangles
                .map(|[a, b, c]| if faces_in { [a, c, b] } else { [a, b, c] })
                .collect(),
            corner_normals: None,
            vertex_paint: None,
        }
    }

    /// A cube of some size about a point.
    fn cube(centre: [f64; 3], size: f64, faces_in: bool) -> Mesh {
        let half = DVec3::splat(size / 2.0);
        let centre = DVec3::from(centre);
        cuboid((centre - half).into(), (centre + half).into(), faces_in)
    }

    fn joined(meshes: &[Mesh]) -> Mesh {
        let mut all = Mesh::default();
        for mesh in meshes {
            let first = all.positions.len() as u32;
            all.positions.extend(&mesh.positions);
            let triangles = mesh.triangles.iter();
            all.triangles
                .extend(triangles.map(|t| t.map(|i| i + first)));
        }
        all
    }

    /// The mesh with vertices at equal positions merged.
    fn welded(mesh: &Mesh) -> Mesh {
        let mut positions: Vec<DVec3> = Vec::new();
        let numbers: Vec<u32> = (mesh.positions.iter())
            .map(|p| {
                let known = positions.iter().position(|q| q == p);
                known.unwrap_or_else(|| {
                    positions.push(*p);
                    positions.len() - 1
                }) as u32
            })
            .collect();
        let triangles = mesh.triangles.iter();
        Mesh {
            triangles: triangles.map(|t| t.map(|i| numbers[i as usize])).collect(),
            positions,
            corner_normals: None,
            vertex_paint: None,
        }
    }

    /// Joins meshes and returns the body of each; each mesh must lie in a single body.
    fn bodies_of(meshes: &[Mesh]) -> Vec<u32> {
        let bodies = Bodies::of(&joined(meshes));
        let mut first = 0;
        meshes
            .iter()
            .map(|mesh| {
                let own = &bodies.of_triangles()[first..first + mesh.triangles.len()];
                first += mesh.triangles.len();
                assert!(own.iter().all(|b| *b == own[0]), "a shell is in two bodies");
                own[0]
            })
            .collect()
    }

    fn nested(cubes: &[(f64, bool)]) -> Vec<u32> {
        let cubes: Vec<Mesh> = (cubes.iter())
            .map(|(size, faces_in)| cube([0.0; 3], *size, *faces_in))
            .collect();
        bodies_of(&cubes)
    }

    const OUT: bool = false;
    const IN: bool = true;

    #[test]
    fn shells_nest() {
        for (cubes, expected) in [
            (vec![(2.0, OUT), (1.0, IN)], vec![0, 0]),
            (vec![(1.0, IN), (2.0, OUT)], vec![0, 0]),
            // A body in the cavity, and one with a cavity of its own in it.
            (vec![(3.0, OUT), (2.0, IN), (1.0, OUT)], vec![0, 0, 1]),
            (
                vec![(1.0, OUT), (4.0, OUT), (0.5, IN), (3.0, IN)],
                vec![0, 1, 0, 1],
            ),
            // Solids that overlap.
            (vec![(2.0, OUT), (1.0, OUT)], vec![0, 1]),
            (vec![(3.0, OUT), (2.0, OUT), (1.0, IN)], vec![0, 1, 1]),
            // Inside out as a whole.
            (vec![(2.0, IN), (1.0, OUT)], vec![0, 0]),
            (vec![(3.0, IN), (2.0, OUT), (1.0, IN)], vec![0, 0, 1]),
            (vec![(2.0, IN), (1.0, IN)], vec![0, 1]),
            // A cavity cannot contain a cavity, so the innermost shell is a body.
            (vec![(3.0, OUT), (2.0, IN), (1.0, IN)], vec![0, 0, 1]),
            (vec![(1.0, IN)], vec![0]),
        ] {
            assert_eq!(nested(&cubes), expected, "{cubes:?}");
        }
    }

    #[test]
    fn a_cavity_goes_with_what_is_around_it_and_not_with_what_is_beside_it() {
        let two = [
            cube([0.0; 3], 2.0, OUT),
            cube([5.0, 0.0, 0.0], 2.0, OUT),
            cube([5.0, 0.0, 0.0], 1.0, IN),
            cube([0.1, 0.0, 0.0], 1.0, IN),
            cube([9.0, 0.0, 0.0], 1.0, IN),
        ];
        assert_eq!(bodies_of(&two), [0, 1, 1, 0, 2]);
        // Inside the bounding box of an L shape, but outside the L.
        let mut l = joined(&[
            cuboid([0.0; 3], [3.0, 1.0, 1.0], OUT),
            cuboid([0.0, 1.0, 0.0], [1.0, 3.0, 1.0], OUT),
        ]);
        l = welded(&l);
        let beside = cuboid([1.5, 1.5, 0.2], [2.5, 2.5, 0.8], IN);
        let within = cuboid([0.5, 0.2, 0.2], [2.5, 0.8, 0.8], IN);
        let bodies = Bodies::of(&joined(&[l.clone(), beside, within]));
        let own = bodies.of_triangles();
        assert_eq!(own[24], 2, "{own:?}");
        assert_eq!(own[36], own[0], "{own:?}");
    }

    #[test]
    fn a_body_that_fills_a_cavity_is_a_body() {
        let filled = [
            cube([0.0; 3], 3.0, OUT),
            cube([0.0; 3], 1.0, IN),
            cube([0.0; 3], 1.0, OUT),
        ];
        assert_eq!(bodies_of(&filled), [0, 0, 1]);
        // With shared vertices, only orientation shows which solid a triangle belongs to.
        let shared = welded(&joined(&filled));
        let bodies = Bodies::of(&shared);
        assert_eq!(bodies.count(), 2);
        let volumes: Vec<f64> = (bodies.triangles().iter())
            .map(|t| shared.picked(t).0.volume())
            .collect();
        assert!((volumes[0] - 26.0).abs() < 1e-9, "{volumes:?}");
        assert!((volumes[1] - 1.0).abs() < 1e-9, "{volumes:?}");
    }

    #[test]
    fn what_shares_a_vertex_an_edge_or_a_face_comes_apart() {
        for (what, to) in [
            ("a vertex", [1.0, 1.0, 1.0]),
            ("an edge", [1.0, 1.0, 0.0]),
            ("a face", [1.0, 0.0, 0.0]),
        ] {
            for faces_in in [OUT, IN] {
                let to_max: [f64; 3] = std::array::from_fn(|i| to[i] + 1.0);
                let two = joined(&[
                    cuboid([0.0; 3], [1.0; 3], faces_in),
                    cuboid(to, to_max, faces_in),
                ]);
                let mesh = welded(&two);
                assert!(mesh.positions.len() < 16, "{what} is shared");
                let bodies = Bodies::of(&mesh);
                assert_eq!((bodies.count(), bodies.open()), (2, 0), "{what}");
                let own = bodies.of_triangles();
                assert!(own[..12].iter().all(|b| *b == 0), "{what}: {own:?}");
                assert!(own[12..].iter().all(|b| *b == 1), "{what}: {own:?}");
            }
        }
    }

    #[test]
    fn what_shares_an_edge_by_a_part_of_a_face_comes_apart() {
        // A row and a stack: eight cubes about one point, and three along an edge.
        let mut cubes = Vec::new();
        for i in 0..8 {
            let at = [i & 1, (i >> 1) & 1, i >> 2].map(f64::from);
            cubes.push(cuboid(at, at.map(|c| c + 1.0), OUT));
        }
        let bodies = Bodies::of(&welded(&joined(&cubes)));
        assert_eq!(bodies.count(), 8);
        // Its faces are split along the other diagonal, so coincident faces consist of different triangles.
        let mut other = cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0], OUT);
        let at = |t: &[u32; 3]| t.iter().all(|i| other.positions[*i as usize].x == 1.0);
        let ends: Vec<usize> = (0..12).filter(|t| at(&other.triangles[*t])).collect();
        other.triangles[ends[0]] = [0, 4, 2];
        other.triangles[ends[1]] = [2, 4, 6];
        assert!((other.volume() - 1.0).abs() < 1e-12, "still a cube");
        let bodies = Bodies::of(&welded(&joined(&[cuboid([0.0; 3], [1.0; 3], OUT), other])));
        assert_eq!(bodies.count(), 2);
    }

    #[test]
    fn open_shells_are_bodies() {
        let mut open = cube([0.0; 3], 2.0, OUT);
        open.triangles.pop();
        let all = [open, cube([0.0; 3], 1.0, IN), cube([0.0; 3], 0.5, OUT)];
        assert_eq!(bodies_of(&all), [0, 1, 1], "an open shell contains nothing");
        assert_eq!(Bodies::of(&joined(&all)).open(), 1);
        // A fin on an edge of a cube.
        let mut finned = cube([0.0; 3], 1.0, OUT);
        finned.positions.push(DVec3::splat(3.0));
        finned.triangles.push([0, 1, 8]);
        let bodies = Bodies::of(&finned);
        assert_eq!((bodies.count(), bodies.open()), (2, 1));
        // Three sheets at an edge, no two of which belong together.
        let sheets = Mesh {
            positions: (0..5)
                .map(|i| DVec3::new(f64::from(i), f64::from(i * i), f64::from(i % 2)))
                .collect(),
            triangles: vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]],
            corner_normals: None,
            vertex_paint: None,
        };
        assert_eq!(Bodies::of(&sheets).count(), 1);
        assert_eq!(Bodies::of(&Mesh::default()).count(), 0);
    }

    #[test]
    fn triangles_that_contradict_each_other_leave_it_to_parity() {
        let mut inner = cube([0.0; 3], 1.0, OUT);
        inner.triangles[0].swap(1, 2);
        let outer = cube([0.0; 3], 3.0, OUT);
        assert_eq!(bodies_of(&[outer.clone(), inner.clone()]), [0, 0]);
        let cavity = cube([0.0; 3], 2.0, IN);
        assert_eq!(bodies_of(&[outer, cavity, inner]), [0, 0, 1]);
    }

    #[test]
    fn bodies_keep_the_order_of_their_triangles() {
        let (a, b) = (cube([0.0; 3], 1.0, OUT), cube([3.0, 0.0, 0.0], 1.0, OUT));
        let apart = joined(&[a, b]);
        let mut mixed = apart.clone();
        mixed.triangles = (0..24)
            .map(|t| apart.triangles[t % 2 * 12 + t / 2])
            .collect();
        mixed.corner_normals = Some((0..24).map(|t| [glam::Vec3::splat(t as f32); 3]).collect());
        let parts = Part::new("two", mixed.clone()).split();
        let names: Vec<&str> = parts.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["two/1", "two/2"]);
        for (number, part) in parts.iter().enumerate() {
            assert_eq!(
                part.mesh.positions.len(),
                8,
                "vertices of the other are gone"
            );
            for t in 0..12 {
                assert_eq!(part.mesh.corners(t), mixed.corners(2 * t + number));
                let normals = part.mesh.corner_normals.as_ref().expect("normals");
                assert_eq!(normals[t][0].x, (2 * t + number) as f32);
            }
        }
        let one = Part::new("one", cube([0.0; 3], 1.0, OUT));
        let split = one.split();
        assert_eq!((split.len(), split[0].name.as_str()), (1, "one"));
        assert!(std::sync::Arc::ptr_eq(&split[0].mesh, &one.mesh));
    }

    /// Splitmix64 (Steele, Lea & Flood 2014), as numbers from 0 to 1.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut x = self.0;
            x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Corners of all triangles, each rotated to start with its smallest corner, sorted.
    fn as_a_set<'a>(meshes: impl Iterator<Item = &'a Mesh>) -> Vec<[[u64; 3]; 3]> {
        let mut all: Vec<_> = meshes
            .flat_map(|mesh| (0..mesh.triangles.len()).map(|t| mesh.corners(t)))
            .map(|corners| {
                let mut corners = corners.map(|p| p.to_array().map(f64::to_bits));
                let least = (0..3).min_by_key(|i| corners[*i]).unwrap_or(0);
                corners.rotate_left(least);
                corners
            })
            .collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn what_is_split_and_joined_again_is_what_it_was() {
        let specs = [
            "cube",
            "sphere?subdivisions=2",
            "torus?segments=12&sides=8",
            "knot?segments=48&sides=6",
            "shells?subdivisions=1",
        ];
        let shapes: Vec<Mesh> = (specs.iter())
            .flat_map(|s| crate::generate::shapes::shape(s).unwrap_or_else(|e| panic!("{e}")))
            .map(|part| (*part.mesh).clone())
            .collect();
        for seed in 0..60 {
            let mut numbers = Numbers(seed);
            let count = 1 + (numbers.next() * 9.0) as usize;
            // On a coarse grid, so that some touch, some coincide and some contain others.
            let mut placed = Vec::new();
            for _ in 0..count {
                let mut mesh = shapes[(numbers.next() * shapes.len() as f64) as usize].clone();
                let mut step = |most: f64| (numbers.next() * most).floor() * 0.5;
                let to = DVec3::new(step(6.0), step(6.0), step(6.0));
                let size = 0.5 + step(4.0);
                for p in &mut mesh.positions {
                    *p = *p * size + to;
                }
                if numbers.next() < 0.4 {
                    for t in &mut mesh.triangles {
                        t.swap(1, 2);
                    }
                }
                placed.push(mesh);
            }
            let mut whole = joined(&placed);
            if numbers.next() < 0.5 {
                whole = welded(&whole);
            }
            let bodies = Bodies::of(&whole);
            let pieces = Part::new("p", whole.clone()).split();
            assert_eq!(pieces.len(), bodies.count().max(1), "seed {seed}");
            let again = as_a_set(pieces.iter().map(|p| &*p.mesh));
            assert!(again == as_a_set(std::iter::once(&whole)), "seed {seed}");
            // Every body is complete in itself, and bodies are in the order of their first triangles.
            let firsts: Vec<_> = (bodies.triangles().iter()).map(|t| t[0]).collect();
            assert!(firsts.is_sorted(), "seed {seed}");
            // A body that is split is one body.
            for piece in &pieces {
                assert_eq!(Bodies::of(&piece.mesh).count(), 1, "seed {seed}");
            }
        }
        // Control: the comparison detects one flipped and one missing triangle.
        let whole = shapes[0].clone();
        let (mut turned, mut torn) = (whole.clone(), whole.clone());
        turned.triangles[0].swap(0, 1);
        torn.triangles.pop();
        for other in [turned, torn] {
            assert!(as_a_set(std::iter::once(&whole)) != as_a_set(std::iter::once(&other)));
        }
    }

    #[test]
    fn a_lattice_of_thousands_of_bodies_comes_apart() {
        // Boxes with cavities, 16,000 shells with 192,000 triangles in total: testing all pairs would take minutes.
        let mut all = Vec::new();
        for i in 0..8000_u32 {
            let at = [i % 20, i / 20 % 20, i / 400].map(f64::from);
            all.push(cube(at, 0.8, OUT));
            all.push(cube(at, 0.4, IN));
        }
        let mesh = joined(&all);
        let bodies = Bodies::of(&mesh);
        assert_eq!(bodies.count(), 8000);
    }
}
