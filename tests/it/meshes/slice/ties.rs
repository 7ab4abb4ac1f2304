//! Planes through faces, edges and vertices (hard cases 2 and 3), and meshes that share, repeat or lack them.

use cutaway::scene::Mesh;
use cutaway::slice::SectionDefect;
use glam::DVec3;

use crate::meshes::slice::meshes::{
    block, cells, joined, moved, shape, turned, with_degenerate, without,
};
use crate::meshes::slice::{near, section, section_nonzero};

#[test]
fn a_face_in_the_plane_is_cut_iff_the_solid_is_above() {
    let cube = shape("cube");
    let up = 0.5_f64.next_up();
    let down = 0.5_f64.next_down();
    for (z, normal, area) in [
        (0.5, DVec3::Z, 0.0),
        (0.5, -DVec3::Z, 1.0),
        (-0.5, DVec3::Z, 1.0),
        (-0.5, -DVec3::Z, 0.0),
        (up, DVec3::Z, 0.0),
        (down, DVec3::Z, 1.0),
        (-up, -DVec3::Z, 0.0),
        (-down, -DVec3::Z, 1.0),
    ] {
        let section = section(&cube, DVec3::Z * z, normal);
        assert_eq!(section.defects, [], "{z} {normal}");
        near(section.area(), area, "area");
    }
    // A step: the wider layer below z = 1, the narrower one above.
    let step = cells(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]], 1.0);
    for (normal, area) in [(DVec3::Z, 1.0), (-DVec3::Z, 2.0)] {
        let section = section(&step, DVec3::Z, normal);
        assert_eq!(section.defects, [], "{normal}");
        near(section.area(), area, "the layer above the plane");
    }
}

#[test]
fn planes_through_edges_and_vertices_leave_nothing_open() {
    let cube = shape("cube");
    let corner = DVec3::splat(0.5);
    let diagonal = DVec3::new(1.0, 1.0, 1.0);
    for (origin, normal, area) in [
        // Through two edges and the diagonals of two faces.
        (DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0), 2.0_f64.sqrt()),
        (DVec3::ZERO, DVec3::new(0.0, 1.0, 1.0), 2.0_f64.sqrt()),
        // Through one edge, and through one vertex, that it only touches.
        (corner, DVec3::new(1.0, 1.0, 0.0), 0.0),
        (corner, diagonal, 0.0),
        // Through three vertices.
        (DVec3::new(0.5, 0.5, -0.5), diagonal, 0.75_f64.sqrt()),
    ] {
        for normal in [normal, -normal] {
            for mesh in [&cube, &turned(&cube), &with_degenerate(&cube)] {
                let section = section(mesh, origin, normal);
                assert_eq!(section.defects, [], "{origin} {normal}");
                near(section.area(), area, "area");
            }
        }
    }
}

#[test]
fn solids_that_touch_are_two_loops() {
    // Along an edge that four triangles share, and in a vertex of the section.
    let touching = cells(&[[0, 0, 0], [1, 1, 0]], 1.0);
    for normal in [DVec3::Z, DVec3::new(0.1, 0.2, 1.0), -DVec3::Z] {
        let section = section(&touching, DVec3::new(1.0, 1.0, 0.5), normal);
        assert_eq!(section.defects, [], "{normal}");
        assert_eq!(section.loops.len(), 2, "{normal}");
        near(section.area(), 2.0 / normal.normalize().z.abs(), "area");
        assert!(section.triangles.len() >= 4, "{normal}");
    }
}

#[test]
fn shells_that_repeat_nest_or_overlap_follow_the_rule() {
    let cube = shape("cube");
    let inner = block(DVec3::splat(-0.25), DVec3::splat(0.25));
    let shifted = moved(
        &cube,
        glam::DAffine3::from_translation(DVec3::new(0.5, 0.25, 0.1)),
    );
    for (what, mesh, even_odd, nonzero) in [
        ("twice", joined(&[cube.clone(), cube.clone()]), 0.0, 1.0),
        (
            "thrice",
            joined(&[cube.clone(), cube.clone(), cube.clone()]),
            1.0,
            1.0,
        ),
        (
            "hollow",
            joined(&[cube.clone(), turned(&inner)]),
            0.75,
            0.75,
        ),
        ("nested", joined(&[cube.clone(), inner.clone()]), 0.75, 1.0),
        (
            "overlap",
            joined(&[cube.clone(), shifted]),
            2.0 - 2.0 * 0.375,
            2.0 - 0.375,
        ),
        ("undone", joined(&[cube.clone(), turned(&cube)]), 0.0, 0.0),
    ] {
        let [by_parity, by_winding] = [
            section(&mesh, DVec3::Z * 0.1, DVec3::Z),
            section_nonzero(&mesh, DVec3::Z * 0.1, DVec3::Z),
        ];
        assert!(by_parity.is_whole() && by_winding.is_whole(), "{what}");
        near(by_parity.area(), even_odd, what);
        near(by_winding.area(), nonzero, what);
        let crosses =
            (by_parity.defects.iter()).any(|d| matches!(d, SectionDefect::Crossing { .. }));
        assert_eq!(crosses, what == "overlap", "{:?}", by_parity.defects);
    }
}

/// Every triangle with vertices of its own.
fn torn(mesh: &Mesh) -> Mesh {
    let corners = (0..mesh.triangles.len()).flat_map(|t| mesh.corners(t));
    Mesh {
        positions: corners.collect(),
        triangles: (0..mesh.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

#[test]
fn equal_vertices_close_what_indices_do_not() {
    let ball = shape("sphere?radius=0.5&subdivisions=3");
    let (origin, normal) = (DVec3::new(0.1, 0.05, 0.02), DVec3::new(0.3, 0.2, 1.0));
    let shared = section(&ball, origin, normal);
    let own = section(&torn(&ball), origin, normal);
    assert_eq!(own.defects, [], "torn");
    assert_eq!(own.points, shared.points, "bit for bit");
    near(own.area(), shared.area(), "area");
}

#[test]
fn what_is_open_is_told_and_the_rest_is_capped() {
    let cube = shape("cube");
    let other = moved(&cube, glam::DAffine3::from_translation(DVec3::X * 3.0));
    // A triangle of the wall x = -1/2 or such: some one of them is crossed.
    let mut walls = 0;
    for gone in 0..cube.triangles.len() {
        let mesh = joined(&[without(&cube, gone), other.clone()]);
        let section = section(&mesh, DVec3::Z * 0.1, DVec3::Z);
        if section.is_whole() {
            assert_eq!((section.defects.len(), section.open.len()), (0, 0));
            near(section.area(), 2.0, "the lost triangle is not met");
            continue;
        }
        walls += 1;
        near(section.area(), 1.0, "the other cube");
        assert_eq!(section.open.len(), 1, "one chain");
        let message = section.defects[0].to_string();
        assert!(message.contains("1 curves"), "{message}");
    }
    assert_eq!(walls, 8, "triangles of the four walls");
}
