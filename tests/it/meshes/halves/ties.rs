//! Planes through vertices, along edges and in faces.

use super::*;
use crate::common::meshes::{block, joined, parts};

#[test]
fn a_plane_in_a_face_removes_all_or_nothing() {
    let cube = block(DVec3::ZERO, DVec3::ONE);
    for axis in DVec3::AXES {
        for (at, normal, is_kept) in [
            (DVec3::ZERO, axis, true),
            (DVec3::ZERO, -axis, false),
            (DVec3::ONE, axis, false),
            (DVec3::ONE, -axis, true),
        ] {
            let halves = checked("in a face", &cube, &[vec![plane(at, normal)]]);
            let [full, empty] = match is_kept {
                true => [&halves.kept, &halves.removed],
                false => [&halves.removed, &halves.kept],
            };
            assert_eq!(
                full.mesh.triangles, cube.triangles,
                "{at} {normal}: as it was"
            );
            assert!(full.caps.is_empty(), "{at} {normal}: the face needs no cap");
            assert!(
                empty.mesh.triangles.is_empty(),
                "{at} {normal}: nothing without thickness"
            );
        }
    }
}

#[test]
fn a_plane_in_a_step_caps_only_what_is_above() {
    // Two boxes as one mesh: the lower face of one and the upper face of the other in the plane, apart.
    let steps = [
        block(DVec3::ZERO, DVec3::ONE),
        block(DVec3::new(2.0, 0.0, -1.0), DVec3::new(3.0, 1.0, 0.0)),
        block(DVec3::new(4.0, 0.0, -1.0), DVec3::new(5.0, 1.0, 1.0)),
    ];
    let mesh = joined(&steps);
    let halves = checked("steps", &mesh, &[vec![plane(DVec3::ZERO, DVec3::Z)]]);
    assert_eq!([volume(&halves.kept), volume(&halves.removed)], [2.0, 2.0]);
    assert_eq!(
        halves.kept.cap_area(),
        1.0,
        "of the box that is cut through"
    );
}

fn meshes_of(shape: &str) -> Vec<Mesh> {
    let parts = parts(shape);
    parts.iter().map(|p| Mesh::clone(&p.mesh)).collect()
}

#[test]
fn planes_through_every_vertex_of_a_shape() {
    for name in [
        "sponge?level=1",
        "torus?segments=12&sides=8",
        "comb?teeth=3",
        "gears?flank=1",
    ] {
        let mesh = &joined(&meshes_of(name));
        let step = mesh.positions.len().div_ceil(12);
        for at in mesh.positions.iter().step_by(step) {
            for normal in [
                DVec3::X,
                DVec3::NEG_Y,
                DVec3::Z,
                DVec3::new(1.0, 1.0, 0.0),
                DVec3::new(-1.0, 1.0, 1.0),
            ] {
                let what = format!("{name} at {at} by {normal}");
                let region = vec![plane(*at, normal.normalize())];
                let halves = checked(&what, mesh, &[region]);
                assert!(halves.defects.is_empty(), "{what}: {:?}", halves.defects);
            }
            checked(name, mesh, &[removed_box(*at, mesh.bounds().max)]);
            checked(
                name,
                mesh,
                &[removed_box(*at, *at + mesh.bounds().size() * 0.3)],
            );
        }
    }
}

#[test]
fn boxes_in_the_faces_of_a_sponge() {
    let mesh = &shape("sponge?level=2");
    let bounds = mesh.bounds();
    let at = |ninths: f64| bounds.min + bounds.size() * (ninths / 9.0);
    for (low, high) in [(0.0, 3.0), (3.0, 6.0), (1.0, 5.0), (4.0, 9.0)] {
        let regions = [removed_box(at(low), at(high))];
        let halves = checked("sponge", mesh, &regions);
        winds_as_the_mesh("sponge", mesh, &regions, &halves);
    }
}

#[test]
fn what_is_on_the_plane_has_its_coordinate() {
    for (at, axis) in [(0.1, DVec3::X), (0.3, DVec3::Y), (-0.7, DVec3::NEG_Z)] {
        let mesh = ball(DVec3::new(0.01, 0.02, 0.03), 0.9, 3);
        let halves = checked("axis", &mesh, &[vec![plane(axis.abs() * at, axis)]]);
        let kept = &halves.kept.mesh;
        let caps = &kept.triangles[halves.kept.surface_triangles()..];
        assert!(!caps.is_empty(), "it is cut");
        for i in caps.iter().flatten() {
            assert_eq!(
                kept.positions[*i as usize].dot(axis.abs()),
                at,
                "to the last bit"
            );
        }
    }
}

#[test]
fn far_from_the_origin_halves_stay_closed() {
    for far in [1e3, 1e6, 1e9] {
        let middle = DVec3::new(far, -far, 0.5 * far);
        let mesh = ball(middle, 1.0, 3);
        let normal = DVec3::new(0.2, -0.9, 0.4).normalize();
        let halves = halves(&mesh, &[vec![plane(middle, normal)]]);
        for half in [&halves.kept, &halves.removed] {
            assert!(is_oriented(&half.mesh), "at {far}");
            assert!(is_oriented(&in_f32(&half.mesh)), "at {far}, in f32");
        }
        let lost = volume(&halves.kept) + volume(&halves.removed) - mesh.volume();
        assert!(lost.abs() < 1e-15 * far + 1e-12, "at {far}: {lost}");
    }
}
