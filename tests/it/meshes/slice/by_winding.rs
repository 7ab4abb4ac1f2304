//! Sections of open meshes that winding numbers close: the region is that of the whole solid where its outline is there, lines complete it
//! where it is not, and a closed mesh is cut as always.

use cutaway::slice::{HalfPlane, SectionDefect, Trim};
use glam::DAffine3;

use super::*;
use crate::common::meshes::{block, moved, shape};
use crate::common::numbers::Numbers;

/// The mesh without a share of its triangles.
fn with_holes(mesh: &Mesh, share: f64, seed: u64) -> Mesh {
    let mut numbers = Numbers(seed);
    let mut holed = mesh.clone();
    holed.triangles.retain(|_| numbers.unit() >= share);
    holed
}

fn closed(mesh: &Mesh, plane: &SlicePlane) -> Section {
    slicer(mesh).section_by_winding(plane, Fill::EvenOdd)
}

fn length_of_bridges(section: &Section) -> f64 {
    let ends = |line: &[u32; 2]| line.map(|i| section.points[i as usize]);
    let lengths = section.bridges.iter().map(ends).map(|[a, b]| a.distance(b));
    lengths.sum()
}

/// The mesh without the triangles whose corners are all so.
fn without(mesh: &Mesh, is_so: impl Fn(DVec3) -> bool) -> Mesh {
    let mut open = mesh.clone();
    open.triangles
        .retain(|t| !t.iter().all(|i| is_so(mesh.positions[*i as usize])));
    open
}

#[test]
fn a_cube_without_a_side_has_its_section_and_one_line() {
    let cube = without(&block(DVec3::ZERO, DVec3::ONE), |p| p.x == 1.0);
    assert_eq!(cube.triangles.len(), 10, "one side is gone");
    let turned = DAffine3::from_rotation_translation(
        glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7),
        DVec3::new(1e4, -2e3, 70.0),
    );
    for by in [DAffine3::IDENTITY, turned] {
        let (cube, at) = (moved(&cube, by), by.transform_point3(DVec3::splat(0.3)));
        let plane = plane(at, by.transform_vector3(DVec3::Z)).seen_from(at);
        let section = closed(&cube, &plane);
        assert!((section.area() - 1.0).abs() < 1e-8, "{}", section.area());
        assert!(
            (section.perimeter() - 4.0).abs() < 1e-8,
            "{}",
            section.perimeter()
        );
        assert_eq!((section.loops.len(), section.open.len()), (1, 0));
        assert!((length_of_bridges(&section) - 1.0).abs() < 1e-8, "the side");
        let [SectionDefect::Bridged { lines, length, .. }] = section.defects[..] else {
            panic!("{:?}", section.defects);
        };
        assert_eq!(lines, section.bridges.len());
        assert!((length - 1.0).abs() < 1e-8, "{length}");
        assert!(section.is_whole());
        // The control: without winding numbers there is nothing.
        let lost = slicer(&cube).section(&plane);
        assert_eq!((lost.area(), lost.bridges.len()), (0.0, 0));
    }
}

#[test]
fn shapes_with_holes_have_nearly_the_section_of_the_whole() {
    for (name, most) in [
        ("torus", 0.004),
        ("sphere?subdivisions=4", 0.004),
        ("crank", 0.02),
        ("sponge?level=1", 0.02),
    ] {
        let whole = shape(name);
        let middle = whole.bounds().centre();
        for (seed, normal) in [(1, DVec3::Z), (2, DVec3::X), (3, DVec3::new(1.0, 2.0, 3.0))] {
            let plane = plane(middle, normal.normalize());
            let full = slicer(&whole).section(&plane);
            let holed = with_holes(&whole, 0.05, seed);
            let section = closed(&holed, &plane);
            assert!(
                !section.bridges.is_empty(),
                "{name}, {normal}: there are holes in the plane"
            );
            let off = (section.area() / full.area() - 1.0).abs();
            assert!(
                off < most,
                "{name}, {normal}: {off} off the area of the whole"
            );
            // The control: outlines that do not close bound much less.
            let lost = 1.0 - slicer(&holed).section(&plane).area() / full.area();
            assert!(
                lost > 10.0 * off,
                "{name}, {normal}: {lost} lost, {off} off"
            );
        }
    }
}

