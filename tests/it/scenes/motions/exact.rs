//! Closed forms: where the vertices of small documents are, by hand.

use std::f64::consts::FRAC_1_SQRT_2;

use cutaway::Part;
use cutaway::scene::{Axis, Deformer, Topology};
use glam::{DAffine3, DQuat, DVec3};
use serde_json::json;

use super::document::{
    Document, about_z, bar_document, bending_bar, cube, cube_document, morphing_cube, prism,
};

/// Numbers of a document are f32, and so are weights.
const ROUNDED: f64 = 1e-6;

fn one(document: &Document) -> Part {
    let loaded = document.load();
    assert_eq!(loaded.parts.len(), 1, "one solid");
    loaded.parts[0].clone()
}

/// Positions in the world, in the order of the file: no vertex of these documents is welded.
fn world(part: &Part) -> Vec<DVec3> {
    let mesh = part.posed_mesh();
    let place = |p: &DVec3| part.world_from_part.transform_point3(*p);
    mesh.positions.iter().map(place).collect()
}

#[track_caller]
fn near(ours: &[DVec3], wanted: &[DVec3]) {
    assert_eq!(ours.len(), wanted.len(), "vertices");
    for (k, (p, q)) in ours.iter().zip(wanted).enumerate() {
        assert!(p.distance(*q) < ROUNDED, "vertex {k} is at {p}, not at {q}");
    }
}

fn wide(positions: &[[f32; 3]]) -> Vec<DVec3> {
    let wide = |p: &[f32; 3]| DVec3::from(p.map(f64::from));
    positions.iter().map(wide).collect()
}

fn bar() -> Vec<DVec3> {
    wide(&prism(&[0.0, 1.0, 2.0], 0.5).0)
}

/// The bar after its tip has turned by an angle: the far ring turns about (1, 0, 0), the middle one goes half the way.
fn bent(degrees: f64) -> Vec<DVec3> {
    let turn = DQuat::from_rotation_z(degrees.to_radians());
    let about = |p: DVec3| DVec3::X + turn * (p - DVec3::X);
    let share = |p: DVec3| p.x / 2.0;
    bar().iter().map(|p| p.lerp(about(*p), share(*p))).collect()
}

#[test]
fn a_bar_bends_by_a_quarter_turn() {
    let part = one(&bending_bar());
    near(&world(&part), &bar());
    let corner = bent(90.0)[11];
    assert!(
        corner.distance(DVec3::new(1.0, 1.0, 0.5)) < 1e-12,
        "{corner}"
    );
    for (time_s, degrees) in [
        (0.0, 0.0),
        (0.5, 45.0),
        (0.9, 81.0),
        (1.0, 90.0),
        (7.0, 90.0),
    ] {
        let now = part.at_time(0, time_s);
        near(&world(&now), &bent(degrees));
        assert!(Topology::new(&now.posed_mesh()).closed);
    }
    // Any order of times: nothing is left over from the last.
    let now = part.at_time(0, 1.0).at_time(0, 0.5);
    near(&world(&now), &bent(45.0));
    assert_eq!(now.clips()[0].name, "rotation");
    assert_eq!(now.clips()[0].duration_s, 1.0);
}

#[test]
#[should_panic(expected = "vertex 5 is at")]
fn another_time_is_another_shape() {
    let part = one(&bending_bar());
    near(&world(&part.at_time(0, 0.9999)), &bent(90.0));
}

#[test]
fn normals_turn_with_the_joints() {
    let mut document = bending_bar();
    let normals = document.floats(&[[0.0, 1.0, 0.0]; 12]);
    document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normals);
    let now = one(&document).at_time(0, 1.0);
    let mesh = now.posed_mesh();
    let all = mesh.corner_normals.as_ref().unwrap();
    for (t, n) in mesh.triangles.iter().zip(all) {
        for (vertex, normal) in t.iter().zip(n) {
            let wanted = [[0.0, 1.0], [-FRAC_1_SQRT_2, FRAC_1_SQRT_2], [-1.0, 0.0]];
            let [x, y] = wanted[*vertex as usize / 4];
            let wanted = DVec3::new(x, y, 0.0);
            assert!(
                normal.as_dvec3().distance(wanted) < 1e-6,
                "{normal} at {vertex}"
            );
        }
    }
}

