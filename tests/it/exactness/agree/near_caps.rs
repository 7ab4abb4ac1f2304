//! Near planes in solids: with a cap there, and without one, where what the ray enters next is seen.

use cutaway::layers::{Kind, NEAR_PLANE};
use cutaway::scene::{Camera, Scene};
use cutaway::strategies::Method;
use cutaway_lab::hard_cases::{Judged, Question};
use glam::DVec3;

use crate::common::shares::{Share, in_shares};
use crate::common::{scenes, session};

/// Strategies that are exact for planes, by both rasterisers where both know them.
const EXACT: [&str; 9] = [
    "raycast+mask",
    "raycast+mask@compute",
    "raycast+stencil",
    "raycast+abuffer",
    "raycast+abuffer@compute",
    "raycast+kbuffer:16",
    "raycast+kbuffer:16@compute",
    "grid:16+mask",
    "adaptive:0.5+mask@compute",
];

/// Solids with the eye inside, and with a near plane through them from outside.
fn scenes_of(near_cap: bool) -> Vec<(String, Scene)> {
    let mut all = Vec::new();
    for (shape, inside) in [
        ("cube", DVec3::new(0.05, -0.1, 0.1)),
        // In the web between the two journals.
        ("crank", DVec3::ZERO),
    ] {
        let mut scene = scenes::sectioned(shape, &["-1,-0.3,-0.2@60%,50%,50%"]);
        let bounds = scene.bounds();
        let eye = bounds.centre() + inside;
        let out = DVec3::new(0.7, 0.9, 2.0).normalize();
        let from = bounds.centre() + out * bounds.radius() * 3.0;
        for (name, camera, near) in [
            ("inside", scenes::looking(eye, eye + DVec3::X, 70.0), 0.02),
            ("inside, away", scenes::looking(eye, eye - out, 70.0), 0.02),
            (
                "across",
                scenes::looking(from, bounds.centre(), 40.0),
                bounds.radius() * 2.9,
            ),
            (
                "parallel",
                scenes::parallel(from, bounds.centre(), bounds.radius() * 2.0),
                bounds.radius() * 2.9,
            ),
        ] {
            scene.camera = Camera {
                near: Some(near),
                near_cap,
                ..camera
            };
            all.push((format!("{shape}, {name}"), scene.clone()));
        }
    }
    all
}

fn question(scene: &Scene) -> Question {
    Question::new(scene, [96, 80])
}

fn answer(question: &Question, name: &str) -> Judged {
    let method = name.parse::<Method>().unwrap_or_else(|_| panic!("{name}"));
    let judged = question.answer(&mut session(), &method);
    judged.unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn near_caps(judged: &cutaway::layers::Layers) -> usize {
    let pixels = judged.pixels.iter();
    let is_near = |p: &&cutaway::layers::Layer| p.kind == Kind::Cap && p.clip_surface == NEAR_PLANE;
    pixels.filter(is_near).count()
}

in_shares!(with_and_without_a_near_cap_all_show_what_exact_shows, 2);

fn with_and_without_a_near_cap_all_show_what_exact_shows(share: Share) {
    for near_cap in share.part([true, false]) {
        let (mut met, mut beyond) = (0, 0);
        for (scene_name, scene) in scenes_of(near_cap) {
            let question = question(&scene);
            met += near_caps(&question.exact.layers);
            let pixels = question.exact.layers.pixels.iter();
            assert!(!pixels.clone().any(|p| p.back_face), "{scene_name}: a back");
            beyond += pixels.filter(|p| p.kind != Kind::Background).count();
            for name in EXACT {
                let judged = answer(&question, name);
                let what = format!("{scene_name}, near cap {near_cap}, {name}");
                assert_eq!(judged.fault_of_exact(), None, "{what}");
            }
        }
        assert_eq!(met > 1000, near_cap, "{met} px of near caps");
        assert!(beyond > 1000, "{beyond} px are seen at all");
    }
}

#[test]
fn the_papers_rule_caps_the_near_plane_as_finely_as_its_images_are() {
    for (scene_name, scene) in scenes_of(true) {
        let question = question(&scene);
        let expected = near_caps(&question.exact.layers);
        for name in ["grid:64+vds:256", "grid:64+ldi:256", "adaptive:1+vds:256"] {
            let what = format!("{scene_name}, {name}");
            let judged = answer(&question, name);
            let found = near_caps(&judged.layers);
            assert!(
                found.abs_diff(expected) <= expected / 20 + 20,
                "{what}: {found} px of {expected}"
            );
            let wrong = judged.comparison.decided_wrong_px;
            let covered = question.exact.covered_px();
            assert!(
                wrong <= covered / 20 + 20,
                "{what}: {wrong} px of {covered}"
            );
        }
    }
}
