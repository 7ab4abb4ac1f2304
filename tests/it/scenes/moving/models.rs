//! Models that others animated. They are not part of the repository (see `real_meshes.rs`); where they are not, or have no
//! clips, there is nothing to check.

use std::path::PathBuf;

use cutaway::Model;
use cutaway::scene::{ClipSurface, Scene, Topology};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_io::load::load_mesh_file;

use super::common::Question;
use super::common::data::data;
use super::vertices::farthest_of_moving;

const SIZE_PX: [u32; 2] = [128, 96];

fn files() -> Vec<PathBuf> {
    let Some(data) = data() else {
        return Vec::new();
    };
    let entries = std::fs::read_dir(data.join("animated")).expect("a folder of models");
    let mut files: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "glb"));
    files.sort();
    files
}

#[test]
fn animated_models_are_posed_and_cut_exactly() {
    for file in files() {
        let name = file.file_name().map(|n| n.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        let parts = load_mesh_file(&file).expect("a model that loads").parts;
        let Some(clips) = parts.iter().map(|p| p.clips().len()).max() else {
            continue;
        };
        for clip in 0..clips.min(2) {
            let mut model: Option<Model> = None;
            for time_s in [0.0, 0.3, 0.7] {
                let mut scene = Scene {
                    name: format!("{name}, clip {clip} at {time_s} s"),
                    parts: parts.iter().map(|p| p.at_time(clip, time_s)).collect(),
                    ..Scene::default()
                };
                scene.stage = Some(scene.bounds());
                let section = ClipSurface::parse("-0.3,-0.25,-1@50%,50%,50%", &scene.bounds());
                let surface = section.expect("a section");
                scene.cuts = vec![cutaway::Cut::new("middle", vec![surface])];
                let next = model
                    .as_ref()
                    .map_or_else(|| Model::new(&scene), |m| m.updated(&scene));
                model = Some(next.clone());

                // What a cut removes is not posed: it is looked at uncut.
                let mut whole = scene.clone();
                whole.cuts.clear();
                let farthest = farthest_of_moving(&whole, &next.updated(&whole));
                // A joint can stretch what it pulls, and a model be small in its own space.
                assert!(farthest < 2e-6, "{}: {farthest:e} off", scene.name);
                let is_closed = scene.parts.iter().all(|p| Topology::new(&p.mesh).closed);
                let question = Question::of_model(next, &scene, SIZE_PX);
                for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
                    let options = DrawOptions::by(rasteriser);
                    let judged = question.answer(Method::new(Strategy::RAYCAST_MASK, options));
                    let wrong = judged.comparison.decided_wrong_px;
                    println!(
                        "{}, {rasteriser}: closed {is_closed}, {wrong} px wrong",
                        scene.name
                    );
                    if is_closed {
                        assert_eq!(
                            judged.fault_of_exact(),
                            None,
                            "{}, {rasteriser}",
                            scene.name
                        );
                    }
                }
            }
        }
    }
}
