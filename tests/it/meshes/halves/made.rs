//! Built-in shapes and meshes with known answers.

use super::*;
use crate::common::meshes::{SHAPES, block, joined, parts, turned, without};

fn cube() -> Mesh {
    block(DVec3::splat(-0.5), DVec3::splat(0.5))
}

#[track_caller]
fn near(value: f64, exact: f64, what: &str) {
    assert!(
        (value - exact).abs() < 1e-12,
        "{what}: {value} instead of {exact}"
    );
}

#[test]
fn every_shape_gives_closed_halves_that_make_it_up() {
    for name in SHAPES {
        for part in parts(name) {
            for (cut, regions) in cuts(&part.mesh.bounds()) {
                let what = format!("{name}, {}: {cut}", part.name);
                let halves = checked(&what, &part.mesh, &regions);
                assert!(halves.defects.is_empty(), "{what}: {:?}", halves.defects);
            }
        }
    }
}

#[test]
fn a_corner_of_a_cube_leaves_seven_eighths_and_three_squares() {
    let halves = checked("corner", &cube(), &[removed_box(DVec3::ZERO, DVec3::ONE)]);
    near(volume(&halves.kept), 0.875, "kept");
    near(volume(&halves.removed), 0.125, "removed");
    for half in [&halves.kept, &halves.removed] {
        near(half.cap_area(), 0.75, "three squares");
        let of: Vec<_> = half.caps.iter().map(|c| (c.region, c.plane)).collect();
        assert_eq!(of, [(0, 0), (0, 2), (0, 4)], "the lower faces of the box");
        let caps: usize = half.caps.iter().map(|c| c.triangles.len()).sum();
        assert_eq!(caps, half.mesh.triangles.len() - half.surface_triangles());
    }
    near(halves.removed.mesh.area(), 1.5, "a cube of its own");
}

#[test]
fn nothing_is_left_between_regions_that_touch() {
    // A column through the cube in two boxes; one of them again within both.
    let low = removed_box(DVec3::new(-0.25, -0.25, -2.0), DVec3::new(0.25, 0.25, 0.1));
    let high = removed_box(DVec3::new(-0.25, -0.25, 0.1), DVec3::new(0.25, 0.25, 2.0));
    let again = removed_box(DVec3::new(-0.25, -0.1, -0.3), DVec3::new(0.25, 0.1, 0.3));
    for regions in [vec![low.clone(), high.clone()], vec![low, high, again]] {
        let halves = checked("column", &cube(), &regions);
        near(volume(&halves.kept), 0.75, "kept");
        near(volume(&halves.removed), 0.25, "removed");
        near(halves.kept.cap_area(), 2.0, "four walls and nothing across");
        near(halves.removed.mesh.area(), 2.5, "four walls and two ends");
    }
    // Three quarters of a turn are two regions with a plane in common.
    let halves = checked("wedge", &cube(), &wedge(DVec3::ZERO, DVec3::Z, 0.0, 270.0));
    near(volume(&halves.kept), 0.25, "a quarter");
    near(halves.kept.cap_area(), 1.0, "two walls");
    near(halves.removed.mesh.area(), 4.5 + 1.0, "no wall within");
}

#[test]
fn regions_that_overlap_are_removed_once() {
    let regions = [
        removed_box(DVec3::splat(-0.1), DVec3::splat(1.0)),
        removed_box(DVec3::splat(-1.0), DVec3::splat(0.1)),
        vec![plane(DVec3::ZERO, DVec3::ONE.normalize())],
    ];
    let mesh = ball(DVec3::ZERO, 0.6, 2);
    let halves = checked("overlap", &mesh, &regions);
    winds_as_the_mesh("overlap", &mesh, &regions, &halves);
}

#[test]
fn halves_wind_as_the_mesh_does_where_they_are() {
    for name in [
        "shells?subdivisions=2",
        "torus?segments=20&sides=12",
        "sponge?level=1",
    ] {
        let mesh = &shape(name);
        for (cut, regions) in cuts(&mesh.bounds()) {
            let halves = halves(mesh, &regions);
            winds_as_the_mesh(&format!("{name}: {cut}"), mesh, &regions, &halves);
        }
    }
}

#[test]
fn shells_that_pass_through_each_other_stay_closed() {
    let balls = joined(&[
        ball(DVec3::ZERO, 0.6, 2),
        ball(DVec3::new(0.5, 0.2, 0.1), 0.55, 2),
    ]);
    let boxes = joined(&[cube(), block(DVec3::splat(-0.2), DVec3::splat(0.8))]);
    let twice = joined(&[cube(), cube()]);
    for (name, mesh) in [("balls", balls), ("boxes", boxes), ("a cube twice", twice)] {
        for (cut, regions) in cuts(&mesh.bounds()) {
            let what = format!("{name}: {cut}");
            let halves = checked(&what, &mesh, &regions);
            winds_as_the_mesh(&what, &mesh, &regions, &halves);
        }
    }
}

#[test]
fn a_mesh_that_is_inside_out_stays_so() {
    let mesh = turned(&ball(DVec3::ZERO, 0.5, 2));
    for (cut, regions) in cuts(&mesh.bounds()) {
        let halves = checked(cut, &mesh, &regions);
        winds_as_the_mesh(cut, &mesh, &regions, &halves);
    }
}

