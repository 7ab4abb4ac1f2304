//! Meshes that others made, as cutters of each other. They are not part of the repository (see `real_meshes.rs`).

use std::path::Path;

use cutaway::layers::Kind;
use cutaway::scene::{Cutter, Part, Topology};
use cutaway_io::load::load_mesh_file;
use glam::{DAffine3, DVec3};

use super::common::data::data;
use super::common::{Question, scenes as cameras, strategy};
use super::scenes::{bitten, judged_by_compute};

fn parts(file: &Path) -> Vec<Part> {
    load_mesh_file(file).expect("a mesh that loads").parts
}

/// A mesh as a cutter, its centre at a point and its diagonal as long as `size`.
fn cutter_of(file: &Path, size: f64, at: DVec3) -> Cutter {
    let cutter = Cutter::from_parts("real", &parts(file)).expect("a closed mesh");
    let bounds = cutter.bounds_in_world();
    let scale = size / bounds.size().length();
    cutter.placed(
        DAffine3::from_translation(at)
            * DAffine3::from_scale(DVec3::splat(scale))
            * DAffine3::from_translation(-bounds.centre()),
    )
}

#[test]
fn real_meshes_cut_each_other_exactly() {
    let Some(data) = data() else {
        return;
    };
    let mut found = Vec::new();
    for (solid, bite, share) in [
        ("organic/armadillo.obj", "organic/spot.obj", 0.6),
        ("organic/spot.obj", "cad/spool_base.stl", 0.7),
        ("cad/spool_base.stl", "organic/armadillo.obj", 0.9),
        ("assembly/cube_gears.glb", "dense/menger_sponge_3.glb", 0.5),
    ] {
        let name = format!("{solid} less {bite}");
        let solids = parts(&data.join(solid));
        let closed = solids.iter().all(|p| Topology::new(&p.mesh).closed);
        assert!(closed, "{solid} is closed");
        let bounds = bitten("", solids.clone(), Vec::new()).bounds();
        let at = bounds.centre() + bounds.size() * DVec3::new(0.1, 0.12, 0.25);
        let cutter = cutter_of(&data.join(bite), bounds.size().length() * share, at);
        let mut scene = bitten(&name, solids, vec![cutter]);
        scene.camera = cameras::orbit(20.0, 35.0, false);
        let question = Question::new(&scene, [320, 240]);
        let caps = question.exact.layers.count(Kind::Cap);
        if caps < 300 {
            found.push(format!("{name}: only {caps} cap pixels"));
        }
        for strategy_name in ["raycast+mask", "raycast+abuffer"] {
            let judged = question.answer(strategy(strategy_name));
            let fault = judged.fault_of_exact();
            found.extend(fault.map(|f| format!("{name}: {strategy_name}: {f}")));
        }
        let judged = judged_by_compute(&question, "raycast+mask");
        found.extend(
            judged
                .fault_of_exact()
                .map(|f| format!("{name}: by compute: {f}")),
        );
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}
