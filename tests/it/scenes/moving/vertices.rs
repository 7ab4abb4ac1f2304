//! What the pose pass writes, vertex by vertex.

use cutaway::Model;
use cutaway::plan::Capacities;
use cutaway::plan::pack::unpack_normal;
use cutaway::scene::{Part, Prepared, Scene};
use cutaway::strategies::{self, Strategy};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};

use super::actors::{bent_bar, both, defined, deformed_bar, deformers, morphing_ball, still};
use super::common::{scenes, session};

/// How far a vertex may be from where f64 has it, in scene units: eight units in the last place of 1, for each time that the
/// motion stretches.
const ULPS: f64 = 8.0 * f32::EPSILON as f64;

/// The vertices of a part by rank as the device has them after a frame.
fn vertices(scene: &Scene, model: &Model) -> Vec<(Vec3, Vec3)> {
    let view = model.prepared.view([32, 32]);
    let mut session = session();
    let strategy = Strategy::RAYCAST_MASK;
    let drawn = session.draw(model, &view, strategy);
    let drawn = drawn.unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    assert_eq!(drawn.outcome.reason(), None, "{}", scene.name);
    let words = session.words(strategy, "vertices").expect("the vertices");
    let all = words.as_chunks::<4>().0.iter();
    all.map(|[x, y, z, n]| {
        let at = [*x, *y, *z].map(f32::from_bits);
        (Vec3::from_array(at), unpack_normal(*n))
    })
    .collect()
}

/// The largest errors of the posed vertices of part 0: in scene units against the truth, and in degrees.
fn errors(scene: &Scene, model: &Model) -> [f64; 2] {
    let part = &scene.parts[0];
    let truth = Prepared::new(scene);
    let rank = truth
        .parts
        .iter()
        .position(|p| p.part == 0)
        .expect("part 0");
    assert!(model.moving[rank].is_some(), "part 0 moves");
    let vertices = vertices(scene, model);
    let range = &model.ranges[rank];
    let indices: Vec<u32> = bytemuck::pod_collect_to_vec(&model.indices.bytes());
    let own = &indices[range.indices.start as usize..range.indices.end as usize];

    let mut rest = Part::new("rest", part.mesh.clone());
    rest.motion = part.motion.clone();
    let rest = Prepared::new(&scenes::of_parts("rest", vec![rest], Vec::new()));
    let shading = &rest.parts[0].shading;
    let normals_by = part.world_from_part.matrix3.inverse().transpose();

    let mut bits = vec![None; part.mesh.positions.len()];
    let [mut farthest, mut turned] = [0.0_f64; 2];
    for (t, triangle) in own.as_chunks::<3>().0.iter().enumerate() {
        // A drawn triangle may begin at another of its corners.
        let drawn = triangle.map(|v| shading.positions_of_vertex[v as usize]);
        let turns =
            (0..3).map(|by| [0, 1, 2].map(|k| truth.parts[rank].triangles[t][(k + by) % 3]));
        assert!(
            turns.into_iter().any(|t| t == drawn),
            "{}: triangle {t}",
            scene.name
        );
        for k in 0..3 {
            let (at, normal) = vertices[(range.base_vertex + triangle[k] as i32) as usize];
            let position = drawn[k] as usize;
            let wanted = truth.parts[rank].positions[position];
            farthest = farthest.max((at - wanted).as_dvec3().abs().max_element());
            let known = bits[position].get_or_insert(at);
            assert_eq!(*known, at, "{}: position {position} is torn", scene.name);

            let at_rest = shading.normals[triangle[k] as usize];
            let (point, moved) = defined(part, position, at_rest.as_dvec3());
            let in_scene = (part.world_from_part.transform_point3(point) - truth.centre_in_world)
                * truth.scale;
            let gap = (in_scene - wanted.as_dvec3()).abs().max_element();
            assert!(gap < ULPS, "{}: the f64 path is {gap} off", scene.name);
            let moved = (normals_by * moved).normalize_or_zero();
            let angle = moved.angle_between(normal.as_dvec3()).to_degrees();
            turned = turned.max(angle);
        }
    }
    [farthest, turned]
}

