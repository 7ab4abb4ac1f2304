//! Crossings with a few planes are recomputed by each pass, and lead to the same layers as lists of them.

use cutaway::scene::Scene;

use super::full_lists::{layers_are_those_of_full_lists, passes};
use super::slabs::cut;
use crate::common::scenes;

fn lists_nothing(passes: &[String]) -> bool {
    !passes.iter().any(|name| name == "crossings")
}

/// Shapes that are cut by planes; a plane that is there twice crosses rays at equal depths.
fn scenes() -> Vec<Scene> {
    let corners = [
        scenes::sectioned("torus", &["-z=50%", "x=50%"]),
        scenes::sectioned(
            "gears",
            &[
                "x=60%", "x=65%", "x=70%", "-x=20%", "-x=25%", "y=80%", "-y=20%", "z=60%",
            ],
        ),
        scenes::sectioned(
            "comb?teeth=8",
            &["-1,-2,-1.5@50%,45%,60%", "-1,-2,-1.5@50%,45%,60%", "-z=50%"],
        ),
    ];
    let slices = [
        cut(
            "crank?throws=2&detail=16",
            &[],
            &["x=50%", "y=50%", "z=60%", "-x=80%"],
        ),
        cut(
            "sponge?level=2",
            &[],
            &["x=30%", "-x=70%", "-x=70%", "x=30%", "z=50%"],
        ),
        cut("cube", &[], &["x=50%", "x=50%"]),
    ];
    corners.into_iter().chain(slices).collect()
}

#[test]
fn recomputed_crossings_leave_the_layers_of_full_lists() {
    layers_are_those_of_full_lists(&scenes(), &["", ",32-bit"], lists_nothing);
}

#[test]
fn few_planes_are_not_listed() {
    let sections: Vec<String> = (1..10).map(|i| format!("-z={}%", 10 * i)).collect();
    let sections: Vec<&str> = sections.iter().map(String::as_str).collect();
    let lists_few = |count: usize| {
        let scene = scenes::sectioned("torus", &sections[..count]);
        lists_nothing(&passes(&scene, ""))
    };
    assert_eq!([1, 2, 8, 9].map(lists_few), [true, true, true, false]);
}