#[test]
fn a_bar_that_is_bent_at_rest_shows_it_and_unbends() {
    let mut document = bending_bar();
    document.json["nodes"][2]["rotation"] = json!(about_z(90.0));
    let still = document.floats(&[[1.0, 1.0, 1.0]]);
    document.clip(0, "scale", "STEP", &[0.0], still);
    let part = one(&document);
    assert!(
        part.pose.is_rest() && part.motion.is_none(),
        "a plain mesh at rest"
    );
    near(&world(&part), &bent(90.0));
    near(&world(&part.at_time(0, 0.0)), &bar());
    // The second clip moves nothing of it.
    let other = part.at_time(0, 0.5).at_time(1, 0.0);
    assert!(other.pose.is_rest());
    near(&world(&other), &bent(90.0));
    near(&world(&part.at_time(9, 0.5)), &bent(90.0));
}

#[test]
fn placements_hold_at_all_times_and_deformers_stay() {
    let deformer = Deformer::Twist {
        axis: Axis {
            centre: DVec3::ZERO,
            along: DVec3::X,
            across: DVec3::Y,
        },
        turn_per_unit: 0.0,
    };
    for document in [bending_bar(), morphing_cube()] {
        let mut part = one(&document);
        part.pose.deformers.push(deformer);
        let moved = DAffine3::from_scale_rotation_translation(
            DVec3::splat(3.0),
            DQuat::from_rotation_x(1.0),
            DVec3::new(5.0, -2.0, 1.0),
        );
        let unplaced = part.at_time(0, 0.6);
        part.place(moved);
        part.place(DAffine3::from_translation(DVec3::X));
        let wanted: Vec<DVec3> = world(&unplaced)
            .iter()
            .map(|p| moved.transform_point3(*p) + DVec3::X)
            .collect();
        for now in [part.at_time(0, 0.6), part.at_time(0, 0.1).at_time(0, 0.6)] {
            near(&world(&now), &wanted);
            assert_eq!(now.pose.deformers, [deformer]);
        }
        near(&world(&part.at_time(99, 0.0)), &world(&part));
    }
}

/// A cube whose node 0 is moved by one clip; where it is at a time.
fn moved(path: &str, way: &str, times: &[f32], values: &[[f32; 3]], at_s: f64) -> DAffine3 {
    let mut document = cube_document();
    let values = document.floats(values);
    document.clip(0, path, way, times, values);
    let now = one(&document).at_time(0, at_s);
    assert!(now.pose.is_rest(), "a node places its mesh as a whole");
    now.world_from_part
}

#[test]
fn keys_are_stepped_or_joined() {
    let (times, values) = (
        [1.0, 2.0, 4.0],
        [[0.0; 3], [1.0, 0.0, 2.0], [5.0, 1.0, 0.0]],
    );
    let at = |way, time_s| moved("translation", way, &times, &values, time_s).translation;
    for (time_s, stepped, straight) in [
        (0.0, [0.0; 3], [0.0; 3]),
        (1.0, [0.0; 3], [0.0; 3]),
        (1.25, [0.0; 3], [0.25, 0.0, 0.5]),
        (2.0, [1.0, 0.0, 2.0], [1.0, 0.0, 2.0]),
        (3.5, [1.0, 0.0, 2.0], [4.0, 0.75, 0.5]),
        (4.0, [5.0, 1.0, 0.0], [5.0, 1.0, 0.0]),
        (9.0, [5.0, 1.0, 0.0], [5.0, 1.0, 0.0]),
        (f64::NAN, [0.0; 3], [0.0; 3]),
        (f64::INFINITY, [5.0, 1.0, 0.0], [5.0, 1.0, 0.0]),
    ] {
        near(&[at("STEP", time_s)], &[DVec3::from(stepped)]);
        near(&[at("LINEAR", time_s)], &[DVec3::from(straight)]);
    }
    let scaled = moved("scale", "LINEAR", &times, &values, 3.5);
    near(
        &[scaled.transform_vector3(DVec3::ONE)],
        &[DVec3::new(4.0, 0.75, 0.5)],
    );
}

