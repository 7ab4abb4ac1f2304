//! Areas and perimeters against closed forms of the very polygons.

use cutaway::scene::{ClipSurface, Mesh};
use cutaway::slice::{Section, SlicePlane, Slicer};
use glam::DVec3;

use crate::common::meshes::shape;

fn section(mesh: &Mesh, origin: DVec3, normal: DVec3) -> Section {
    let slicer = Slicer::of(mesh.positions.clone(), &mesh.triangles);
    slicer.section(&SlicePlane::from(&ClipSurface::plane(origin, normal)))
}

#[track_caller]
fn near(value: f64, exact: f64, what: &str) {
    assert!(
        (value - exact).abs() <= 1e-12 * exact.abs(),
        "{what}: {value} instead of {exact}"
    );
}

#[test]
fn a_cube_has_the_areas_of_its_sections() {
    let cube = shape("cube");
    for (origin, normal, area, perimeter) in [
        (DVec3::ZERO, DVec3::Z, 1.0, 4.0),
        (
            DVec3::ZERO,
            DVec3::new(1.0, 1.0, 1.0),
            0.75 * 3.0_f64.sqrt(),
            3.0 * 2.0_f64.sqrt(),
        ),
        (
            DVec3::ZERO,
            DVec3::new(1.0, 1.0, 0.0),
            2.0_f64.sqrt(),
            2.0 + 8.0_f64.sqrt(),
        ),
    ] {
        let section = section(&cube, origin, normal);
        assert_eq!(section.defects, [], "{normal}");
        near(section.area(), area, "area");
        near(section.perimeter(), perimeter, "perimeter");
        assert_eq!(section.loops.len(), 1, "{normal}");
        near(section.loop_area(&section.loops[0]), area, "orientation");
    }
}
