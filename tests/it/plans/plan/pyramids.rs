//! Which way rays go through reliefs, and what a frame holds for it.

use cutaway::scene::{Camera, Viewpoint};
use cutaway::strategies::{DrawOptions, Method, ReliefWalk};

use super::*;

/// Waves of so many texels a side, one repeat across a cube.
fn waves(texels: u32) -> Cut {
    let heights = (0..texels * texels).map(|i| {
        let [x, y] = [i % texels, i / texels].map(|t| f64::from(t) / f64::from(texels) * 20.0);
        (x.sin() * y.cos()) as f32
    });
    let map = OffsetMap::new([texels; 2], heights.collect()).expect("finite heights");
    let mut cut = planes(0.1, 1);
    cut.surfaces[0].relief = Some(Arc::new(map));
    cut.surfaces[0].scale.z = 0.05;
    cut
}

/// The cube cut by waves, seen at an angle to the normal of the clip-surface.
fn cube(texels: u32, angle_deg: f64) -> Scene {
    let mut scene = scene_of(&["cube"], vec![waves(texels)]);
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: angle_deg,
            elevation_deg: 5.0,
        },
        ..scene.camera
    };
    scene
}

fn planned(scene: &Scene, walk: Option<ReliefWalk>) -> Plan {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE);
    let options = DrawOptions {
        relief_walk: walk,
        ..DrawOptions::default()
    };
    let strategy = Strategy::RAYCAST_MASK;
    let plan = strategies::plan(
        &model,
        &view,
        Method::new(strategy, options),
        &Capacities::UNKNOWN,
    );
    let plan = plan.unwrap_or_else(|e| panic!("{e}"));
    (plan.check(&Limits::CORE)).unwrap_or_else(|e| panic!("{e}"));
    plan
}

fn pyramid_passes(plan: &Plan) -> Vec<&str> {
    let mut names = passes(plan);
    names.retain(|n| n.starts_with("pyramid"));
    names
}

#[test]
fn many_cells_take_a_pyramid_and_few_none() {
    let reason = |plan: &Plan| pass(plan, "crossings").reason.clone();
    let grazing = planned(&cube(256, 87.0), None);
    assert_eq!(pyramid_passes(&grazing), ["pyramid 0", "pyramid 1"]);
    assert!(
        reason(&grazing).contains("passed over by a pyramid: a ray meets about"),
        "{}",
        reason(&grazing)
    );
    for (what, plan) in [
        ("seen steeply", planned(&cube(64, 2.0), None)),
        ("few texels", planned(&cube(4, 87.0), None)),
    ] {
        assert_eq!(pyramid_passes(&plan), [""; 0], "{what}");
        for resource in ["pyramids", "pyramid_table"] {
            assert!(
                plan.resource_named(resource).is_none(),
                "{what}: {resource}"
            );
        }
        let reason = reason(&plan);
        assert!(
            reason.contains("walked cell by cell: a ray meets about"),
            "{what}: {reason}"
        );
    }
}

#[test]
fn planes_alone_have_no_pyramid_whatever_is_asked_for() {
    let scene = scene_of(&["cube"], vec![planes(0.1, 3)]);
    let plan = planned(&scene, Some(ReliefWalk::Pyramid));
    assert_eq!(plan, planned(&scene, None));
    assert_eq!(pyramid_passes(&plan), [""; 0]);
}

#[test]
fn options_force_either_way() {
    for (angle_deg, walk, count) in [(87.0, ReliefWalk::Cells, 0), (5.0, ReliefWalk::Pyramid, 2)] {
        let plan = planned(&cube(256, angle_deg), Some(walk));
        assert_eq!(pyramid_passes(&plan).len(), count, "{walk}");
        let reason = &pass(&plan, "crossings").reason;
        assert!(reason.contains("as asked for"), "{reason}");
    }
}

#[test]
fn a_pyramid_follows_the_map_alone() {
    let of = |change: fn(&mut Scene)| {
        let mut scene = cube(256, 87.0);
        change(&mut scene);
        planned(&scene, Some(ReliefWalk::Pyramid))
    };
    let before = of(|_| ());
    assert!(
        before
            .passes
            .iter()
            .all(|p| p.clock == Clock::Cut || p.clock == Clock::Frame),
        "nothing is made of the solid"
    );
    let due = |change: fn(&mut Scene)| -> Vec<String> {
        let due = of(change).due_after(&before, |_| false);
        (due.passes.into_iter())
            .filter(|p| p.starts_with("pyramid"))
            .collect()
    };
    assert_eq!(due(|_| ()), [""; 0], "nothing changed");
    assert_eq!(
        due(|scene| {
            scene.camera.viewpoint = Viewpoint::Orbit {
                azimuth_deg: 70.0,
                elevation_deg: 1.0,
            };
        }),
        [""; 0],
        "another view"
    );
    assert_eq!(
        due(|scene| {
            let surface = &mut scene.cuts[0].surfaces[0];
            surface.origin.z -= 0.05;
            surface.scale.z *= 1.1;
        }),
        [""; 0],
        "a clip-surface that moves keeps its heights"
    );
    assert_eq!(
        due(|scene| {
            let surface = &mut scene.cuts[0].surfaces[0];
            let map = surface.relief.as_ref().expect("a relief");
            let mut texels = map.texels().to_vec();
            texels[77] += 0.5;
            let map = OffsetMap::new(map.size(), texels);
            surface.relief = Some(Arc::new(map.expect("finite and complete")));
        }),
        ["pyramid 0", "pyramid 1"],
        "another map"
    );
    assert_eq!(
        due(|scene| scene.cuts[0].surfaces[0].wrap = Wrap::Clamp),
        ["pyramid 0", "pyramid 1"],
        "a map that goes on otherwise"
    );
}

#[test]
fn a_map_too_long_for_a_dispatch_is_walked() {
    let mut scene = cube(16, 87.0);
    let heights = (0..2_200_000).map(|i| (i % 7) as f32).collect();
    let map = OffsetMap::new([2_200_000, 1], heights).expect("finite heights");
    scene.cuts[0].surfaces[0].relief = Some(Arc::new(map));
    let plan = planned(&scene, None);
    assert_eq!(pyramid_passes(&plan), [""; 0]);
    let reason = &pass(&plan, "crossings").reason;
    assert!(reason.contains("their pyramids are too large"), "{reason}");
}

#[test]
fn a_camera_that_orbits_builds_pyramids_once() {
    let strategy = Strategy::RAYCAST_MASK;
    let mut session = cutaway::session::Session::new(crate::common::gpu());
    let model = Model::new(&cube(256, 5.0));
    let (mut built, mut walked) = (Vec::new(), 0);
    // There and back, twice: what is chosen by each view alone changes four times.
    for angle_deg in [5.0, 30.0, 60.0, 75.0, 87.0, 60.0, 5.0, 87.0, 5.0] {
        let view = (model.prepared).view_of(&cube(256, angle_deg).camera, [48, 40]);
        walked += u32::from(pyramid_passes(&planned(&cube(256, angle_deg), None)).is_empty());
        let drawn = session.draw(&model, &view, strategy);
        let drawn = drawn.unwrap_or_else(|e| panic!("{e}"));
        if drawn.clocks.contains(Clock::Cut) {
            built.push(angle_deg);
        }
    }
    assert!(walked >= 3, "views of their own choice: {walked} need none");
    assert_eq!(
        built,
        [5.0, 60.0],
        "the first frame, and the first that has a pyramid"
    );
}