#[test]
fn closed_meshes_are_cut_as_always() {
    for name in ["torus", "crank", "sponge?level=1"] {
        let mesh = shape(name);
        let plane = plane(
            mesh.bounds().centre(),
            DVec3::new(3.0, 1.0, 2.0).normalize(),
        );
        for rule in [Fill::EvenOdd, Fill::Nonzero] {
            let slicer = slicer(&mesh);
            assert!(
                slicer.section_by_winding(&plane, rule) == slicer.section_by(&plane, rule),
                "{name}"
            );
        }
    }
}

#[test]
fn a_mesh_that_is_inside_out_has_the_same_region() {
    let holed = with_holes(&shape("torus"), 0.05, 5);
    let mut turned = holed.clone();
    turned.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let plane = plane(DVec3::ZERO, DVec3::new(0.1, 1.0, 0.2).normalize());
    for rule in [Fill::EvenOdd, Fill::Nonzero] {
        let areas = [&holed, &turned].map(|m| slicer(m).section_by_winding(&plane, rule).area());
        assert!((areas[0] - areas[1]).abs() < 1e-9, "{areas:?}");
        assert!(areas[0] > 0.1, "{areas:?}");
    }
}

#[test]
fn what_is_trimmed_keeps_its_lines_or_loses_them() {
    let cube = without(&block(DVec3::ZERO, DVec3::ONE), |p| p.x == 1.0);
    let plane = plane(DVec3::splat(0.25), DVec3::Z);
    let section = closed(&cube, &plane);
    let half = |x: f64, towards: f64| {
        let near = plane.coordinates(DVec3::new(x, 0.0, 0.25));
        let far = plane.coordinates(DVec3::new(x + towards, 0.0, 0.25));
        let normal = (near - far).normalize();
        let half = HalfPlane {
            normal,
            offset: -normal.dot(near),
        };
        let trim = Trim {
            within: vec![half],
            without: Vec::new(),
        };
        trim.of(&section, &plane).expect("something is cut off")
    };
    let [left, right] = [half(0.5, -1.0), half(0.5, 1.0)];
    for part in [&left, &right] {
        assert!((part.area() - 0.5).abs() < 1e-12, "{}", part.area());
    }
    assert_eq!(
        (left.bridges.len(), left.defects.len()),
        (0, 0),
        "the open side is cut off"
    );
    assert!((length_of_bridges(&right) - 1.0).abs() < 1e-12);
    assert!(
        matches!(right.defects[..], [SectionDefect::Bridged { .. }]),
        "{:?}",
        right.defects
    );
}

#[test]
fn a_bowl_is_no_solid_beyond_its_rim() {
    // Half a ball without a lid: around points near the rim's plane the number is a half, and beyond it less.
    let ball = shape("sphere?subdivisions=5");
    let mut bowl = ball.clone();
    bowl.triangles
        .retain(|t| t.iter().all(|i| ball.positions[*i as usize].z <= 1e-9));
    let section = closed(&bowl, &plane(DVec3::new(0.0, 0.01, 0.0), DVec3::Y));
    let full = slicer(&ball).section(&plane(DVec3::new(0.0, 0.01, 0.0), DVec3::Y));
    let share = section.area() / full.area();
    assert!((0.4..0.6).contains(&share), "{share}");
    // A flat sheet bounds nothing, and stays open.
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let flat = Mesh {
        positions: corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    };
    let section = closed(&flat, &plane(DVec3::splat(0.3), DVec3::X));
    assert_eq!((section.area(), section.open.len()), (0.0, 1));
    assert!(!section.is_whole());
    // A bent one bounds little.
    let mut sheet = ball.clone();
    sheet
        .triangles
        .retain(|t| t.iter().all(|i| ball.positions[*i as usize].z <= -0.7));
    let section = closed(&sheet, &plane(DVec3::new(0.0, 0.01, 0.0), DVec3::Y));
    assert!(section.area() < 0.1 * full.area(), "{}", section.area());
}
