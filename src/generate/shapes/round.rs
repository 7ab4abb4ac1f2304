//! Balls and shapes made of them: `sphere`, `earth`, `shells`; and `slivers`, a bicone of needle triangles.
//!
//! Balls are icospheres: no poles, nearly equal triangles, volume and area with an error of O(1/4^subdivisions).

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::spec::{ShapeInfo, ShapeParameter, Values};
use super::{Mesh, Part, parts_of};
use crate::scene::Material;

const SUBDIVISIONS: ShapeParameter = ShapeParameter::count(
    "subdivisions",
    "times each triangle of the icosahedron is split in four",
    5,
    [0, 9],
);

/// A ball.
pub(super) const SPHERE: ShapeInfo = ShapeInfo {
    name: "sphere",
    summary: "a ball",
    parameters: &[
        ShapeParameter::length("radius", "radius", 0.5),
        SUBDIVISIONS,
    ],
    triangles: |v| icosphere_triangles(v, 1.0),
    build: |v| {
        let ball = icosphere(v.real("radius"), v.count("subdivisions"));
        Ok(vec![Part::new("sphere", ball)])
    },
};

/// Solid balls inside one another: each also occupies the space of the smaller ones, but where parts overlap the smaller
/// solid wins. A cut therefore shows rings without gaps between them.
pub(super) const EARTH: ShapeInfo = ShapeInfo {
    name: "earth",
    summary: "core, mantle and crust: three nested solid balls, the smaller one wins",
    parameters: &[
        ShapeParameter::length("core", "radius of the core", 0.35),
        ShapeParameter::length("mantle", "radius of the mantle", 0.85),
        ShapeParameter::length("crust", "radius of the crust", 1.0),
        SUBDIVISIONS,
    ],
    triangles: |v| icosphere_triangles(v, 3.0),
    build: |v| {
        let radii = [v.real("core"), v.real("mantle"), v.real("crust")];
        let nested = radii[0] < radii[1] && radii[1] < radii[2];
        v.require(nested, "core mantle crust", "let core < mantle < crust")?;
        let [core, mantle, crust] = radii.map(|r| icosphere(r, v.count("subdivisions")));
        let mut parts = parts_of([("core", core), ("mantle", mantle), ("crust", crust)]);
        let colors = [
            Vec3::new(0.96, 0.78, 0.30),
            Vec3::new(0.80, 0.34, 0.18),
            Vec3::new(0.34, 0.52, 0.62),
        ];
        for (part, color) in parts.iter_mut().zip(colors) {
            part.material = Material {
                color,
                // Each layer shows its own colour on its caps.
                cap_color: Some(color),
                ..Material::default()
            };
        }
        Ok(parts)
    },
};

/// A hollow ball as one mesh with two connected components.
pub(super) const SHELLS: ShapeInfo = ShapeInfo {
    name: "shells",
    summary: "a hollow ball: two spheres in one mesh, the inner one flipped or not",
    parameters: &[
        ShapeParameter::length("radius", "outer radius", 0.5),
        ShapeParameter::length("inner", "inner radius", 0.3),
        ShapeParameter::count(
            "flip_inner",
            "1: the inner sphere faces inward; 0: outward, so that only the even-odd rule finds the void",
            1,
            [0, 1],
        ),
        SUBDIVISIONS,
    ],
    triangles: |v| icosphere_triangles(v, 2.0),
    build: |v| {
        let (outer, inner) = (v.real("radius"), v.real("inner"));
        v.require(inner < outer, "inner radius", "let inner < radius")?;
        let mut mesh = icosphere(outer, v.count("subdivisions"));
        let hole = icosphere(inner, v.count("subdivisions"));
        let first = mesh.positions.len() as u32;
        let flip = v.count("flip_inner") == 1;
        mesh.positions.extend(hole.positions);
        mesh.triangles.extend(hole.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|i| i + first);
            if flip { [a, c, b] } else { [a, b, c] }
        }));
        Ok(vec![Part::new("shells", mesh)])
    },
};

/// Needle triangles that meet in two points: the hardest valid mesh for a rasteriser.
pub(super) const SLIVERS: ShapeInfo = ShapeInfo {
    name: "slivers",
    summary: "a bicone of needle triangles that all meet in two points",
    parameters: &[
        ShapeParameter::length("radius", "radius of the rim", 0.5),
        ShapeParameter::length("height", "from tip to tip along z", 0.5),
        ShapeParameter::count("needles", "triangles at each tip", 1000, [3, 5_000_000]),
    ],
    triangles: |v| v.real("needles") * 2.0,
    build: |v| {
        let (radius, tip) = (v.real("radius"), DVec3::Z * (v.real("height") * 0.5));
        let n = v.count("needles") as u32;
        let mut mesh = Mesh::default();
        for i in 0..n {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(n)).sin_cos();
            mesh.positions.push(DVec3::new(cos, sin, 0.0) * radius);
            let next = (i + 1) % n;
            mesh.triangles.extend([[i, next, n], [next, i, n + 1]]);
        }
        mesh.positions.extend([tip, -tip]);
        Ok(vec![Part::new("slivers", mesh)])
    },
};

fn icosphere_triangles(v: &Values, spheres: f64) -> f64 {
    20.0 * spheres * 4_f64.powf(v.real("subdivisions"))
}

/// A geodesic sphere around the origin.
pub(super) fn icosphere(radius: f64, subdivisions: usize) -> Mesh {
    let golden = (1.0 + 5_f64.sqrt()) * 0.5;
    // The cyclic permutations of a golden rectangle's corners.
    let mut directions: Vec<DVec3> = Vec::new();
    for (a, b) in [
        (1.0, golden),
        (-1.0, golden),
        (1.0, -golden),
        (-1.0, -golden),
    ] {
        let corners = [[0.0, a, b], [a, b, 0.0], [b, 0.0, a]];
        directions.extend(corners.map(|c| DVec3::from_array(c).normalize()));
    }
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    // The hull's faces are the triples of mutual neighbours; neighbours are arccos(1/sqrt 5) apart.
    let near = |a: u32, b: u32| directions[a as usize].dot(directions[b as usize]) > 0.4;
    for a in 0..12 {
        for b in (a + 1..12).filter(|b| near(a, *b)) {
            for c in (b + 1..12).filter(|c| near(a, *c) && near(b, *c)) {
                let [pa, pb, pc] = [a, b, c].map(|i| directions[i as usize]);
                let outward = pa.dot(pb.cross(pc)) > 0.0;
                triangles.push(if outward { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    for _ in 0..subdivisions {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::with_capacity(triangles.len() * 3 / 2);
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = directions[a as usize] + directions[b as usize];
                directions.push(sum.normalize());
                directions.len() as u32 - 1
            })
        };
        let mut finer = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    Mesh {
        positions: directions.into_iter().map(|d| d * radius).collect(),
        triangles,
        corner_normals: None,
        vertex_paint: None,
    }
}