/// How far a vertex of a part that is drawn is from the truth, in scene units. What a cut removes altogether is not placed.
pub(super) fn farthest_of_moving(scene: &Scene, model: &Model) -> f64 {
    if model.moving.iter().all(Option::is_none) {
        return 0.0;
    }
    let truth = Prepared::new(scene);
    let vertices = vertices(scene, model);
    // Planned anew: other tests may have made the shared session forget.
    let view = model.prepared.view([32, 32]);
    let plan = strategies::plan(model, &view, Strategy::RAYCAST_MASK, &Capacities::UNKNOWN);
    let plan = plan.unwrap_or_else(|refusal| panic!("{}", refusal.reason));
    let placed: Vec<String> = plan.passes.iter().map(|p| p.name.clone()).collect();
    let indices: Vec<u32> = bytemuck::pod_collect_to_vec(&model.indices.bytes());
    let mut farthest = 0.0_f64;
    for (rank, part) in truth.parts.iter().enumerate() {
        assert_eq!(part.part, model.prepared.parts[rank].part, "ranks");
        if model.moving[rank].is_some() && !placed.contains(&format!("place {}", part.part)) {
            continue;
        }
        let range = &model.ranges[rank];
        let own = &indices[range.indices.start as usize..range.indices.end as usize];
        for (corners, positions) in own.as_chunks::<3>().0.iter().zip(part.triangles.iter()) {
            // A drawn triangle may begin at another of its corners.
            let gap_turned = |by: usize| {
                let gaps = (0..3).map(|k| {
                    let (at, _) = vertices[(range.base_vertex + corners[k] as i32) as usize];
                    let gap = (at - part.positions[positions[(k + by) % 3] as usize]).abs();
                    f64::from(gap.max_element())
                });
                gaps.fold(0.0, f64::max)
            };
            let gap = (0..3).map(gap_turned).fold(f64::INFINITY, f64::min);
            farthest = farthest.max(gap);
        }
    }
    farthest
}

fn scene_of(name: &str, part: Part) -> Scene {
    let other = still("torus", DVec3::new(1.2, 0.3, 0.0));
    let plane = cutaway::ClipSurface::plane(DVec3::Z * 0.05, DVec3::new(0.1, 0.2, -1.0));
    scenes::of_parts(name, vec![part, other], vec![plane])
}

fn placements() -> [(&'static str, DAffine3); 4] {
    let turned = DQuat::from_rotation_z(0.7) * DQuat::from_rotation_x(0.3);
    let uneven = DMat3::from_quat(turned) * DMat3::from_diagonal(DVec3::new(1.5, 0.7, 1.0));
    [
        ("at home", DAffine3::IDENTITY),
        (
            "far away",
            DAffine3::from_rotation_translation(turned, DVec3::new(900.0, -700.0, 400.0)),
        ),
        (
            "uneven",
            DAffine3::from_mat3_translation(uneven, DVec3::new(0.3, -0.2, 0.5)),
        ),
        (
            "mirrored",
            DAffine3::from_scale(DVec3::new(-1.0, 1.2, 0.9)) * DAffine3::from_quat(turned),
        ),
    ]
}

#[test]
fn the_device_poses_as_the_definition_does() {
    let mut actors = vec![
        ("bent", bent_bar(70.0), 1.0),
        ("bent far", bent_bar(-130.0), 1.0),
        ("egg", morphing_ball([1.0, 0.0]), 1.0),
        ("waves", morphing_ball([-0.4, 1.3]), 1.0),
        ("both", both(60.0, 0.7), 1.0),
    ];
    for (name, list) in deformers() {
        // Twisting and bending stretch by up to 1 + turn times reach.
        actors.push((name, deformed_bar(list.clone(), None), 4.0));
        actors.push((name, deformed_bar(list, Some(35.0)), 4.0));
    }
    for (name, part, stretch) in actors {
        for (place, placement) in placements() {
            let mut part = part.clone();
            part.world_from_part = placement;
            let mut scene = scene_of(&format!("{name} {place}"), part);
            scene.parts[1].world_from_part = placement * scene.parts[1].world_from_part;
            scene.cuts[0].surfaces[0].origin += placement.translation;
            let model = Model::new(&scene);
            let [farthest, turned] = errors(&scene, &model);
            assert!(
                farthest <= ULPS * stretch,
                "{}: {farthest:e} scene units off",
                scene.name
            );
            assert!(turned < 1.0, "{}: normals {turned} degrees off", scene.name);
        }
    }
}

#[test]
fn a_part_that_is_moved_as_a_whole_is_placed_by_the_device() {
    let mut scene = scene_of("rigid", still("moved", DVec3::ZERO));
    let mut model = Model::new(&scene);
    assert!(model.prepared.is_whole(), "nothing has moved yet");
    scene.stage = Some(scene.bounds());
    for (step, (place, placement)) in placements().into_iter().enumerate().skip(2) {
        scene.name = format!("rigid {place}");
        scene.parts[0].world_from_part = placement;
        model = model.updated(&scene);
        let moving = model.moving.iter().filter(|m| m.is_some()).count();
        assert_eq!(moving, 1, "step {step}: the other part stands still");
        let [farthest, turned] = errors(&scene, &model);
        assert!(farthest <= 2.0 * ULPS, "{place}: {farthest:e} off");
        assert!(turned < 1.0, "{place}: normals {turned} degrees off");
    }
}

#[test]
fn a_vertex_that_is_off_is_noticed() {
    // The control: the device is given one pose, the truth another that differs by a thousandth of a degree.
    let scene = scene_of("stale", bent_bar(70.0));
    let other = scene_of("stale", bent_bar(70.001));
    let [farthest, _] = errors(&other, &Model::new(&scene));
    assert!(farthest > ULPS, "only {farthest:e} scene units off");
}
