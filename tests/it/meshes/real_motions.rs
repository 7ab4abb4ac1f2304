//! Promise: on animated meshes that others made, every exact strategy is exact at every time.
//!
//! The meshes are not part of the repository (see `real_meshes.rs`); where they are not, the tests say so and pass. A model is cut
//! by an oblique plane through the middle of its stage at ten times spread over each of its clips: strategies pose it on the
//! device in f32, the reference is posed on the CPU in f64. Of each model the parts that are closed at rest are kept; where a
//! file has none, there is nothing to check. Gears have no clip of their own: the scene turns them by keys.

use crate::common;

use common::Question;
use common::data::data;
use common::scenes::turning_gears;
use common::shares::{Share, in_shares};
use cutaway::Model;
use cutaway::layers::Kind;
use cutaway::scene::{Part, Topology};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_io::document::{Document, Timeline, cut, part, section};
use cutaway_io::load::{Assets, load_mesh_file};

const SIZE_PX: [u32; 2] = [256, 192];
const OBLIQUE: &str = "-0.3,-0.25,-1@50%,50%,50%";
const TIMES: usize = 10;

/// Models, and of which of their clips (by number) frames are drawn.
const MODELS: &[(&str, &[u32])] = &[
    ("RiggedSimple.glb", &[0]),
    ("CesiumMan.glb", &[0]),
    ("Fox.glb", &[0, 1, 2]),
    ("AnimatedMorphCube.glb", &[0]),
    ("MorphStressTest.glb", &[0, 1, 2]),
    ("CesiumMilkTruck.glb", &[0]),
    ("Knight.glb", &[0, 3]),
];

/// Strategies that must be exact, and who rasterises for them.
const EXACT: &[(&str, Rasteriser)] = &[
    ("raycast+mask", Rasteriser::Hardware),
    ("raycast+mask", Rasteriser::Compute),
    ("raycast+abuffer", Rasteriser::Hardware),
    ("raycast+abuffer", Rasteriser::Compute),
    // The compute rasteriser has no stencil.
    ("raycast+stencil", Rasteriser::Hardware),
];

fn is_closed(part: &Part) -> bool {
    Topology::new(&part.mesh).closed
}

/// What all exact strategies make of scenes that move.
#[derive(Default)]
struct Tally {
    /// Frames judged.
    frames: usize,
    /// Views that show a cap.
    caps: usize,
    faults: Vec<String>,
}

impl Tally {
    fn judge(&mut self, what: &str, timeline: &Timeline) {
        let duration_s = timeline.duration_s().expect("it moves");
        let mut before: Option<Model> = None;
        for i in 0..TIMES {
            let time_s = duration_s * (i as f64 + 0.5) / TIMES as f64;
            let scene = timeline.at(time_s).expect("a scene at that time");
            let model = before
                .as_ref()
                .map_or_else(|| Model::new(&scene), |m| m.updated(&scene));
            let question = Question::of_model(model.clone(), &scene, SIZE_PX);
            let layers = &question.exact.layers.pixels;
            self.caps += usize::from(layers.iter().any(|l| l.kind == Kind::Cap));
            for (name, rasteriser) in EXACT {
                let strategy: Strategy = name.parse().expect("a strategy");
                let answer = question.answer(Method::new(strategy, DrawOptions::by(*rasteriser)));
                self.frames += 1;
                let fault = match &answer.outcome {
                    Outcome::Refused(refusal) => Some(refusal.reason.clone()),
                    _ => answer.fault_of_exact(),
                };
                if let Some(fault) = fault {
                    let who = format!("{name} by {rasteriser}");
                    self.faults
                        .push(format!("{what} at {time_s:.3} s, {who}: {fault}"));
                }
            }
            before = Some(model);
        }
    }
}

in_shares!(models_that_move_are_capped_exactly_at_every_time, 4);

fn models_that_move_are_capped_exactly_at_every_time(share: Share) {
    let Some(data) = data() else { return };
    let mut tally = Tally::default();
    let clips = MODELS
        .iter()
        .flat_map(|(file, clips)| clips.iter().map(move |clip| (file, *clip)));
    for (file, clip) in share.part(clips) {
        let path = data.join("animated").join(file);
        let mut parts = load_mesh_file(&path).expect("a mesh that loads").parts;
        parts.retain(is_closed);
        assert!(!parts.is_empty(), "{file} has closed parts");
        let mut assets = Assets::default();
        assets.insert_mesh(&path, parts);
        let mut document = Document::new();
        document
            .add_part(part(&path.to_string_lossy()))
            .expect("a part");
        document.add_cut(cut([section(OBLIQUE)])).expect("a cut");
        document.set("clip", i64::from(clip)).expect("a clip");
        let timeline = document.timeline(&mut assets);
        let timeline = timeline.expect("a clip of that number");
        tally.judge(&format!("{file}, clip {clip}"), &timeline);
    }
    println!("{} frames, {} views with caps", tally.frames, tally.caps);
    assert!(tally.faults.is_empty(), "{}", tally.faults.join("\n"));
    assert!(
        tally.caps > share.least(60),
        "only {} views have caps",
        tally.caps
    );
}

#[test]
fn gears_that_turn_are_capped_exactly_at_every_time() {
    let Some(data) = data() else { return };
    let mesh = data.join("assembly/cube_gears.glb");
    let text = turning_gears(&mesh, OBLIQUE, 90.0);
    let document = Document::parse("gears.toml", &text).expect("a document");
    let timeline = document.timeline(&mut Assets::default());
    let mut tally = Tally::default();
    tally.judge("gears", &timeline.expect("a sound scene"));
    assert!(tally.faults.is_empty(), "{}", tally.faults.join("\n"));
    assert_eq!(tally.caps, TIMES, "views with caps");
}
