//! Meshes that are no built-in shapes: boxes in one mesh, lumpy balls, and defective meshes. The functions take specs that are written
//! in the source, so an invalid spec panics.

use std::collections::HashMap;
use std::f64::consts::TAU;

use cutaway::generate::shapes;
use cutaway::scene::{Mesh, Part};
use glam::{DAffine3, DQuat, DVec2, DVec3};

/// The mesh of a shape that has exactly one part.
pub fn shape(spec: &str) -> Mesh {
    let parts = shapes::shape(spec).unwrap_or_else(|e| panic!("{spec}: {e}"));
    assert_eq!(parts.len(), 1, "{spec} has more than one part");
    Mesh::clone(&parts[0].mesh)
}

/// The parts of a shape.
pub fn parts(spec: &str) -> Vec<Part> {
    shapes::shape(spec).unwrap_or_else(|e| panic!("{spec}: {e}"))
}

/// A box between two corners.
pub fn block(min: DVec3, max: DVec3) -> Mesh {
    moved(
        &shape("cube"),
        DAffine3::from_translation((min + max) * 0.5) * DAffine3::from_scale(max - min),
    )
}

/// A mesh with its vertices transformed.
pub fn moved(mesh: &Mesh, by: DAffine3) -> Mesh {
    Mesh {
        positions: mesh
            .positions
            .iter()
            .map(|p| by.transform_point3(*p))
            .collect(),
        ..mesh.clone()
    }
}

/// Several meshes as one.
pub fn joined(meshes: &[Mesh]) -> Mesh {
    let mut all = Mesh::default();
    for mesh in meshes {
        let first = all.positions.len() as u32;
        all.positions.extend(&mesh.positions);
        all.triangles
            .extend(mesh.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    all
}

/// The same solid with the orientation of every triangle reversed.
pub fn turned(mesh: &Mesh) -> Mesh {
    Mesh {
        triangles: mesh
            .triangles
            .iter()
            .map(|[a, b, c]| [*a, *c, *b])
            .collect(),
        ..mesh.clone()
    }
}

/// The union of full lattice cells, as the faces between full and empty cells. Cell `(0, 0, 0)` is between the origin and `size`.
pub fn cells(full: &[[i32; 3]], size: f64) -> Mesh {
    let mut mesh = Mesh::default();
    let mut names = HashMap::new();
    let mut corner = |at: [i32; 3], positions: &mut Vec<DVec3>| {
        *names.entry(at).or_insert_with(|| {
            positions.push(DVec3::from_array(at.map(f64::from)) * size);
            positions.len() as u32 - 1
        })
    };
    for cell in full {
        for axis in 0..3 {
            for far in [0, 1] {
                let mut next = *cell;
                next[axis] += 2 * far - 1;
                if full.contains(&next) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[i, j]| {
                    let mut at = *cell;
                    at[axis] += far;
                    at[u] += i;
                    at[v] += j;
                    corner(at, &mut mesh.positions)
                });
                let [a, b, c, d] = quad;
                mesh.triangles.extend(if far == 1 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, c, b], [a, d, c]]
                });
            }
        }
    }
    mesh
}

/// Closed prisms with `sides` sides and length 4, side by side in a square of side 2: their triangles are long, narrow and oblique.
pub fn prisms(count: usize, sides: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let per_row = (count as f64).sqrt().ceil() as usize;
    let pitch = 2.0 / per_row as f64;
    for prism in 0..count {
        let first = mesh.positions.len() as u32;
        let middle = DVec2::new((prism % per_row) as f64, (prism / per_row) as f64) * pitch - 1.0;
        for x in [-2.0, 2.0] {
            let corner = |i: u32| {
                let turn = TAU * f64::from(i) / f64::from(sides);
                let at = middle + 0.4 * pitch * DVec2::from_angle(turn);
                DVec3::new(x, at.x, at.y)
            };
            mesh.positions.extend((0..sides).map(corner));
        }
        for i in 0..sides {
            let [a, b] = [i, (i + 1) % sides].map(|corner| first + corner);
            mesh.triangles.push([a, b, b + sides]);
            mesh.triangles.push([a, b + sides, a + sides]);
        }
        for i in 1..sides - 1 {
            mesh.triangles.push([first, first + i + 1, first + i]);
            mesh.triangles
                .push([sides, sides + i, sides + i + 1].map(|corner| first + corner));
        }
    }
    let turn = DQuat::from_rotation_z(0.21) * DQuat::from_rotation_y(0.13);
    mesh.positions.iter_mut().for_each(|p| *p = turn * *p);
    mesh
}

