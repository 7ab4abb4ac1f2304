//! Promise: what planes leave of a closed mesh and what they remove are closed meshes whose faces agree which side is out, however the
//! planes meet vertices, edges and faces; together they are the mesh; and no wall is left where regions touch.

mod controls;
mod made;
mod overlaps;
mod random;
mod real;
mod slivers;
mod ties;

use std::collections::{BTreeMap, BTreeSet};

use cutaway::scene::{Block, Bounds, ClipSurface, Mesh, Up, Wedge};
use cutaway::slice::{Half, Halves, SlicePlane, halves};
use glam::{DAffine3, DVec3};

use crate::common::meshes::{moved, shape};
use crate::common::numbers::Numbers;

/// Volumes add up to this share of the cube of the diagonal.
const VOLUME: f64 = 1e-12;

fn plane(origin: DVec3, normal: DVec3) -> SlicePlane {
    SlicePlane::from(&ClipSurface::plane(origin, normal))
}

fn planes_of<'a>(
    faces: impl IntoIterator<Item = &'a cutaway::scene::RegionFace>,
) -> Vec<SlicePlane> {
    let planes = faces.into_iter().map(|f| SlicePlane::from(&f.plane));
    planes.collect()
}

/// A ball with a radius, of 20 triangles and four times as many for each subdivision.
fn ball(middle: DVec3, radius: f64, subdivisions: u32) -> Mesh {
    let ball = shape(&format!(
        "sphere?radius={radius}&subdivisions={subdivisions}"
    ));
    moved(&ball, DAffine3::from_translation(middle))
}

/// A box that is removed.
fn removed_box(min: DVec3, max: DVec3) -> Vec<SlicePlane> {
    let block = Block {
        min: min.to_array().map(Some),
        max: max.to_array().map(Some),
    };
    planes_of(&block.faces(DVec3::ZERO, Up::PlusY))
}

/// A slice of pie about an axis, in degrees.
fn wedge(origin: DVec3, along: DVec3, from_deg: f64, to_deg: f64) -> Vec<Vec<SlicePlane>> {
    let wedge = Wedge {
        origin,
        along,
        zero: cutaway::scene::next_axis(along),
        from_deg,
        to_deg,
        min: None,
        max: None,
    };
    let alternatives = wedge.alternatives(false, Up::PlusY);
    alternatives.iter().map(planes_of).collect()
}

/// Cuts of all sorts of a mesh in some box.
fn cuts(bounds: &Bounds) -> Vec<(&'static str, Vec<Vec<SlicePlane>>)> {
    let at = |share: f64| bounds.min + bounds.size() * share;
    let middle = bounds.centre();
    vec![
        ("a plane in the middle", vec![vec![plane(middle, DVec3::X)]]),
        (
            "an oblique plane",
            vec![vec![plane(
                middle,
                DVec3::new(0.31, 0.52, -0.79).normalize(),
            )]],
        ),
        (
            "a corner",
            vec![removed_box(middle, bounds.max + bounds.size())],
        ),
        ("a box within", vec![removed_box(at(0.2), at(0.7))]),
        ("a wedge", wedge(middle, DVec3::Z, 10.0, 100.0)),
        ("a wide wedge", wedge(middle, DVec3::Y, 0.0, 250.0)),
        (
            "boxes that touch",
            vec![
                removed_box(at(0.1), at(0.5)),
                removed_box(at(0.5).with_x(at(0.1).x), at(0.9)),
            ],
        ),
    ]
}

/// For each edge how often it is passed from its lesser vertex to the greater, less the other way, and how often at all.
fn uses(mesh: &Mesh) -> Vec<(i32, usize)> {
    let directed = |[a, b, c]: &[u32; 3]| [[*a, *b], [*b, *c], [*c, *a]];
    let ordered = |[from, to]: [u32; 2]| ([from.min(to), from.max(to)], from < to);
    let mut edges: Vec<_> = (mesh.triangles.iter())
        .flat_map(directed)
        .map(ordered)
        .collect();
    edges.sort_unstable();
    let edges = edges.chunk_by(|(a, _), (b, _)| a == b);
    let net = |edge: &[([u32; 2], bool)]| edge.iter().map(|(_, up)| if *up { 1 } else { -1 }).sum();
    edges.map(|edge| (net(edge), edge.len())).collect()
}

/// Whether every directed edge has its opposite.
fn is_oriented(mesh: &Mesh) -> bool {
    uses(mesh).iter().all(|(net, _)| *net == 0)
}

/// Whether every edge has an even number of faces.
fn is_closed(mesh: &Mesh) -> bool {
    uses(mesh).iter().all(|(_, all)| all % 2 == 0)
}

/// What an STL file makes of a mesh: vertices are their f32s, and triangles have three of them.
fn in_f32(mesh: &Mesh) -> Mesh {
    let bits = |p: &DVec3| p.as_vec3().to_array().map(|c| (c + 0.0).to_bits());
    let mut number = BTreeMap::new();
    let mut positions = Vec::new();
    let numbers: Vec<u32> = (mesh.positions.iter())
        .map(|p| {
            *number.entry(bits(p)).or_insert_with(|| {
                positions.push(p.as_vec3().as_dvec3());
                positions.len() as u32 - 1
            })
        })
        .collect();
    let triangles = mesh
        .triangles
        .iter()
        .map(|t| t.map(|i| numbers[i as usize]));
    Mesh {
        triangles: triangles
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect(),
        positions,
        ..Mesh::default()
    }
}

