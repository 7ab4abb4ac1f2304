//! Lanes that are marked by slabs lead to the same layers as full lists of crossings, in one frame after another.

use std::sync::Arc;

use cutaway::scene::{Camera, Cut, Scene};
use glam::DVec3;
use image::{GrayImage, Luma};

use super::full_lists::{compare, layers_are_those_of_full_lists, passes};
use crate::common::command::Scratch;
use crate::common::numbers::Numbers;
use crate::common::scenes;

const WAVES: &str = "waves:size=32,amplitude=6%";
const CRACKS: &str = "cracks:size=64,amplitude=8%";

/// A shape with one cut for each list of sections with reliefs, and one for each plane.
pub(super) fn cut(shape: &str, cuts: &[&[[&str; 2]]], planes: &[&str]) -> Scene {
    let mut scene = scenes::sectioned(shape, planes);
    let planes = std::mem::take(&mut scene.cuts)
        .into_iter()
        .flat_map(|cut| cut.surfaces);
    let of_planes: Vec<Cut> = planes.map(|plane| Cut::new("plane", vec![plane])).collect();
    let of_reliefs = cuts.iter().map(|sections| {
        let surface = |[section, relief]: &[&str; 2]| scenes::relief(&scene, section, relief);
        Cut::new("cut", sections.iter().map(surface).collect())
    });
    let cuts = of_reliefs.chain(of_planes).collect();
    Scene { cuts, ..scene }
}

/// A shape that is cut by a relief alone.
fn scene_of(shape: &str, section: &str, relief: &str) -> Scene {
    cut(shape, &[&[[section, relief]]], &[])
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
        // A corner between two reliefs, and a slice beside each of two.
        cut("torus", &[&[["-z=50%", WAVES], ["x=50%", CRACKS]]], &[]),
        cut(
            "crank?throws=2&detail=16",
            &[&[["x=30%", CRACKS]], &[["-z=55%", WAVES]]],
            &[],
        ),
        // Slabs that meet along their whole length, and planes among reliefs.
        cut(
            "sponge?level=2",
            &[
                &[["x=50%", WAVES]],
                &[["x=51%", CRACKS]],
                &[["y=40%", WAVES]],
            ],
            &[],
        ),
        cut(
            "comb?teeth=8",
            &[&[["-x=70%", CRACKS]], &[["y=45%", WAVES]]],
            &["x=20%", "-z=80%", "z=10%"],
        ),
    ];
    layers_are_those_of_full_lists(&scenes, &["", ",32-bit", ",pyramid"], |passes| {
        passes.iter().any(|name| name == "settle")
    });
}

/// A walk that may end early ended in the cell in which the ray had entered the kept side and left it again. Of two slabs that a ray rises
/// through slowly, the first then ended on its removed side, and the cap in the second was missing.
#[test]
fn a_walk_that_ends_early_ends_on_the_right_side() {
    let folder = Scratch::new("noise");
    let mut numbers = Numbers(7);
    let noise = GrayImage::from_fn(32, 32, |_, _| Luma([numbers.below(256) as u8]));
    let file = folder.path("noise.png");
    noise.save(&file).expect("a picture");
    let relief = format!("{}:amplitude=3%", file.display());
    let [near, far] = ["30%", "60%"].map(|at| format!("-0.4,1,0.2@{at},{at},{at}"));
    let scene = cut("cube", &[&[[&near, &relief]], &[[&far, &relief]]], &[]);
    let cameras = [90.0, 100.0].map(|azimuth| scenes::orbit(azimuth, -5.0, false));
    let differ = compare(&scene, "", &cameras, [300, 225]);
    assert_eq!(differ, cameras.len(), "the control");
}

/// A ray that leaves what is kept through a bumpy relief may enter a bump on its way, which is seen if nothing is drawn where the ray came
/// into the solid: without a cap of the near plane.
#[test]
fn bumps_are_seen_from_within_without_a_near_cap() {
    let waves = "waves:amplitude=8%,period=20%";
    let mut scene = scene_of("cube", "y=40%", waves);
    let within = scenes::looking(
        DVec3::new(-0.45, 0.2, 0.03),
        DVec3::new(0.4, -0.15, 0.1),
        50.0,
    );
    let cameras = [false, true].map(|near_cap| Camera {
        near_cap,
        near: Some(0.02),
        ..within
    });
    assert_eq!(compare(&scene, "", &cameras, [200, 150]), 2, "the control");
    // Faces that are turned inside out are not drawn from the front either.
    let mesh = Arc::make_mut(&mut scene.parts[0].mesh);
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let outside = Camera {
        near_cap: false,
        ..scenes::orbit(35.0, 20.0, false)
    };
    assert_eq!(compare(&scene, "", &[outside], [200, 150]), 1);
}

#[test]
fn lanes_are_marked_by_slabs_where_that_pays() {
    let settles = |scene: &Scene| passes(scene, "").iter().any(|name| name == "settle");
    let relief = "fractal:size=64,amplitude=5%";
    let one = scene_of("torus", "-z=50%", relief);
    assert!(settles(&one));
    let two = cut(
        "torus",
        &[&[["-z=50%", relief]], &[["x=60%", relief]]],
        &["y=20%"],
    );
    assert!(settles(&two));
    let thick = scene_of("torus", "-z=50%", "fractal:size=64,amplitude=90%");
    assert!(!settles(&thick), "most of the solid is within the slab");
    assert!(
        !settles(&scenes::sectioned("torus", &["-z=50%"])),
        "a plane"
    );
}
