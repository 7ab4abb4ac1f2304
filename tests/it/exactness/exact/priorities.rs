//! Which part is shown where solids share a point: the higher priority, 0 where none is given, then the smaller solid.

use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Cut, Part, Prepared, Scene};
use cutaway_lab::exact::evaluate;
use cutaway_lab::hard_cases::{meshes, scenes};
use glam::{DAffine3, DVec3};

/// Cubes around the origin, each in the next, by edge length and priority.
fn nested(cubes: &[(f64, Option<i32>)]) -> Scene {
    let parts = cubes.iter().enumerate().map(|(i, (size, priority))| {
        let mut part = Part::new(format!("cube {i}"), meshes::shape("cube"));
        part.world_from_part = DAffine3::from_scale(DVec3::splat(*size));
        part.priority = *priority;
        part
    });
    Scene {
        parts: parts.collect(),
        cuts: vec![Cut::new(
            "cut",
            vec![ClipSurface::plane(DVec3::ZERO, DVec3::NEG_Z)],
        )],
        camera: scenes::parallel(DVec3::Z * 4.0, DVec3::ZERO, 2.0),
        ..Scene::default()
    }
}

#[test]
fn a_part_without_a_priority_has_0() {
    let large = 1.0;
    let small = 0.5;
    for (cubes, in_the_middle) in [
        // A negative priority is below none, a positive one above.
        ([(large, None), (small, Some(-2))], 0),
        ([(large, Some(-2)), (small, None)], 1),
        ([(large, Some(1)), (small, None)], 0),
        // Of equals the smaller solid, whether 0 was written or not.
        ([(large, Some(0)), (small, None)], 1),
        ([(large, None), (small, Some(0))], 1),
        ([(small, None), (large, None)], 0),
    ] {
        let prepared = Prepared::new(&nested(&cubes));
        let exact = evaluate(&prepared, &prepared.view([16, 16]));
        let middle = exact.layers.at(8, 8);
        assert_eq!(middle.kind, Kind::Cap, "{cubes:?}");
        assert_eq!(middle.part, in_the_middle, "{cubes:?}");
    }
}
