//! Winding numbers beside the strategies: in the JSON as any of them, and the whole mesh as the truth about a broken one.

use cutaway::generate::defects::break_parts;
use cutaway::scene::Scene;
use cutaway::strategies::DrawOptions;
use cutaway_io::document::parse_defect;
use cutaway_lab::experiment::{FrameQuestion, Renderer, SceneAtTime, errors, times};

use crate::common::{scenes, session};
use crate::exactness::winding::command::Scratch;

#[test]
fn winding_is_listed_as_any_other() {
    let folder = Scratch::new("winding-json");
    let ran = folder
        .run("compare shape:sphere?subdivisions=3 --section=-z=50% --strategies raycast+mask,winding --rounds 2 --resolution 64,48 --heatmaps wrong --json -")
        .exits(0);
    let found = &ran.json()["strategies"][1];
    assert_eq!(found["name"], "winding");
    assert_eq!(found["outcome"], "complete");
    assert_eq!(found["decided_wrong_px"], 0);
    assert_eq!(
        found["time_ms"]["frame"]["samples"]
            .as_array()
            .unwrap()
            .len(),
        2
    );
    assert!(found["time_ms"]["solid"]["median"].as_f64().unwrap() > 0.0);
    assert!(found["bytes"]["solid"].as_u64().unwrap() > 1000);
    let passes = found["passes"].as_array().unwrap();
    let names: Vec<&str> = passes.iter().map(|p| p["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["winding: tree (CPU)", "winding (CPU)"]);
    for file in ["wrong/winding.png", "wrong/winding.heatmap.png"] {
        assert!(folder.path(file).is_file(), "{file}");
    }
    let ran = folder
        .run("compare shape:cube --strategies windings")
        .exits(2);
    assert!(!ran.stderr.is_empty());
}

/// Wrong pixels of renderers, marked and unmarked, by the truth of another scene.
fn judged(scene: &Scene, truth: Option<&Scene>, renderers: &[&str]) -> Vec<[usize; 2]> {
    let (shown, truth) = (SceneAtTime::new(scene), truth.map(SceneAtTime::new));
    let question = FrameQuestion {
        name: "sphere".to_owned(),
        shown: &shown,
        view: shown.model.prepared.view([128, 96]),
        truth: truth.as_ref(),
        options: DrawOptions::default(),
        command: String::new(),
    };
    let renderers: Vec<Renderer> = renderers.iter().map(|c| c.parse().unwrap()).collect();
    let mut session = session();
    let quiet = &mut |_: String| ();
    let mut judgement = errors(&mut session, &question, &renderers, quiet).unwrap();
    let is_timed = times(&mut session, &question, &mut judgement, 1, quiet, &|| true);
    assert!(is_timed.unwrap(), "times are taken");
    let found = judgement.measurement.strategies.iter();
    found
        .map(|s| {
            let c = s.comparison.as_ref().unwrap();
            [c.decided_wrong_px, c.unmarked_wrong_px]
        })
        .collect()
}

#[test]
fn a_broken_mesh_is_judged_by_the_whole_one() {
    let whole = scenes::sectioned("sphere?subdivisions=4", &["-z=50%"]);
    let renderers = ["raycast+mask", "winding"];
    let of_whole = judged(&whole, Some(&whole), &renderers);
    assert_eq!(of_whole, [[0, 0], [0, 0]], "nothing is broken");
    let mut broken = whole.clone();
    let holes = parse_defect("holes:amount=5%").unwrap();
    break_parts(&mut broken.parts, &[holes]).unwrap();
    let own = judged(&broken, None, &renderers)[0];
    let by_whole = judged(&broken, Some(&whole), &renderers);
    println!("mask by its own scene {own:?}; mask and winding by the whole {by_whole:?}");
    let [mask, winding] = [by_whole[0], by_whole[1]];
    assert!(mask[0] > own[0], "what is missing is missed");
    assert!(4 * mask[1] < mask[0], "most of it is marked");
    assert!(winding[0] < mask[0] / 2, "winding numbers miss less");
}

#[test]
fn a_truth_in_another_frame_is_refused() {
    let whole = scenes::sectioned("sphere?subdivisions=2", &["-z=50%"]);
    let larger = scenes::sectioned("sphere?subdivisions=2&radius=3", &["-z=50%"]);
    let (shown, truth) = (SceneAtTime::new(&whole), SceneAtTime::new(&larger));
    let question = FrameQuestion {
        name: "small".to_owned(),
        shown: &shown,
        view: shown.model.prepared.view([32, 24]),
        truth: Some(&truth),
        options: DrawOptions::default(),
        command: String::new(),
    };
    let message = errors(&mut session(), &question, &[], &mut |_| ());
    let message = message.err().unwrap().to_string();
    assert!(
        message.contains("bounds differ") && message.contains("help"),
        "{message}"
    );
}
