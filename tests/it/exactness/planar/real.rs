//! Meshes that others made: every closed one, cut by an oblique plane at the size that pictures have. They are not part of the
//! repository (see `real_meshes.rs`); where they are not, there is nothing to check.

use cutaway::session::Session;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};

use super::common::real::{closed, files};
use super::common::shares::{Share, in_shares};
use super::common::{Question, gpu};

const SIZE_PX: [u32; 2] = [1024, 768];

in_shares!(every_closed_mesh_by_an_oblique_plane, 2);

fn every_closed_mesh_by_an_oblique_plane(share: Share) {
    let mut session = Session::new(gpu());
    let (mut faults, mut judged_count) = (Vec::new(), 0);
    let folders = ["cad", "organic", "assembly", "dense", "large"];
    for (name, scene) in closed(share.part(files(&folders)), None) {
        let question = Question::new(&scene, SIZE_PX);
        for by in [Rasteriser::Hardware, Rasteriser::Compute] {
            let method = Method::new(Strategy::PLANAR, DrawOptions::by(by));
            let drawn = session.draw(&question.model, &question.view, method);
            let outcome = drawn.unwrap_or_else(|e| panic!("{name}: {e}")).outcome;
            let judged = question.judge(&session, method, outcome);
            let c = &judged.comparison;
            println!("{name} by {by}: {} edge pixels wrong", c.edge_wrong_px);
            if let Some(fault) = judged.fault_of_exact() {
                faults.push(format!("{name} by {by}: {fault}"));
            }
            judged_count += 1;
        }
        session.forget();
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(
        judged_count == 0 || judged_count >= share.least(40),
        "only {judged_count} frames of closed meshes"
    );
}
