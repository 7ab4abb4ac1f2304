//! Areas and perimeters against closed forms of the very polygons, and volumes as integrals of areas.

use std::f64::consts::{PI, TAU};

use cutaway::scene::Mesh;
use glam::DVec3;

use crate::meshes::slice::meshes::{lumpy, shape, without};
use crate::meshes::slice::{is_near, near, plane, regular, regular_area, section, slicer, walls};

#[test]
fn a_cube_has_the_areas_of_its_sections() {
    let cube = shape("cube");
    let (root2, root3) = (2.0_f64.sqrt(), 3.0_f64.sqrt());
    for (normal, area, perimeter) in [
        (DVec3::Z, 1.0, 4.0),
        (DVec3::new(1.0, 1.0, 1.0), 0.75 * root3, 3.0 * root2),
        (DVec3::new(1.0, 1.0, 0.0), root2, 2.0 + 2.0 * root2),
        (DVec3::new(0.0, 3.0, 4.0), 1.25, 4.5),
    ] {
        let section = section(&cube, DVec3::ZERO, normal);
        assert_eq!(section.defects, [], "{normal}");
        near(section.area(), area, "area");
        near(section.perimeter(), perimeter, "perimeter");
        assert_eq!(section.loops.len(), 1, "{normal}");
        near(section.loop_area(&section.loops[0]), area, "orientation");
    }
    assert!(!is_near(1.0 + 1e-11, 1.0), "planted");
}

#[test]
fn walls_have_the_area_of_their_outline_over_the_slope() {
    // A cylinder of 360 sides, and a box with a hole of 7.
    let cylinder = vec![regular(360, 0.4)];
    let mut hole = regular(7, 0.3);
    hole.reverse();
    let bored = vec![regular(4, 1.0), hole];
    let bored_area = regular_area(4, 1.0) - regular_area(7, 0.3);
    for (outline, area) in [(cylinder, regular_area(360, 0.4)), (bored, bored_area)] {
        let mesh = walls(&outline);
        for normal in [
            DVec3::Z,
            DVec3::new(0.2, -0.1, 1.0),
            DVec3::new(0.3, 0.4, -1.2),
        ] {
            let section = section(&mesh, DVec3::new(0.0, 0.0, 0.123), normal);
            assert_eq!(section.defects, [], "{normal}");
            near(section.area(), area / normal.normalize().z.abs(), "area");
            let signed: f64 = section.loops.iter().map(|l| section.loop_area(l)).sum();
            let facing = normal.z.signum();
            near(
                signed * facing,
                section.area() * facing,
                "solid on the left",
            );
        }
    }
}

/// A torus around the z axis of `n` by `m` quads, with rings of vertices in the plane z = 0.
fn torus(n: u32, m: u32) -> Mesh {
    let cells = || (0..n).flat_map(|i| (0..m).map(move |j| (i, j)));
    let turn = |i: u32, n: u32| (TAU * f64::from(i) / f64::from(n)).sin_cos();
    let at = |(i, j): (u32, u32)| {
        let ((sin, cos), (rise, reach)) = (turn(i, n), turn(j, m));
        // The sine of half a turn is not quite zero.
        let rise = if j == 0 || 2 * j == m { 0.0 } else { rise };
        let r = 2.0 + 0.5 * reach;
        DVec3::new(r * cos, r * sin, 0.5 * rise)
    };
    let quads = cells().flat_map(|(i, j)| {
        let quad = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let [a, b, c, d] = quad.map(|(i, j)| (i % n) * m + j % m);
        [[a, b, c], [a, c, d]]
    });
    Mesh {
        positions: cells().map(at).collect(),
        triangles: quads.collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

#[test]
fn a_torus_cut_through_its_vertices_is_a_ring() {
    let torus = torus(48, 20);
    for normal in [DVec3::Z, -DVec3::Z] {
        let section = section(&torus, DVec3::ZERO, normal);
        assert_eq!(section.defects, [], "{normal}");
        assert_eq!(section.loops.len(), 2, "{normal}");
        near(
            section.area(),
            regular_area(48, 2.5) - regular_area(48, 1.5),
            "area",
        );
        let side = 2.0 * (PI / 48.0).sin();
        near(section.perimeter(), 48.0 * side * 4.0, "perimeter");
    }
}

/// Hard case 50.
#[test]
fn a_sphere_converges_with_the_square_of_its_edges() {
    for z in [0.0, 0.123, 0.4] {
        let errors = [2, 3, 4, 5].map(|level| {
            let ball = shape(&format!("sphere?radius=0.5&subdivisions={level}"));
            let area = section(&ball, DVec3::Z * z, DVec3::Z).area();
            PI * (0.25 - z * z) - area
        });
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            assert!((3.0..5.5).contains(&ratio), "{errors:?} at {z}");
        }
        assert!(errors[3] > 0.0 && errors[3] < 2e-3, "{errors:?} at {z}");
    }
}

/// The volume by Gauss's rule between the heights of vertices: an area is a quadratic there.
pub(crate) fn volume_by_areas(mesh: &Mesh, normal: DVec3, area: impl Fn(DVec3) -> f64) -> f64 {
    let n = normal.normalize();
    let mut heights: Vec<f64> = mesh.positions.iter().map(|p| p.dot(n)).collect();
    heights.sort_by(f64::total_cmp);
    let slab = |pair: &[f64]| {
        let step = pair[1] - pair[0];
        // Away from the vertices themselves: Gauss's two points are exact for cubics.
        let at = |share: f64| area(n * (pair[0] + step * share));
        let off = 0.5 / 3.0_f64.sqrt();
        if step > 0.0 {
            0.5 * step * (at(0.5 - off) + at(0.5 + off))
        } else {
            0.0
        }
    };
    heights.windows(2).map(slab).sum()
}

#[test]
fn areas_add_up_to_the_volume() {
    for (mesh, normal) in [
        (lumpy(2, 0.2, 1.0), DVec3::new(0.3, -0.5, 0.7)),
        (shape("cube"), DVec3::new(1.0, 0.2, 0.1)),
        (torus(16, 8), DVec3::new(0.1, 1.0, 0.4)),
    ] {
        let volume = mesh.volume();
        let sum = |mesh: &Mesh| {
            let slicer = slicer(mesh);
            let area = |at| slicer.section(&plane(at, normal)).area();
            volume_by_areas(mesh, normal, area)
        };
        let whole = sum(&mesh);
        assert!((whole - volume).abs() < 1e-9 * volume, "{whole} {volume}");
        let open = sum(&without(&mesh, 3));
        assert!((open - volume).abs() > 1e-6 * volume, "planted: {open}");
    }
}