/// A closed rod with `teeth` teeth around it, 2 wide and 6 long. Its walls are long and narrow, and face in four directions in turn.
pub fn toothed(teeth: u32) -> Mesh {
    let count = 4 * teeth;
    let corner = |i: u32, y: f64| {
        let radius = if i % 4 < 2 { 1.0 } else { 0.92 };
        let at = radius * DVec2::from_angle(TAU * f64::from(i) / f64::from(count));
        DVec3::new(at.x, at.y, y)
    };
    let mut mesh = Mesh::default();
    for end in [-3.0, 3.0] {
        mesh.positions.extend((0..count).map(|i| corner(i, end)));
    }
    let [low, high] = [2 * count, 2 * count + 1];
    mesh.positions.extend([-3.0 * DVec3::Z, 3.0 * DVec3::Z]);
    for i in 0..count {
        let [a, b] = [i, (i + 1) % count];
        let wall = [[a, b, b + count], [a, b + count, a + count]];
        mesh.triangles.extend(wall);
        mesh.triangles
            .extend([[low, b, a], [high, a + count, b + count]]);
    }
    mesh
}

/// A ball with lumps: each vertex of an icosphere moved along its radius by `lumps` at most, in smooth waves.
pub fn lumpy(subdivisions: u32, lumps: f64, phase: f64) -> Mesh {
    let mut ball = shape(&format!("sphere?radius=0.5&subdivisions={subdivisions}"));
    for p in &mut ball.positions {
        let d = p.normalize_or(DVec3::X);
        let wave = (7.0 * d.x + phase).sin() * (6.0 * d.y - 2.0 * phase).cos()
            + 0.5 * (13.0 * d.z + 3.0 * phase).sin();
        *p *= 1.0 + lumps * wave / 1.5;
    }
    ball
}

/// A mesh without one of its triangles.
pub fn without(mesh: &Mesh, triangle: usize) -> Mesh {
    let mut open = mesh.clone();
    open.triangles.remove(triangle);
    open
}

/// A mesh with degenerate triangles: one with an index twice, one with a point twice, one with three collinear points.
pub fn with_degenerate(mesh: &Mesh) -> Mesh {
    let mut mesh = mesh.clone();
    let [a, b, c] = mesh.triangles[0];
    let middle = mesh.positions.len() as u32;
    let [pa, pb, _] = mesh.corners(0);
    mesh.positions.extend([(pa + pb) * 0.5, pa]);
    mesh.triangles.extend([
        [a, a, b],
        [c, b, c],
        [a, a, a],
        [a, middle, b],
        [middle + 1, a, c],
    ]);
    mesh
}

/// A mesh with each triangle split in three at a point that is `share` of the way from an edge to the opposite corner:
/// one of the three is a needle.
pub fn with_needles(mesh: &Mesh, share: f64) -> Mesh {
    let mut mesh = mesh.clone();
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.triangles[t];
        let [pa, pb, pc] = mesh.corners(t);
        let point = mesh.positions.len() as u32;
        mesh.positions.push(((pa + pb) * 0.5).lerp(pc, share));
        mesh.triangles[t] = [a, b, point];
        mesh.triangles.extend([[b, c, point], [c, a, point]]);
    }
    mesh
}
