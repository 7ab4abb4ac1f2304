//! Cutters over time, from a scene file to the frame.

use cutaway::Model;
use cutaway::layers::{Kind, Layers};
use cutaway::plan::Clock;
use cutaway::scene::Scene;
use cutaway::session::Session;

use super::command::Scratch;
use super::common::{Question, gpu, strategy};

const BITTEN: &str = r#"
resolution = [128, 96]
[camera]
azimuth_deg = 35
elevation_deg = 40
[[part]]
name = "crank"
shape = "crank?throws=2&detail=16"
[[cut]]
name = "ball"
volume = "shape:sphere?subdivisions=3"
scale = 0.6
translate = [0, 0, 0]
[[cut]]
name = "still"
volume = "shape:torus?segments=24&sides=12"
pivot = "centre"
translate = [0.3, 0.4, 0.4]
rotate_deg = [90, 0, 0]
[[key]]
target = "cut.ball.translate"
times_s = [0, 1]
values = [[-0.9, 0.1, 0.2], [0.9, 0.1, 0.2]]
[[key]]
target = "cut.ball.scale"
times_s = [0, 1]
values = [0.4, 0.7]
"#;

fn times() -> impl Iterator<Item = f64> {
    (0..10).map(|i| f64::from(i) / 9.0)
}

/// The scene at some times.
fn scenes_over_time() -> Vec<Scene> {
    let folder = Scratch::new("moving-cutter");
    let file = folder.timeline(BITTEN);
    times().map(|t| file.at(t).expect("a time")).collect()
}

#[test]
fn a_moving_cutter_is_exact_at_every_time() {
    let mut model: Option<Model> = None;
    let mut found = Vec::new();
    let mut pictures: Vec<Layers> = Vec::new();
    for (scene, time) in scenes_over_time().iter().zip(times()) {
        let next = (model.as_ref()).map_or_else(|| Model::new(scene), |m| m.updated(scene));
        model = Some(next.clone());
        let question = Question::of_model(next, scene, [128, 96]);
        assert!(
            question.exact.layers.count(Kind::Cap) > 40,
            "caps at {time}"
        );
        for name in ["raycast+mask", "raycast+abuffer", "grid:64+mask"] {
            let judged = question.answer(strategy(name));
            found.extend(
                judged
                    .fault_of_exact()
                    .map(|f| format!("{name} at {time}: {f}")),
            );
            if name == "raycast+mask" {
                pictures.push(judged.layers);
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    pictures.dedup();
    assert_eq!(pictures.len(), 10, "it moves");
}

#[test]
fn the_clock_of_solids_stands_still() {
    let mut session = Session::new(gpu());
    let strategy = strategy("raycast+mask");
    let mut model: Option<Model> = None;
    for (number, scene) in scenes_over_time().iter().enumerate() {
        let next = (model.as_ref()).map_or_else(|| Model::new(scene), |m| m.updated(scene));
        let view = next.prepared.view([64, 48]);
        let drawn = session.draw(&next, &view, strategy).expect("a frame");
        let ran = drawn.ran_on(Clock::Solid).len();
        assert!(
            number == 0 || ran == 0,
            "{ran} passes of the solid clock at frame {number}"
        );
        model = Some(next);
    }
}