#[test]
fn splines_follow_hermite() {
    let (a, b) = ([1.0_f32, 0.0, -1.0], [3.0_f32, 2.0, 0.5]);
    let (leaves, arrives) = ([0.5_f32, -1.0, 2.0], [4.0_f32, 0.0, -3.0]);
    let unused = [99.0; 3];
    let keys = [unused, a, leaves, arrives, b, unused];
    let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    for time_s in [1.0, 1.3, 2.0, 3.1, 4.0] {
        let (d, s) = (3.0_f64, (time_s - 1.0) / 3.0);
        let wanted = wide(a) * (1.0 + 2.0 * s) * (1.0 - s).powi(2)
            + wide(leaves) * d * s * (1.0 - s).powi(2)
            + wide(b) * s.powi(2) * (3.0 - 2.0 * s)
            + wide(arrives) * d * s.powi(2) * (s - 1.0);
        let is = moved("translation", "CUBICSPLINE", &[1.0, 4.0], &keys, time_s).translation;
        near(&[is], &[wanted]);
    }
}

/// Where node 0 turns the x axis to, by rotations about z as given.
fn turned(way: &str, values: &[[f32; 4]], at_s: f64) -> f64 {
    let mut document = cube_document();
    let times: Vec<f32> = (0..values.len()).map(|k| k as f32).collect();
    let values = document.floats(values);
    document.clip(0, "rotation", way, &times, values);
    let now = one(&document).at_time(0, at_s);
    let x = now.world_from_part.transform_vector3(DVec3::X);
    let is_turn = (x.length() - 1.0).abs() < 1e-12 && x.z.abs() < 1e-12;
    assert!(is_turn, "{x} is no x axis turned about z");
    x.y.atan2(x.x).to_degrees()
}

#[test]
fn rotations_take_the_shorter_way() {
    let minus = |q: [f32; 4]| q.map(|c| -c);
    for (a, b, at_s, degrees) in [
        (about_z(10.0), about_z(130.0), 0.25, 40.0),
        (about_z(10.0), minus(about_z(130.0)), 0.25, 40.0),
        (about_z(-100.0), about_z(100.0), 0.25, -140.0),
        (about_z(0.0), about_z(179.0), 0.5, 89.5),
        (about_z(0.0), about_z(181.0), 0.5, -89.5),
    ] {
        let is = turned("LINEAR", &[a, b], at_s);
        assert!((is - degrees).abs() < 1e-4, "{is} degrees, not {degrees}");
    }
    assert!((turned("STEP", &[about_z(20.0), about_z(80.0)], 0.99) - 20.0).abs() < 1e-4);
    // Lengths other than 1 are no part of a rotation.
    let long = about_z(60.0).map(|c| 3.0 * c);
    assert!((turned("LINEAR", &[about_z(0.0), long], 0.5) - 30.0).abs() < 1e-4);
}

#[test]
fn rotations_of_whole_numbers() {
    let mut document = cube_document();
    let turn = about_z(90.0).map(|c| (c * 32767.0).round() as i16);
    let bytes: Vec<u8> = [[0, 0, 0, i16::MAX], turn]
        .iter()
        .flatten()
        .flat_map(|c| c.to_le_bytes())
        .collect();
    let values = document.accessor(&bytes, 5122, "VEC4", 2);
    document.json["accessors"][values]["normalized"] = json!(true);
    document.clip(0, "rotation", "LINEAR", &[0.0, 1.0], values);
    let now = one(&document).at_time(0, 0.5);
    let x = now.world_from_part.transform_vector3(DVec3::X);
    assert!((x.y.atan2(x.x).to_degrees() - 45.0).abs() < 1e-2, "{x}");
}