fn volume(half: &Half) -> f64 {
    match half.mesh.triangles.is_empty() {
        true => 0.0,
        false => half.mesh.volume(),
    }
}

/// By how much the volumes of halves are more than that of their mesh. Around one point for all, so that what they share cancels; by the
/// sides of triangles, for the products of corners that are far from the point cancel; and with what additions round away.
fn lost(mesh: &Mesh, halves: &Halves) -> f64 {
    let middle = mesh.bounds().centre();
    let six = |mesh: &Mesh| -> Vec<f64> {
        let of = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            (a - middle).dot((b - a).cross(c - a))
        };
        mesh.triangles.iter().map(of).collect()
    };
    let mut terms = [six(&halves.kept.mesh), six(&halves.removed.mesh)].concat();
    terms.extend(six(mesh).iter().map(|v| -v));
    let (sum, rounded) = terms.iter().fold((0.0_f64, 0.0), |(sum, rounded), term| {
        let next = sum + term;
        let rest = match sum.abs() >= term.abs() {
            true => (sum - next) + term,
            false => (term - next) + sum,
        };
        (next, rounded + rest)
    });
    (sum + rounded) / 6.0
}

/// Everything that must hold of the halves of a mesh.
fn defect(mesh: &Mesh, halves: &Halves) -> Option<String> {
    let Halves { kept, removed, .. } = halves;
    let (must_be_oriented, must_be_closed) = (is_oriented(mesh), is_closed(mesh));
    for (name, half) in [("kept", kept), ("removed", removed)] {
        let flat = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
        if half.mesh.triangles.iter().any(flat) {
            return Some(format!("{name}: a corner twice"));
        }
        if must_be_oriented && !is_oriented(&half.mesh) {
            return Some(format!("{name}: edges without their opposites"));
        }
        if must_be_closed && !is_closed(&half.mesh) {
            return Some(format!("{name}: open edges"));
        }
        if must_be_oriented && !is_oriented(&in_f32(&half.mesh)) {
            return Some(format!("{name}: open after rounding"));
        }
        let caps: Vec<_> = half.caps.iter().map(|c| c.triangles.clone()).collect();
        let starts = caps.iter().map(|c| c.start).skip(1);
        let starts = starts.chain([half.mesh.triangles.len()]);
        if !(caps.iter().map(|c| c.end).zip(starts)).all(|(end, start)| end == start) {
            return Some(format!("{name}: caps that are not one after the other"));
        }
    }
    let size = mesh.bounds().size();
    let room = size.length().powi(3);
    let lost = lost(mesh, halves);
    if must_be_oriented && lost.abs() > VOLUME * room {
        return Some(format!(
            "volumes are {lost:e} more than the whole of {}",
            mesh.volume()
        ));
    }
    let cap_points = |half: &Half| -> BTreeSet<[u64; 3]> {
        let caps = &half.mesh.triangles[half.surface_triangles()..];
        let points = caps
            .iter()
            .flatten()
            .map(|i| half.mesh.positions[*i as usize]);
        points.map(|p| p.to_array().map(f64::to_bits)).collect()
    };
    if cap_points(kept) != cap_points(removed) {
        return Some("caps have different points".to_owned());
    }
    None
}

/// Halves of a mesh, of which all holds that must.
#[track_caller]
fn checked(what: &str, mesh: &Mesh, regions: &[Vec<SlicePlane>]) -> Halves {
    let halves = halves(mesh, regions);
    if let Some(defect) = defect(mesh, &halves) {
        panic!("{what}: {defect}");
    }
    halves
}

/// How often a mesh winds around a point: the solid angle of its triangles (Van Oosterom and Strackee 1983).
fn winding(mesh: &Mesh, at: DVec3) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize] - at);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.triangles.iter().map(angle).sum::<f64>() / (2.0 * std::f64::consts::TAU)
}

/// Asks at scattered points whether each half winds as the mesh does where it is, and not at all elsewhere.
#[track_caller]
fn winds_as_the_mesh(what: &str, mesh: &Mesh, regions: &[Vec<SlicePlane>], halves: &Halves) {
    let bounds = mesh.bounds();
    let mut numbers = Numbers(7);
    for _ in 0..60 {
        let share = DVec3::from_array([0, 1, 2].map(|_| numbers.unit()));
        let at = bounds.min - 0.1 + (bounds.size() + 0.2) * share;
        let heights = || regions.iter().map(|r| r.iter().map(|p| p.height(at)));
        // Near a plane and near the mesh solid angles are rounded to either side.
        let angle = winding(mesh, at);
        if heights().flatten().any(|h| h.abs() < 1e-6) || (angle - angle.round()).abs() > 1e-6 {
            continue;
        }
        let is_removed = heights().any(|mut all| all.all(|h| h < 0.0));
        let whole = angle.round() + 0.0;
        let expected = if is_removed {
            [0.0, whole]
        } else {
            [whole, 0.0]
        };
        let found =
            [&halves.kept, &halves.removed].map(|half| winding(&half.mesh, at).round() + 0.0);
        assert_eq!(found, expected, "{what} at {at}");
    }
}
