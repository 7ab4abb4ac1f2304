//! `house`: walls around rooms, a roof, and furniture in the rooms.

use glam::{DVec2, DVec3, Vec3};

use super::milled::{Facing, Milled, WallSide};
use super::spec::{ShapeInfo, ShapeParameter};
use super::{Mesh, Part};
use crate::Result;
use crate::scene::{Material, Role};

pub(super) const HOUSE: ShapeInfo = ShapeInfo {
    name: "house",
    summary: "a house: walls around four rooms, a roof, and furniture within",
    parameters: &[ShapeParameter::real(
        "wall",
        "thickness of the walls",
        0.08,
        [0.01, 0.14],
    )],
    triangles: |_| 600.0,
    build: |v| {
        let wall = v.real("wall");
        let mut parts = vec![
            part(
                "walls",
                walls(wall)?,
                Role::Exterior,
                Vec3::new(0.82, 0.78, 0.70),
            ),
            part("roof", roof()?, Role::Exterior, Vec3::new(0.66, 0.32, 0.24)),
        ];
        for (name, [low, high], color) in FURNITURE {
            let solid = block(DVec3::from(low), DVec3::from(high))?;
            parts.push(part(name, solid, Role::Interior, Vec3::from(color)));
        }
        Ok(parts)
    },
};

/// Half extents along z and x, then the heights of walls and ridge.
const HALF: DVec2 = DVec2::new(1.0, 1.5);
const WALLS: f64 = 1.0;
const RIDGE: f64 = 1.75;
const EAVES: f64 = 0.15;
const FLOOR: f64 = 0.06;
/// Interior-point spacing so large that planar faces get no interior points.
const NO_POINTS: f64 = 100.0;

/// Name, minimum and maximum corner, and colour.
type Furniture = (&'static str, [[f64; 3]; 2], [f32; 3]);

/// Furniture of the rooms.
const FURNITURE: [Furniture; 5] = [
    (
        "bed",
        [[0.3, 0.06, 0.2], [1.2, 0.3, 0.75]],
        [0.45, 0.55, 0.75],
    ),
    (
        "table",
        [[-1.1, 0.06, -0.7], [-0.5, 0.45, -0.3]],
        [0.60, 0.44, 0.28],
    ),
    (
        "stove",
        [[0.25, 0.06, -0.85], [0.6, 0.55, -0.5]],
        [0.35, 0.36, 0.38],
    ),
    (
        "shelf",
        [[-1.35, 0.06, 0.25], [-1.15, 0.8, 0.8]],
        [0.55, 0.42, 0.30],
    ),
    (
        "bath",
        [[-0.9, 0.06, 0.5], [-0.2, 0.32, 0.85]],
        [0.86, 0.88, 0.90],
    ),
];

fn part(name: &str, mesh: Mesh, role: Role, color: Vec3) -> Part {
    Part {
        role,
        material: Material {
            color,
            ..Material::default()
        },
        ..Part::new(name, mesh)
    }
}

/// A rectangle between two corners, counter-clockwise.
fn rectangle(low: DVec2, high: DVec2) -> Vec<DVec2> {
    vec![
        low,
        DVec2::new(high.x, low.y),
        high,
        DVec2::new(low.x, high.y),
    ]
}

/// Maps a solid with a vertical axis to world space: its planes have coordinates z and x.
fn upright(station: f64, p: DVec2) -> DVec3 {
    DVec3::new(p.y, station, p.x)
}

fn walls(wall: f64) -> Result<Mesh> {
    let mut solid = Milled::default();
    let outer = rectangle(-HALF, HALF);
    let rim = solid.walls(WallSide::Outer, [0.0, WALLS].map(|y| (y, outer.clone())));
    let mut top = vec![rim.1];
    let (inner, half) = (HALF - wall, wall / 2.0);
    for (z, x) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        let near = DVec2::new(z, x) * half;
        let far = DVec2::new(z, x) * inner;
        let room = rectangle(near.min(far), near.max(far));
        let room = solid.walls(WallSide::Bore, [FLOOR, WALLS].map(|y| (y, room.clone())));
        solid.face(Facing::Front, &[room.0], NO_POINTS);
        top.push(room.1);
    }
    solid.face(Facing::Back, &[rim.0], NO_POINTS);
    solid.face(Facing::Front, &top, NO_POINTS);
    solid.mesh(upright)
}

/// A gable roof along x, solid.
fn roof() -> Result<Mesh> {
    let mut solid = Milled::default();
    // The profile perpendicular to x: y, then z.
    let out = HALF.x + EAVES;
    let gable = vec![
        DVec2::new(WALLS, -out),
        DVec2::new(RIDGE, 0.0),
        DVec2::new(WALLS, out),
    ];
    let ends = [-HALF.y - EAVES, HALF.y + EAVES];
    let rim = solid.walls(WallSide::Outer, ends.map(|x| (x, gable.clone())));
    solid.face(Facing::Back, &[rim.0], NO_POINTS);
    solid.face(Facing::Front, &[rim.1], NO_POINTS);
    solid.mesh(|x, p| DVec3::new(x, p.x, p.y))
}

fn block(low: DVec3, high: DVec3) -> Result<Mesh> {
    let mut solid = Milled::default();
    let outline = rectangle(DVec2::new(low.z, low.x), DVec2::new(high.z, high.x));
    let rim = solid.walls(
        WallSide::Outer,
        [low.y, high.y].map(|y| (y, outline.clone())),
    );
    solid.face(Facing::Back, &[rim.0], NO_POINTS);
    solid.face(Facing::Front, &[rim.1], NO_POINTS);
    solid.mesh(upright)
}