/// The cube after its targets: the first lifts the top by its weight, the second shifts all in z by its own.
fn morphed(lift: f64, shift: f64) -> Vec<DVec3> {
    let cube = wide(&cube().0);
    let moved = |p: &DVec3| *p + DVec3::Y * p.y * lift + DVec3::Z * shift;
    cube.iter().map(moved).collect()
}

#[test]
fn targets_add_up_by_their_weights() {
    let part = one(&morphing_cube());
    near(&world(&part), &morphed(0.0, 0.0));
    for time_s in [0.0, 0.5, 1.0] {
        near(
            &world(&part.at_time(0, time_s)),
            &morphed(time_s, 0.5 * time_s),
        );
    }
    let now = part.at_time(0, 0.5);
    assert_eq!(now.pose.weights, [0.5, 0.25]);
    assert_eq!(now.motion.as_ref().unwrap().defect(8), None);
}

#[test]
fn default_weights_are_shown() {
    let mut document = morphing_cube();
    document.json["meshes"][0]["weights"] = json!([0.5, 0.0]);
    let part = one(&document);
    assert!(part.pose.is_rest(), "a plain mesh at rest");
    near(&world(&part), &morphed(0.5, 0.0));
    near(&world(&part.at_time(0, 1.0)), &morphed(1.0, 0.5));
    // A node's own win, and nodes with others do not share what they show.
    document.json["nodes"][0]["weights"] = json!([0.0, 2.0]);
    document.push("nodes", json!({"mesh": 0, "name": "two"}));
    document.json["scenes"] = json!([{"nodes": [0, 1]}]);
    let loaded = document.load();
    near(&world(&loaded.parts[0]), &morphed(0.0, 2.0));
    near(&world(&loaded.parts[1]), &morphed(0.5, 0.0));
    // The clip moves the first one alone.
    near(&world(&loaded.parts[1].at_time(0, 1.0)), &morphed(0.5, 0.0));
}

#[test]
fn sparse_targets_move_what_they_name() {
    let mut document = morphing_cube();
    let (which, by) = (
        document.view(&[0, 5]),
        document.view(
            &[1.0_f32, 0.0, 0.0, 0.0, 0.0, 3.0]
                .map(f32::to_le_bytes)
                .concat(),
        ),
    );
    let target = document.push(
        "accessors",
        json!({
            "componentType": 5126, "type": "VEC3", "count": 8, "min": [0, 0, 0], "max": [1, 1, 1],
            "sparse": {
                "count": 2,
                "indices": {"bufferView": which, "componentType": 5121},
                "values": {"bufferView": by},
            },
        }),
    );
    document.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = json!(target);
    let mut wanted = morphed(0.0, 0.5);
    wanted[0].x += 1.0;
    wanted[5].z += 3.0;
    near(&world(&one(&document).at_time(0, 1.0)), &wanted);
}

#[test]
fn a_second_set_of_influences_counts() {
    let mut document = bending_bar();
    // Node 3 pulls the far ring by half, through the second set; it lifts that by 1 in z.
    document.push("nodes", json!({"name": "lift"}));
    document.json["scenes"] = json!([{"nodes": [0, 1, 3]}]);
    document.json["skins"][0] = json!({"joints": [1, 2, 3]});
    let mut inverse = [[0.0_f32; 16]; 3];
    for matrix in &mut inverse {
        (0..4).for_each(|k| matrix[5 * k] = 1.0);
    }
    inverse[1][12] = -1.0;
    document.json["skins"][0]["inverseBindMatrices"] = json!(document.floats(&inverse));
    let halves: Vec<[f32; 4]> = (0..12)
        .map(|v| [if v < 8 { 0.0 } else { 1.0 }, 0.0, 0.0, 0.0])
        .collect();
    let weights = document.floats(&halves);
    let joints = document.accessor(&[[2_u8, 0, 0, 0]; 12].concat(), 5121, "VEC4", 12);
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = json!(joints);
    attributes["WEIGHTS_1"] = json!(weights);
    let lift = document.floats(&[[0.0; 3], [0.0, 0.0, 1.0]]);
    document.clip(3, "translation", "LINEAR", &[0.0, 1.0], lift);
    let loaded = document.load();
    let said = crate::common::text_of(&loaded.notes);
    assert!(
        said.contains("bar: the weights of 4 vertices did not sum to 1"),
        "{said}"
    );
    let mut wanted = bar();
    wanted[8..].iter_mut().for_each(|p| p.z += 0.5);
    near(&world(&loaded.parts[0].at_time(1, 1.0)), &wanted);
}

