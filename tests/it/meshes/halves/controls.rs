//! Each check of halves can fail.

use super::*;
use crate::common::meshes::{joined, turned};

/// What it is, what is said of it, and how it is planted.
type Fault = (&'static str, &'static str, fn(&mut Halves));

#[test]
fn planted_faults_are_found() {
    let mesh = ball(DVec3::ZERO, 0.5, 2);
    let regions = [vec![plane(DVec3::new(0.1, 0.0, 0.0), DVec3::X)]];
    let sound = halves(&mesh, &regions);
    assert_eq!(
        defect(&mesh, &sound),
        None,
        "the halves that faults are planted in"
    );
    let faults: [Fault; 7] = [
        ("a cap that is missing", "opposites", |h| {
            h.kept.mesh.triangles.pop();
        }),
        ("a face that is turned", "opposites", |h| {
            h.removed.mesh.triangles[3].swap(0, 1)
        }),
        ("a vertex that is not shared", "opposites", |h| {
            let at = h.kept.mesh.positions[0];
            let used = h
                .kept
                .mesh
                .triangles
                .iter_mut()
                .find(|t| t.contains(&0))
                .expect("it is used");
            let corner = used.iter_mut().find(|i| **i == 0).expect("it is a corner");
            *corner = h.kept.mesh.positions.len() as u32;
            h.kept.mesh.positions.push(at + DVec3::splat(1e-9));
        }),
        ("a corner twice", "twice", |h| {
            let t = h.kept.mesh.triangles[0];
            h.kept
                .mesh
                .triangles
                .extend([[t[0], t[0], t[1]], [t[0], t[1], t[0]]]);
        }),
        ("a shell twice", "volumes", |h| {
            let again = h.kept.mesh.triangles.clone();
            h.kept.mesh.triangles.extend(again);
            let last = h.kept.caps.last_mut().expect("it is capped");
            last.triangles.end = h.kept.mesh.triangles.len();
        }),
        ("caps in disorder", "one after the other", |h| {
            h.kept.caps[0].triangles.end -= 1
        }),
        ("caps that lie apart", "different points", |h| {
            let corner = h.removed.mesh.triangles[h.removed.surface_triangles()][0];
            h.removed.mesh.positions[corner as usize].x += 1e-15;
        }),
    ];
    for (what, said, plant) in faults {
        let mut broken = sound.clone();
        plant(&mut broken);
        let found = defect(&mesh, &broken).unwrap_or_default();
        assert!(found.contains(said), "{what}: {found}");
    }
}

#[test]
fn rounding_apart_is_found() {
    // A vertex that is rounded in two ways: as a writer would that computes it anew for each triangle.
    let mesh = ball(DVec3::ZERO, 0.5, 2);
    let mut soup = in_f32(&mesh);
    assert!(is_oriented(&soup), "rounded once");
    let at = soup.positions[soup.triangles[0][0] as usize];
    soup.triangles[0][0] = soup.positions.len() as u32;
    soup.positions.push(
        at.as_vec3()
            .to_array()
            .map(f32::next_up)
            .map(f64::from)
            .into(),
    );
    assert!(!is_oriented(&in_f32(&soup)), "rounded twice");
}

#[test]
#[should_panic(expected = "at ")]
fn a_cap_that_is_filled_in_is_found() {
    // A hollow ball whose cap covers the hollow as well.
    let regions = [vec![plane(DVec3::ZERO, DVec3::X)]];
    let outer = ball(DVec3::ZERO, 0.5, 2);
    let inner = ball(DVec3::ZERO, 0.3, 2);
    let hollow = joined(&[outer.clone(), turned(&inner)]);
    winds_as_the_mesh("hollow", &hollow, &regions, &halves(&outer, &regions));
}
