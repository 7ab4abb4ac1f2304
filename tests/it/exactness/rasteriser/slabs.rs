//! Lanes that are marked by the slab of a relief lead to the same layers as full lists of crossings, in one frame after another.

use cutaway::scene::{Cut, Scene};

use super::full_lists::{layers_are_those_of_full_lists, passes};
use crate::common::scenes;

/// A shape that is cut by a relief alone.
fn scene_of(shape: &str, section: &str, relief: &str) -> Scene {
    let mut scene = scenes::sectioned(shape, &[]);
    let surface = scenes::relief(&scene, section, relief);
    scene.cuts = vec![Cut::new("cut", vec![surface])];
    scene
}

#[test]
fn slabs_leave_the_layers_of_full_lists() {
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
    layers_are_those_of_full_lists(&scenes, &["", ",32-bit", ",pyramid"], |passes| {
        passes.iter().any(|name| name == "settle")
    });
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
