//! Hard case 49: star polygons, touching loops, islands in holes, and loops of many points.

use std::f64::consts::TAU;

use cutaway::scene::Fill;
use cutaway::slice::{Section, SectionDefect};
use glam::{DVec2, DVec3};

use crate::meshes::slice::lines::fault;
use crate::meshes::slice::{is_near, near, regular, regular_area, section, section_nonzero, walls};

fn flat(polygons: &[Vec<DVec2>]) -> Section {
    section(&walls(polygons), DVec3::Z * 0.25, DVec3::Z)
}

#[test]
fn a_pentagram_is_a_ring_of_points_or_a_star() {
    let corners = regular(5, 1.0);
    let star: Vec<DVec2> = (0..5).map(|i| corners[2 * i % 5]).collect();
    let fifth = TAU / 5.0;
    let inner = fifth.cos() / (0.5 * fifth).cos();
    let whole = 5.0 * inner * (0.5 * fifth).sin();
    let hollow = whole - regular_area(5, inner);
    let by_parity = flat(std::slice::from_ref(&star));
    near(by_parity.area(), hollow, "even-odd");
    let mesh = walls(&[star]);
    let by_winding = section_nonzero(&mesh, DVec3::Z * 0.25, DVec3::Z);
    near(by_winding.area(), whole, "nonzero");
    for section in [by_parity, by_winding] {
        let crossing = matches!(
            section.defects[..],
            [SectionDefect::Crossing { crossings: 5, .. }]
        );
        assert!(crossing && section.is_whole(), "{:?}", section.defects);
    }
}

#[test]
fn stars_whose_lines_all_but_meet_are_filled() {
    for (corners, step) in [(24, 7), (25, 12), (60, 29), (61, 30), (101, 50), (120, 49)] {
        let all = regular(corners, 1.0);
        let star: Vec<DVec2> = (0..corners)
            .map(|i| all[(i * step % corners) as usize])
            .collect();
        let mesh = walls(&[star]);
        for rule in [Fill::EvenOdd, Fill::Nonzero] {
            let slicer = crate::meshes::slice::slicer(&mesh);
            let section =
                slicer.section_by(&crate::meshes::slice::plane(DVec3::ZERO, DVec3::Z), rule);
            assert!(
                section.is_whole(),
                "{corners}/{step}: {:?}",
                section.defects
            );
            assert_eq!(fault(&section, rule), None, "{corners}/{step} {rule:?}");
        }
    }
}

#[test]
fn loops_may_touch_and_nest() {
    // The corners of the diamond lie in the middles of the sides of the square around it.
    let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let square = corners.map(DVec2::from).to_vec();
    let diamond: Vec<DVec2> = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].into();
    let section = flat(&[square, diamond]);
    assert_eq!(section.defects, [], "touching");
    near(section.area(), 2.0, "a diamond in a square");

    let rings: Vec<Vec<DVec2>> = (1..=9).map(|i| regular(4, f64::from(i))).collect();
    let section = flat(&rings);
    assert_eq!(section.defects, [], "islands in holes");
    let alternate =
        (1..=9).map(|i| regular_area(4, f64::from(i)) * if i % 2 == 1 { 1.0 } else { -1.0 });
    near(section.area(), alternate.sum(), "islands in holes");
    assert_eq!(fault(&section, Fill::EvenOdd), None, "islands in holes");
    let mut holed = section.clone();
    holed.triangles.pop();
    assert_ne!(fault(&holed, Fill::EvenOdd), None, "planted");
}

#[test]
fn a_loop_of_many_points_has_its_shoelace_area() {
    let wavy = |count: u32, radius: f64| -> Vec<DVec2> {
        let at = |i: u32| {
            let angle = TAU * f64::from(i) / f64::from(count);
            let waves = 1.0 + 0.1 * (31.0 * angle).sin() + 0.01 * (997.0 * angle).cos();
            DVec2::from_angle(angle) * radius * waves
        };
        (0..count).map(at).collect()
    };
    let shoelace = |points: &[DVec2]| -> f64 {
        let next = points.iter().cycle().skip(1);
        0.5 * points
            .iter()
            .zip(next)
            .map(|(a, b)| a.perp_dot(*b))
            .sum::<f64>()
    };
    let mut hole = wavy(20_001, 0.4);
    hole.reverse();
    let outlines = [wavy(100_000, 1.0), hole];
    let exact: f64 = outlines.iter().map(|o| shoelace(o)).sum();
    // Through the vertices themselves: no point is computed.
    let mut mesh = walls(&outlines);
    mesh.positions.iter_mut().for_each(|p| p.z = p.z.max(0.0));
    let section = section(&mesh, DVec3::Z, -DVec3::Z);
    assert_eq!(section.defects, [], "many points");
    assert_eq!(section.points.len(), 120_001, "points");
    assert!(is_near(section.area(), exact), "{} {exact}", section.area());
    assert_eq!(fault(&section, Fill::EvenOdd), None, "many points");
}
