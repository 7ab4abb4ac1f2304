//! Meshes that others made: every closed one, cut by an oblique plane at the size that pictures have. They are not part of the
//! repository (see `real_meshes.rs`); where they are not, there is nothing to check.

use std::path::PathBuf;

use cutaway::Gpu;
use cutaway::scene::{Cut, Scene, Topology, load_mesh_file, section_surface};
use cutaway::session::Session;
use cutaway::strategies::{FrameOptions, Rasteriser, Strategy};

use super::common::data::data;
use super::common::{Judged, Question, software};

const SIZE_PX: [u32; 2] = [1024, 768];

fn files() -> Vec<PathBuf> {
    let Some(data) = data() else {
        return Vec::new();
    };
    let folders = ["cad", "organic", "assembly", "dense", "large"].map(|f| data.join(f));
    let entries = folders
        .iter()
        .flat_map(|f| std::fs::read_dir(f).expect("a folder of meshes"));
    let mut files: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    files.sort();
    files
}

#[test]
fn every_closed_mesh_by_an_oblique_plane() {
    let mut sessions = [Rasteriser::Hardware, Rasteriser::Compute].map(|rasteriser| {
        let gpu = Gpu::open(&software()).expect("an adapter");
        Session::with_options(gpu, FrameOptions::by(rasteriser))
    });
    let (mut faults, mut judged_count) = (Vec::new(), 0);
    for file in files() {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let mut scene = Scene {
            parts: load_mesh_file(&file).expect("a mesh that loads").parts,
            ..Scene::default()
        };
        if !scene.parts.iter().all(|p| Topology::of(&p.mesh).closed) {
            continue;
        }
        let section = section_surface("-0.3,-0.25,-1@50%,50%,50%", &scene.bounds());
        scene.cuts = vec![Cut::of("middle", vec![section.expect("a section")])];
        let question = Question::of(&scene, SIZE_PX);
        for session in &mut sessions {
            let drawn = session.draw(&question.model, &question.view, &Strategy::PLANAR);
            let outcome = drawn.unwrap_or_else(|e| panic!("{name}: {e}")).outcome;
            let layers = session.layers(&Strategy::PLANAR).expect("layers");
            let judged = Judged {
                comparison: question.compare(&layers),
                exact: question.exact.clone(),
                layers,
                outcome,
            };
            let by = session.options().rasteriser;
            let c = &judged.comparison;
            println!("{name} by {by}: {} edge pixels wrong", c.edge_wrong_px);
            if let Some(fault) = judged.fault_of_exact() {
                faults.push(format!("{name} by {by}: {fault}"));
            }
            judged_count += 1;
        }
        for session in &mut sessions {
            session.forget();
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(
        judged_count == 0 || judged_count >= 40,
        "only {judged_count} frames of closed meshes"
    );
}
