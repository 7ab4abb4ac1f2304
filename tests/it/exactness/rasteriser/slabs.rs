//! Lanes that are marked by the slab of a relief lead to the same layers as full lists of crossings, in one frame after another.

use cutaway::passes::Model;
use cutaway::plan::Capacities;
use cutaway::scene::{Camera, Cut, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{self, Method};
use glam::DVec3;

use crate::common::{gpu, scenes};

const SIZE_PX: [u32; 2] = [96, 72];

/// A shape that is cut by a relief alone.
fn scene_of(shape: &str, section: &str, relief: &str) -> Scene {
    let mut scene = scenes::sectioned(shape, &[]);
    let surface = scenes::relief(&scene, section, relief);
    scene.cuts = vec![Cut::new("cut", vec![surface])];
    scene
}

fn cameras() -> [Camera; 5] {
    [
        scenes::looking(DVec3::new(1.5, -2.0, 3.0), DVec3::ZERO, 40.0),
        scenes::looking(DVec3::new(-4.0, 3.0, -6.0), DVec3::new(0.8, 0.3, 0.0), 40.0),
        // Along the plane, and from inside of the slab.
        scenes::looking(DVec3::new(5.0, 0.3, 0.1), DVec3::ZERO, 30.0),
        scenes::looking(DVec3::new(0.2, 0.1, 0.05), DVec3::X, 70.0),
        scenes::parallel(DVec3::new(2.0, 3.0, 4.0), DVec3::ZERO, 3.0),
    ]
}

fn method(options: &str) -> Method {
    let name = format!("raycast+mask@compute{options}");
    name.parse().unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn passes(scene: &Scene, options: &str) -> Vec<String> {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE_PX);
    let plan = strategies::plan(&model, &view, method(options), &Capacities::UNKNOWN);
    let plan = plan.unwrap_or_else(|e| panic!("{e}"));
    plan.passes.iter().map(|p| p.name.clone()).collect()
}

#[test]
fn layers_are_those_of_full_lists() {
    let scenes = [
        scene_of("torus", "-z=50%", "fractal:size=64,amplitude=8%"),
        scene_of(
            "crank?throws=2&detail=16",
            "-z=50%",
            "waves:size=32,amplitude=6%",
        ),
        scene_of(
            "comb?teeth=8",
            "-1,-2,-1.5@50%,45%,60%",
            "cracks:size=64,amplitude=10%",
        ),
        scene_of("sponge?level=2", "-x=52%", "fractal:size=256,amplitude=6%"),
    ];
    let mut differ = 0;
    for (number, scene) in scenes.iter().enumerate() {
        let model = Model::new(scene);
        for options in ["", ",32-bit", ",pyramid"] {
            let is_listed = |name: &String| name == "settle";
            assert!(passes(scene, options).iter().any(is_listed), "{number}");
            let full = format!("{options},list");
            assert!(!passes(scene, &full).iter().any(is_listed), "the control");
            // One session each: what a frame leaves must not reach the next.
            let mut sessions = [Session::new(gpu()), Session::new(gpu())];
            let mut before = Vec::new();
            for (turn, camera) in cameras().iter().enumerate() {
                let view = model.prepared.view_of(camera, SIZE_PX);
                let layers = |session: &mut Session, options: &str| {
                    let drawn = session.draw(&model, &view, method(options));
                    let drawn = drawn.unwrap_or_else(|e| panic!("{number}{options}: {e}"));
                    assert_eq!(drawn.outcome, Outcome::Complete, "{number}{options}");
                    let words = session.words(method(options), "layers");
                    words.unwrap_or_else(|e| panic!("{number}{options}: {e}"))
                };
                let [by_slab, by_lists] = &mut sessions;
                let found = layers(by_slab, options);
                let expected = layers(by_lists, &full);
                assert!(found == expected, "scene {number}{options}, view {turn}");
                differ += usize::from(found != before);
                before = found;
            }
        }
    }
    assert_eq!(
        differ,
        scenes.len() * 3 * cameras().len(),
        "the control: views differ"
    );
}

#[test]
fn lanes_are_marked_by_slabs_where_that_pays() {
    let settles = |scene: &Scene| passes(scene, "").iter().any(|name| name == "settle");
    let relief = "fractal:size=64,amplitude=5%";
    let one = scene_of("torus", "-z=50%", relief);
    assert!(settles(&one));
    let mut two = one.clone();
    let surface = scenes::relief(&two, "x=60%", relief);
    two.cuts.push(Cut::new("other", vec![surface]));
    assert!(!settles(&two), "two reliefs");
    let thick = scene_of("torus", "-z=50%", "fractal:size=64,amplitude=90%");
    assert!(!settles(&thick), "most of the solid is within the slab");
    assert!(
        !settles(&scenes::sectioned("torus", &["-z=50%"])),
        "a plane"
    );
}
