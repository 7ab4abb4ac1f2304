//! Broken motion: the mesh is shown all the same, and a note says what was left out; what the mesh itself needs is refused.

use cutaway::scene::Topology;
use cutaway_io::load::load_mesh_file;
use serde_json::json;

use super::command::Scratch;
use super::document::{Document, bending_bar, cube_document, morphing_cube};

/// A fault, how it gets into a document, and what is said about it.
type Fault = (&'static str, fn(&mut Document), &'static [&'static str]);

/// The document that a fault gets into.
type Whole = fn() -> Document;

/// Writes numbers over the accessor that JSON names.
fn values<const N: usize>(document: &mut Document, what: &str, items: &[[f32; N]]) {
    let accessor = document.floats(items);
    document.json["animations"][0]["samplers"][0][what] = json!(accessor);
}

fn set(document: &mut Document, at: &str, value: serde_json::Value) {
    let place = document.json.pointer_mut(at);
    *place.unwrap_or_else(|| panic!("{at} is not there")) = value;
}

const CHANNEL: &str = "/animations/0/channels/0";
const SAMPLER: &str = "/animations/0/samplers/0";

/// Faults of the clip `rotation` of a bending bar: it goes, all else stays.
const CLIPS: &[Fault] = &[
    (
        "times that do not ascend",
        |d| values(d, "input", &[[1.0], [0.0]]),
        &["times do not ascend"],
    ),
    (
        "equal times",
        |d| values(d, "input", &[[1.0], [1.0]]),
        &["times do not ascend"],
    ),
    (
        "a time before the beginning",
        |d| values(d, "input", &[[-1.0], [1.0]]),
        &["key 0 is -1"],
    ),
    (
        "a time that is none",
        |d| values(d, "input", &[[0.0], [f32::NAN]]),
        &["key 1 is NaN"],
    ),
    (
        "an endless time",
        |d| values(d, "input", &[[0.0], [f32::INFINITY]]),
        &["key 1 is inf"],
    ),
    (
        "too many times",
        |d| values(d, "input", &[[0.0], [1.0], [2.0]]),
        &["2 values for 3 keys"],
    ),
    (
        "a value that is none",
        |d| values(d, "output", &[[0.0, 0.0, 0.0, 1.0], [f32::NAN; 4]]),
        &["not finite"],
    ),
    (
        "a rotation of no length",
        |d| values(d, "output", &[[0.0; 4], [0.0, 0.0, 0.0, 1.0]]),
        &["key 0 is a rotation of length 0"],
    ),
    (
        "values of another kind",
        |d| values(d, "output", &[[0.0; 3], [0.0; 3]]),
        &["rotations", "Vec3"],
    ),
    (
        "a spline without tangents",
        |d| {
            set(
                d,
                "/animations/0/samplers/0/interpolation",
                json!("CUBICSPLINE"),
            )
        },
        &["2 values for 2 keys"],
    ),
    (
        "no such interpolation",
        |d| set(d, "/animations/0/samplers/0/interpolation", json!("WAVY")),
        &["not in glTF"],
    ),
    (
        "no such property",
        |d| set(d, "/animations/0/channels/0/target/path", json!("color")),
        &["not in glTF"],
    ),
    (
        "no such node",
        |d| set(d, "/animations/0/channels/0/target/node", json!(9)),
        &["channel 0", "node 9, but there are only 3"],
    ),
    (
        "no such sampler",
        |d| set(d, "/animations/0/channels/0/sampler", json!(4)),
        &["sampler 4, but there are only 1"],
    ),
    (
        "no such accessor",
        |d| set(d, "/animations/0/samplers/0/input", json!(99)),
        &["accessor 99"],
    ),
    (
        "no node",
        |d| {
            d.json
                .pointer_mut("/animations/0/channels/0/target")
                .unwrap()
                .as_object_mut()
                .unwrap()
                .remove("node");
        },
        &["node"],
    ),
    (
        "no samplers",
        |d| {
            d.json["animations"][0]
                .as_object_mut()
                .unwrap()
                .remove("samplers");
        },
        &["samplers"],
    ),
    (
        "a channel twice",
        |d| {
            let channel = d.json.pointer(CHANNEL).unwrap().clone();
            d.json["animations"][0]["channels"]
                .as_array_mut()
                .unwrap()
                .push(channel);
        },
        &["channel 1", "node 2 a second time"],
    ),
    (
        "a matrix that shears",
        |d| {
            let shear = json!([1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1]);
            d.json["nodes"][2] = json!({"name": "tip", "matrix": shear});
        },
        &["node 2 has a matrix"],
    ),
    (
        "scales that overflow",
        |d| {
            let huge = d.floats(&[[f32::MAX; 3], [f32::MAX; 3]]);
            let mut parent = 2;
            for k in 0..9 {
                let child = d.push("nodes", json!({"name": format!("n{k}")}));
                d.json["nodes"][parent]["children"] = json!([child]);
                let channel = json!({"sampler": 1, "target": {"node": child, "path": "scale"}});
                d.json["animations"][0]["channels"]
                    .as_array_mut()
                    .unwrap()
                    .push(channel);
                parent = child;
            }
            let input = d.json.pointer(SAMPLER).unwrap()["input"].clone();
            let sampler = json!({"input": input, "output": huge});
            d.json["animations"][0]["samplers"]
                .as_array_mut()
                .unwrap()
                .push(sampler);
        },
        &["positions that are not finite"],
    ),
];

#[test]
fn a_broken_clip_goes_and_the_mesh_stays() {
    let whole = bending_bar();
    let fine = whole.load();
    assert!(fine.notes.is_empty(), "{:?}", fine.notes);
    for (fault, plant, words) in CLIPS {
        let mut document = whole.clone();
        plant(&mut document);
        let still = document.floats(&[[0.0, 0.0, 0.0]]);
        document.clip(1, "translation", "STEP", &[0.0], still);
        let loaded = document.load();
        let said = crate::common::text_of(&loaded.notes);
        let starts = loaded
            .notes
            .iter()
            .any(|n| n.to_string().contains(": left out clip `rotation`: "));
        assert!(starts, "{fault}: {said}");
        for word in *words {
            assert!(said.contains(word), "{fault}: no `{word}` in {said}");
        }
        let part = &loaded.parts[0];
        let names: Vec<_> = part.clips().iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["translation"], "{fault}");
        assert!(
            Topology::new(&part.at_time(0, 0.0).posed_mesh()).closed,
            "{fault}"
        );
    }
}

/// Faults that are mended: no clip is lost.
const MENDED: &[(Whole, Fault)] = &[
    (
        bending_bar,
        (
            "weights that sum to 2",
            |d| {
                let weights = d.floats(&[[1.0, 1.0, 0.0, 0.0]; 12]);
                d.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
            },
            &["bar: ", "weights of 12 vertices did not sum to 1"],
        ),
    ),
    (
        bending_bar,
        (
            "a weight that is none",
            |d| {
                let mut all = [[1.0, 0.0, 0.0, 0.0]; 12];
                all[3][1] = f32::NAN;
                all[4][1] = -0.5;
                let weights = d.floats(&all);
                d.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
            },
            &["bar: ", "weights of 2 vertices"],
        ),
    ),
    (
        bending_bar,
        (
            "weights of zero",
            |d| {
                let weights = d.floats(&[[0.0; 4]; 12]);
                d.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(weights);
            },
            &["12 vertices have no weight that is greater than zero"],
        ),
    ),
    (
        bending_bar,
        (
            "no weights",
            |d| {
                let attributes = &mut d.json["meshes"][0]["primitives"][0]["attributes"];
                attributes.as_object_mut().unwrap().remove("WEIGHTS_0");
            },
            &["ignored JOINTS_0", "12 vertices have no joint"],
        ),
    ),
    (
        bending_bar,
        (
            "too few inverse bind matrices",
            |d| {
                let one: [f32; 16] =
                    std::array::from_fn(|k| if k.is_multiple_of(5) { 1.0 } else { 0.0 });
                let inverse = d.floats(&[one]);
                d.json["skins"][0]["inverseBindMatrices"] = json!(inverse);
            },
            &[
                "shown without its skin, at its node: skin 0: it has 2 joints and 1 inverse bind matrices",
            ],
        ),
    ),
    (
        bending_bar,
        (
            "an inverse bind matrix that is none",
            |d| {
                let inverse = d.floats(&[[f32::NAN; 16]; 2]);
                d.json["skins"][0]["inverseBindMatrices"] = json!(inverse);
            },
            &["skin 0: inverse bind matrix 0 is not finite"],
        ),
    ),
    (
        bending_bar,
        (
            "an inverse bind matrix that flattens",
            |d| {
                let identity = |k: usize| if k.is_multiple_of(5) { 1.0 } else { 0.0 };
                let mut inverse: [[f32; 16]; 2] = [std::array::from_fn(identity); 2];
                inverse[1][5] = 0.0;
                let inverse = d.floats(&inverse);
                d.json["skins"][0]["inverseBindMatrices"] = json!(inverse);
            },
            &["skin 0: joint 1 is flat"],
        ),
    ),
    (
        bending_bar,
        (
            "a joint outside the scene",
            |d| {
                d.push("nodes", json!({"name": "away"}));
                d.json["skins"][0]["joints"] = json!([1, 3]);
            },
            &["skin 0: joint 3 is not in the scene"],
        ),
    ),
    (
        bending_bar,
        (
            "a skin that nothing hangs on",
            |d| {
                let attributes = &mut d.json["meshes"][0]["primitives"][0]["attributes"];
                attributes
                    .as_object_mut()
                    .unwrap()
                    .retain(|k, _| k == "POSITION");
            },
            &["skin 0: the mesh's vertices have no joints"],
        ),
    ),
    (
        bending_bar,
        (
            "a joint that vanishes",
            |d| {
                let scales = d.floats(&[[1.0; 3], [0.0; 3]]);
                d.clip(2, "scale", "LINEAR", &[0.0, 2.0], scales);
            },
            &["clip `scale` scales joint 1 of skin 0 to zero at 2 s"],
        ),
    ),
    (
        morphing_cube,
        (
            "more weights than targets",
            |d| {
                d.json["meshes"][0]["weights"] = json!([0, 0, 1]);
            },
            &["one: 3 weights for 2 morph targets"],
        ),
    ),
    (
        morphing_cube,
        (
            "fewer weights than targets",
            |d| {
                d.json["nodes"][0]["weights"] = json!([0.5]);
            },
            &["one: 1 weights for 2 morph targets"],
        ),
    ),
    (
        morphing_cube,
        (
            "a primitive without targets",
            |d| {
                let mut second = d.json["meshes"][0]["primitives"][0].clone();
                second.as_object_mut().unwrap().remove("targets");
                let all = d.json["meshes"][0]["primitives"].as_array_mut();
                all.unwrap().push(second);
            },
            &["one: its primitives differ in their number of morph targets"],
        ),
    ),
    (
        morphing_cube,
        (
            "a target that is too short",
            |d| {
                let short = d.floats(&[[1.0_f32; 3]; 7]);
                d.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(short);
            },
            &[
                "mesh 0, primitive 0: left out morph target 1",
                "7 positions for 8 vertices",
            ],
        ),
    ),
    (
        morphing_cube,
        (
            "a target that leads nowhere",
            |d| {
                let nowhere = d.floats(&[[f32::INFINITY; 3]; 8]);
                d.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = json!(nowhere);
            },
            &["left out morph target 0", "not finite"],
        ),
    ),
];

#[test]
fn what_can_be_mended_is_mended_and_said() {
    for (whole, (fault, plant, words)) in MENDED {
        let mut document = whole();
        assert!(document.load().notes.is_empty());
        let clips = document.load().parts[0].clips().len();
        plant(&mut document);
        let loaded = document.load();
        let said = crate::common::text_of(&loaded.notes);
        for word in *words {
            assert!(said.contains(word), "{fault}: no `{word}` in {said}");
        }
        let part = &loaded.parts[0];
        assert!(part.clips().len() >= clips, "{fault}");
        for time_s in [0.0, 0.5, 1.0, 2.0] {
            for clip in 0..part.clips().len() {
                let now = part.at_time(clip, time_s);
                assert_eq!(now.posed_mesh().defect(), None, "{fault} at {time_s} s");
                assert!(
                    Topology::new(&now.posed_mesh()).closed,
                    "{fault} at {time_s} s"
                );
            }
        }
    }
}

/// Faults of what the still picture needs.
const REFUSED: &[(Whole, Fault)] = &[
    (
        bending_bar,
        (
            "a joint beyond the skin",
            |d| {
                let joints = d.accessor(&[[0_u8, 7, 0, 0]; 12].concat(), 5121, "VEC4", 12);
                d.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = json!(joints);
            },
            &[
                "mesh 0, primitive 0",
                "follows joint 7, but its skin has only 2",
            ],
        ),
    ),
    (
        bending_bar,
        (
            "too few joints",
            |d| {
                let joints = d.accessor(&[[0_u8; 4]; 11].concat(), 5121, "VEC4", 11);
                d.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = json!(joints);
            },
            &["JOINTS_0 has 11 items for 12 vertices"],
        ),
    ),
    (
        bending_bar,
        ("no such skin", |d| set(d, "/nodes/0/skin", json!(3)), &[]),
    ),
    (
        bending_bar,
        (
            "no such joint",
            |d| set(d, "/skins/0/joints", json!([1, 30])),
            &[],
        ),
    ),
    (
        bending_bar,
        (
            "a skin that leads nowhere",
            |d| {
                let mut parent = 2;
                for _ in 0..8 {
                    let child = d.push("nodes", json!({"scale": [1e38, 1e38, 1e38]}));
                    d.json["nodes"][parent]["children"] = json!([child]);
                    parent = child;
                }
                let inverse = d.floats(&[[1e38; 16]; 2]);
                d.json["skins"][0] = json!({"joints": [1, parent], "inverseBindMatrices": inverse});
            },
            &["bar: it is moved to positions that are not finite"],
        ),
    ),
    (
        morphing_cube,
        (
            "a target beyond its buffer",
            |d| {
                let target = d.floats(&[[1.0_f32; 3]; 8]);
                d.json["accessors"][target]["count"] = json!(9);
                d.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(target);
            },
            &["mesh 0, primitive 0: morph target 1: accessor"],
        ),
    ),
    (
        morphing_cube,
        (
            "no such target",
            |d| set(d, "/meshes/0/primitives/0/targets/0/POSITION", json!(77)),
            &[],
        ),
    ),
];

#[test]
fn what_the_mesh_needs_is_refused() {
    for (whole, (fault, plant, words)) in REFUSED {
        let mut document = whole();
        plant(&mut document);
        let said = match document.try_load() {
            Ok(loaded) => panic!("{fault} loads: {:?}", loaded.notes),
            Err(e) => e.to_string(),
        };
        assert!(
            said.contains("motion.gltf") && said.contains("help:"),
            "{said}"
        );
        for word in *words {
            assert!(said.contains(word), "{fault}: no `{word}` in {said}");
        }
    }
}

/// A cube whose corners are stored once per face, as exporters do for normals, so that it has to be welded.
fn split_cube(lift: impl Fn(usize, [f32; 3]) -> [f32; 3]) -> Document {
    let mut document = cube_document();
    let (positions, triangles) = super::document::cube();
    let corners: Vec<[f32; 3]> = triangles
        .iter()
        .flatten()
        .map(|i| positions[*i as usize])
        .collect();
    let lifts: Vec<[f32; 3]> = corners
        .iter()
        .enumerate()
        .map(|(k, p)| lift(k, *p))
        .collect();
    let (at, by) = (document.floats(&corners), document.floats(&lifts));
    document.json["meshes"][0]["primitives"][0] =
        json!({"attributes": {"POSITION": at}, "targets": [{"POSITION": by}]});
    let weights = document.floats(&[[0.0], [1.0]]);
    document.clip(0, "weights", "LINEAR", &[0.0, 1.0], weights);
    document
}

#[test]
fn what_is_welded_moves_as_one() {
    let together = split_cube(|_, [_, y, _]| [0.0, y, 0.0]).load();
    let said = crate::common::text_of(&together.notes);
    assert!(
        said.contains("welded 36 corners to 8 vertices") && !said.contains("otherwise"),
        "{said}"
    );
    let lifted = together.parts[0].at_time(0, 1.0).posed_mesh().volume();
    assert!((lifted - 2.0).abs() < 1e-6, "{lifted}");

    // One corner of one triangle goes its own way.
    let apart = split_cube(|k, [_, y, _]| if k == 35 { [9.0; 3] } else { [0.0, y, 0.0] }).load();
    let said = crate::common::text_of(&apart.notes);
    assert!(
        said.contains("1 vertices move differently from the vertices they were welded to"),
        "{said}"
    );
    let now = apart.parts[0].at_time(0, 1.0);
    assert!(Topology::new(&now.posed_mesh()).closed);
    assert!((now.posed_mesh().volume() - 2.0).abs() < 1e-6);
}

#[test]
fn no_changed_byte_crashes() {
    let folder = Scratch::new("mesh");
    for document in [bending_bar(), morphing_cube()] {
        let whole = document.text().into_bytes();
        for at in (0..whole.len()).step_by(5) {
            for new in *b"09-\"" {
                let mut changed = whole.clone();
                changed[at] = new;
                let path = folder.write("changed.gltf", &changed);
                // Many changes leave a motion, if another one; what matters is that this returns.
                let Ok(loaded) = load_mesh_file(&path) else {
                    continue;
                };
                for part in &loaded.parts {
                    for clip in 0..part.clips().len() {
                        let now = part.at_time(clip, 0.5 * part.clips()[clip].duration_s);
                        let _ = (now.posed_mesh(), now.posed_bounds());
                    }
                }
            }
        }
    }
}