#[test]
fn a_mesh_on_one_joint_moves_as_a_whole() {
    let mut document = bending_bar();
    let joints = document.accessor(&[[1_u8, 0, 0, 0]; 12].concat(), 5121, "VEC4", 12);
    let weights = document.floats(&[[1.0, 0.0, 0.0, 0.0]; 12]);
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = json!(joints);
    attributes["WEIGHTS_0"] = json!(weights);
    let part = one(&document);
    let now = part.at_time(0, 1.0);
    assert!(now.pose.is_rest() && now.motion.is_none());
    assert!(std::sync::Arc::ptr_eq(&now.mesh, &part.mesh));
    let turn = DQuat::from_rotation_z(90_f64.to_radians());
    let wanted: Vec<DVec3> = bar()
        .iter()
        .map(|p| DVec3::X + turn * (*p - DVec3::X))
        .collect();
    near(&world(&now), &wanted);
}

#[test]
fn a_file_without_clips_has_none() {
    let part = one(&bar_document());
    assert!(part.clips().is_empty());
    near(&world(&part.at_time(0, 0.5)), &bar());
    let made = Part::new("made", cutaway::scene::Mesh::default());
    assert!(made.clips().is_empty());
    assert_eq!(made.at_time(0, 1.0).world_from_part, DAffine3::IDENTITY);
}

#[test]
fn motion_goes_with_vertices_that_are_dropped_and_parts_that_come_apart() {
    let mut document = Document::new();
    let (corners, triangles) = cube();
    let mut primitives = Vec::new();
    // A vertex that no triangle uses comes first; the second cube stands at x = 5 and goes the other way.
    for (x, by) in [(0.0, 1.0), (5.0, -2.0)] {
        let mut positions = vec![[9.0; 3]];
        positions.extend(corners.iter().map(|[px, y, z]| [px + x, *y, *z]));
        let mut lifts = vec![[7.0; 3]];
        lifts.extend(corners.iter().map(|[px, _, _]| [0.0, by * px, 0.0]));
        let indices: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|i| i + 1)).collect();
        let (at, lift) = (document.floats(&positions), document.floats(&lifts));
        let indices = document.indices(&indices);
        primitives.push(json!({
            "attributes": {"POSITION": at}, "indices": indices, "targets": [{"POSITION": lift}],
        }));
    }
    document.push("meshes", json!({ "primitives": primitives }));
    let weights = document.floats(&[[0.0], [1.0]]);
    document.clip(0, "weights", "LINEAR", &[0.0, 1.0], weights);
    let loaded = document.load();
    let said = crate::common::text_of(&loaded.notes);
    assert!(said.contains("left out 2 vertices"), "{said}");
    assert_eq!(loaded.parts.len(), 2, "two cubes");
    for (part, (x, by)) in loaded.parts.iter().zip([(0.0, 1.0), (5.0, -2.0)]) {
        let moved = |p: &DVec3| *p + DVec3::new(x, by * p.x, 0.0);
        let wanted: Vec<DVec3> = wide(&corners).iter().map(moved).collect();
        near(&world(&part.at_time(0, 1.0)), &wanted);
    }
}
