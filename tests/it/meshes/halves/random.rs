//! Random meshes on a lattice, so that planes pass through vertices, along edges and in faces more often than not.

use proptest::prelude::*;

use super::*;

/// A coordinate of the lattice.
fn step() -> impl Strategy<Value = DVec3> {
    (-3..=3_i32, -3..=3_i32, -3..=3_i32)
        .prop_map(|(x, y, z)| DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
}

/// Tetrahedra, flat ones among them, some of which share vertices with the ones before; turned either way.
fn tetrahedra() -> impl Strategy<Value = Mesh> {
    let one = (prop::array::uniform4(step()), any::<bool>(), 0..3_usize);
    prop::collection::vec(one, 1..5).prop_map(|all| {
        let mut mesh = Mesh::default();
        for (corners, is_turned, shared) in all {
            let shared = shared.min(mesh.positions.len());
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(&corners[shared..]);
            let index = |i: usize| match i < shared {
                true => i as u32,
                false => first + (i - shared) as u32,
            };
            let [a, b, c, d] = [0, 1, 2, 3].map(index);
            let faces = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
            let turned = |[a, b, c]: [u32; 3]| if is_turned { [a, c, b] } else { [a, b, c] };
            mesh.triangles.extend(faces.map(turned));
        }
        mesh
    })
}

/// A plane through a point of the lattice, along an axis, a diagonal or neither.
fn lattice_plane() -> impl Strategy<Value = SlicePlane> {
    let normal = (-2..=2_i32, -2..=2_i32, -2..=2_i32)
        .prop_map(|(x, y, z)| DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
        .prop_filter("a direction", |n| *n != DVec3::ZERO);
    let normal = prop_oneof![
        normal,
        (0..3_usize, any::<bool>())
            .prop_map(|(i, up)| DVec3::AXES[i] * if up { 1.0 } else { -1.0 })
    ];
    (step(), normal).prop_map(|(at, normal)| plane(at, normal.normalize()))
}

fn regions() -> impl Strategy<Value = Vec<Vec<SlicePlane>>> {
    let region = prop_oneof![
        prop::collection::vec(lattice_plane(), 1..4),
        (step(), step()).prop_map(|(a, b)| removed_box(a.min(b), a.max(b))),
    ];
    prop::collection::vec(region, 1..4)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn halves_of_random_meshes_are_closed_and_make_them_up(mesh in tetrahedra(), regions in regions()) {
        let halves = halves(&mesh, &regions);
        let lost = halves.defects.iter().any(cutaway::slice::SectionDefect::loses_cap);
        prop_assert!(!lost, "{:?}", halves.defects);
        let found = defect(&mesh, &halves);
        prop_assert!(found.is_none(), "{}", found.unwrap_or_default());
    }

    #[test]
    fn halves_of_random_meshes_wind_as_they_do(mesh in tetrahedra(), regions in regions()) {
        let halves = halves(&mesh, &regions);
        winds_as_the_mesh("random", &mesh, &regions, &halves);
    }
}