#[test]
fn vertices_that_a_file_repeats_are_closed_as_well() {
    let whole = ball(DVec3::ZERO, 0.5, 2);
    let soup = Mesh {
        positions: whole
            .triangles
            .iter()
            .flatten()
            .map(|i| whole.positions[*i as usize])
            .collect(),
        triangles: (0..whole.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
        ..Mesh::default()
    };
    for (cut, regions) in cuts(&whole.bounds()) {
        let halves = halves(&soup, &regions);
        assert!(halves.defects.is_empty(), "{cut}: {:?}", halves.defects);
        for half in [&halves.kept, &halves.removed] {
            assert!(
                is_oriented(&in_f32(&half.mesh)),
                "{cut}: closed where equal vertices are one"
            );
        }
    }
}

#[test]
fn a_hole_stays_a_hole_and_is_told() {
    let mesh = ball(DVec3::ZERO, 0.5, 3);
    let in_the_way = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize].x > 0.01);
        a != b || b != c
    };
    let first = mesh
        .triangles
        .iter()
        .position(in_the_way)
        .expect("some are crossed");
    let mesh = without(&mesh, first);
    let halves_by = |x| halves(&mesh, &[vec![plane(DVec3::X * x, DVec3::X)]]);
    let through = halves_by(0.01);
    assert!(!through.defects.is_empty(), "the outline does not close");
    let beside = halves_by(0.3);
    assert!(beside.defects.is_empty(), "{:?}", beside.defects);
    assert!(
        is_closed(&beside.kept.mesh),
        "the hole is on the other side"
    );
    assert_eq!(
        beside.removed.mesh.open_edges().len(),
        3,
        "and stays what it was"
    );
}

#[test]
fn faces_that_disagree_leave_no_hole() {
    let mut mesh = ball(DVec3::ZERO, 0.5, 2);
    for index in (0..mesh.triangles.len()).step_by(5) {
        mesh.triangles[index].swap(0, 1);
    }
    assert!(!is_oriented(&mesh) && is_closed(&mesh), "the case");
    for (cut, regions) in cuts(&mesh.bounds()) {
        checked(cut, &mesh, &regions);
    }
}

#[test]
fn triangles_beyond_a_region_stay_whole() {
    let mesh = ball(DVec3::ZERO, 0.5, 4);
    let regions = [removed_box(
        DVec3::new(0.35, -0.05, -0.05),
        DVec3::splat(1.0).with_y(0.05).with_z(0.05),
    )];
    let halves = checked("a notch", &mesh, &regions);
    let corners = |mesh: &Mesh, t: &[u32; 3]| {
        t.map(|i| mesh.positions[i as usize].to_array().map(f64::to_bits))
    };
    let of_mesh: BTreeSet<_> = mesh.triangles.iter().map(|t| corners(&mesh, t)).collect();
    let kept = &halves.kept;
    let faces = &kept.mesh.triangles[..kept.surface_triangles()];
    let divided = faces
        .iter()
        .filter(|t| !of_mesh.contains(&corners(&kept.mesh, t)))
        .count();
    let removed = &halves.removed;
    let gone = removed.surface_triangles();
    assert!(
        gone > 10 && divided > 10,
        "the notch meets the surface: {gone}, {divided}"
    );
    assert!(
        divided < 8 * gone,
        "{divided} triangles are divided for {gone} that go"
    );
}

#[test]
fn faces_know_the_triangles_that_they_are_of() {
    let mesh = ball(DVec3::ZERO, 0.5, 2);
    for (cut, regions) in cuts(&mesh.bounds()) {
        let Halves { kept, removed, .. } = halves(&mesh, &regions);
        let mut areas = vec![0.0; mesh.triangles.len()];
        for half in [&kept, &removed] {
            for (face, source) in half.sources.iter().enumerate() {
                let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a) * 0.5;
                let own = normal(half.mesh.corners(face));
                let whole = normal(mesh.corners(*source as usize)).normalize();
                assert!(
                    (own.dot(whole) - own.length()).abs() < 1e-12,
                    "{cut}: {face} faces elsewhere"
                );
                areas[*source as usize] += own.length();
            }
        }
        for (triangle, area) in areas.iter().enumerate() {
            let [a, b, c] = mesh.corners(triangle);
            let whole = 0.5 * (b - a).cross(c - a).length();
            assert!(
                (area - whole).abs() < 1e-12,
                "{cut}: {triangle} has {area} of {whole}"
            );
        }
    }
}

#[test]
fn what_cannot_be_cut_by_is_told() {
    let mut bad = plane(DVec3::ZERO, DVec3::X);
    bad.origin.x = f64::NAN;
    let halves = halves(&cube(), &[vec![bad]]);
    assert_eq!(halves.kept.mesh.triangles.len(), 12, "nothing is done");
    assert_eq!(halves.defects.len(), 1, "{:?}", halves.defects);
    let all = cutaway::slice::halves(&cube(), &[Vec::new()]);
    assert!(
        all.kept.mesh.triangles.is_empty(),
        "no plane bounds the region"
    );
    assert_eq!(all.removed.mesh.triangles.len(), 12, "all of it is removed");
}
