//! Layered depth images and sprites: the same answers, but where depths tie, and no limit to layers (hard cases 19 and 36).

use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Camera, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::Rasteriser;

use super::{SIZE, drawn, layers, ring, row};
use crate::common::{Question, class_of, meshes, scenes, strategy};

const HARDWARE: Rasteriser = Rasteriser::Hardware;

fn plates(teeth: u32) -> Scene {
    scenes::sectioned(
        &format!("comb?teeth={teeth}&length=0.9"),
        &["-0.2,-1,-0.1@50%,40%,50%"],
    )
}

fn differing(a: &Layers, b: &Layers) -> usize {
    a.pixels
        .iter()
        .zip(&b.pixels)
        .filter(|(a, b)| a != b)
        .count()
}

#[test]
fn images_answer_as_sprites_do() {
    let mut coarse_differ = 0;
    for (name, scene) in [("ring", ring()), ("row", row()), ("plates", plates(8))] {
        let question = Question::new(&scene, SIZE);
        for surface in ["raycast", "grid:16"] {
            let [ldi, vds, coarse] = ["ldi:128", "vds:128", "ldi:32"].map(|inside| {
                layers(
                    &question,
                    &strategy(&format!("{surface}+{inside}")),
                    HARDWARE,
                )
            });
            let caps = ldi.count(Kind::Cap);
            assert!(caps > 100, "{name}, {surface}: only {caps} cap pixels");
            assert_eq!(differing(&ldi, &vds), 0, "{name}, {surface}");
            coarse_differ += differing(&ldi, &coarse);
        }
    }
    // The control: a coarser image is another.
    assert!(coarse_differ > 20, "any image would do: {coarse_differ}");
}

#[test]
fn images_by_either_rasteriser_hardly_differ() {
    for (name, scene) in [("ring", ring()), ("row", row())] {
        let question = Question::new(&scene, SIZE);
        let both = [HARDWARE, Rasteriser::Compute];
        // Depths of the two differ in their last places, so a pixel on a rim may go either way.
        let [hardware, compute] = both.map(|r| layers(&question, &strategy("raycast+ldi:256"), r));
        let kinds = hardware.pixels.iter().zip(&compute.pixels);
        let differ = kinds.filter(|(a, b)| class_of(a) != class_of(b)).count();
        assert!(differ * 200 < hardware.count(Kind::Cap), "{name}: {differ}");
        let judged = question.compare(&compute);
        assert!(
            judged.interior_wrong_px * 100 < hardware.count(Kind::Cap),
            "{name}"
        );
    }
}

#[test]
fn rays_with_images_err_along_rims_alone() {
    let mut wrong = [0; 2];
    for (name, scene) in [("ring", ring()), ("row", row())] {
        let question = Question::new(&scene, SIZE);
        for (wrong, inside) in wrong.iter_mut().zip(["ldi:64", "ldi:512"]) {
            let judged = question.answer(strategy(&format!("raycast+{inside}")));
            *wrong += judged.comparison.decided_wrong_px;
            let interior = judged.comparison.interior_wrong_px;
            assert!(
                interior <= *wrong / 4,
                "{name}, {inside}: {interior} of {wrong}"
            );
        }
    }
    assert!(wrong[1] * 2 < wrong[0], "{wrong:?}");
}

#[test]
fn the_near_plane_is_capped_by_asking_where_rays_begin() {
    let mut scene = scenes::sectioned("cube", &["-1,-0.3,-0.2@60%,50%,50%"]);
    let (centre, radius) = (scene.bounds().centre(), scene.bounds().radius());
    let from = centre + glam::DVec3::new(0.7, 0.9, 2.0).normalize() * radius * 3.0;
    scene.camera = Camera {
        near: Some(radius * 2.85),
        ..scenes::looking(from, centre, 40.0)
    };
    let question = Question::new(&scene, SIZE);
    let judged = question.answer(strategy("raycast+ldi:512"));
    let near = |l: &Layers| {
        let caps = l.pixels.iter().filter(|p| p.kind == Kind::Cap);
        caps.filter(|p| p.clip_surface == cutaway::layers::NEAR_PLANE)
            .count()
    };
    assert!(near(&judged.exact.layers) > 100, "the near plane shows");
    let wrong = judged.comparison.decided_wrong_px;
    assert!(wrong * 50 < near(&judged.exact.layers), "{wrong} wrong");
}

#[test]
fn case_19_faces_that_lie_in_one_another_are_kept_apart_by_lists_alone() {
    let cube = meshes::shape("cube");
    let twice = meshes::joined(&[cube.clone(), cube]);
    let plane =
        cutaway::scene::ClipSurface::plane(glam::DVec3::ZERO, glam::DVec3::new(-0.3, -0.5, -1.0));
    let question = Question::new(&scenes::scene("twice", twice, vec![plane]), SIZE);
    assert_eq!(
        question.exact.layers.count(Kind::Cap),
        0,
        "by parity nothing is inside"
    );
    for name in ["raycast+abuffer", "raycast+kbuffer:8"] {
        let judged = question.answer(strategy(name));
        assert_eq!(judged.fault_of_exact(), None, "{name}");
    }
    let caps = |name: &str| layers(&question, &strategy(name), HARDWARE).count(Kind::Cap);
    assert_eq!(caps("raycast+ldi:256"), 0, "lists keep both");
    assert!(
        caps("raycast+vds:256") > 100,
        "peeling is declared to lose one of two"
    );
}

#[test]
fn case_36_lists_hold_what_a_sprite_has_no_layers_for() {
    let question = Question::new(&plates(200), SIZE);
    for (name, is_complete) in [("raycast+ldi:128", true), ("raycast+vds:128", false)] {
        drawn(&question, &strategy(name), HARDWARE, |_, outcome| {
            assert_eq!(
                *outcome == Outcome::Complete,
                is_complete,
                "{name}: {outcome:?}"
            );
        });
    }
}
