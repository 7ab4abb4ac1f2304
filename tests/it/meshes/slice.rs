//! Promise: the section of a solid by a plane is the region that geometry says, however the plane meets vertices, edges and
//! faces; what is open, crosses or cannot be computed with is reported; and nothing panics.

mod by_winding;
mod closed_forms;
use crate::common::data;
mod hostile;
mod lines;
use crate::common::meshes;
mod real;
mod regions;
mod ties;

use cutaway::scene::{ClipSurface, Fill, Mesh};
use cutaway::slice::{Section, SlicePlane, Slicer};
use glam::{DVec2, DVec3};

fn plane(origin: DVec3, normal: DVec3) -> SlicePlane {
    SlicePlane::from(&ClipSurface::plane(origin, normal))
}

fn slicer(mesh: &Mesh) -> Slicer {
    Slicer::new(mesh.positions.clone(), &mesh.triangles)
}

fn section(mesh: &Mesh, origin: DVec3, normal: DVec3) -> Section {
    slicer(mesh).section(&plane(origin, normal))
}

fn section_nonzero(mesh: &Mesh, origin: DVec3, normal: DVec3) -> Section {
    slicer(mesh).section_by(&plane(origin, normal), Fill::Nonzero)
}

fn is_near(value: f64, exact: f64) -> bool {
    (value - exact).abs() <= 1e-12 * exact.abs().max(1e-3)
}

#[track_caller]
fn near(value: f64, exact: f64, what: &str) {
    assert!(is_near(value, exact), "{what}: {value} instead of {exact}");
}

/// A regular polygon, the first corner on the first axis, counter-clockwise.
fn regular(corners: u32, radius: f64) -> Vec<DVec2> {
    let angle = |i| std::f64::consts::TAU * f64::from(i) / f64::from(corners);
    (0..corners)
        .map(|i| DVec2::from_angle(angle(i)) * radius)
        .collect()
}

/// Its area.
fn regular_area(corners: u32, radius: f64) -> f64 {
    let angle = std::f64::consts::TAU / f64::from(corners);
    0.5 * f64::from(corners) * angle.sin() * radius * radius
}

/// Walls over polygons from z = -1 to 1, facing outward where a polygon runs counter-clockwise: planes between cut it as if it
/// had ends.
fn walls(polygons: &[Vec<DVec2>]) -> Mesh {
    let mut mesh = Mesh::default();
    for polygon in polygons {
        let (first, n) = (mesh.positions.len() as u32, polygon.len() as u32);
        for z in [-1.0, 1.0] {
            mesh.positions.extend(polygon.iter().map(|p| p.extend(z)));
        }
        mesh.triangles.extend((0..n).flat_map(|i| {
            let j = (i + 1) % n;
            let [a, b, c, d] = [i, j, j + n, i + n].map(|k| k + first);
            [[a, b, c], [a, c, d]]
        }));
    }
    mesh
}
