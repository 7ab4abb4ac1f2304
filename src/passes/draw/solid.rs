//! The pass over the mesh: every fragment counts the crossings in front of it, stores what the inside test needs,
//! and survives if it is kept.
//!
//! The GPU's own rasteriser draws the cut parts in one pass and all other parts plainly in another; the compute rasteriser's sweeps draw
//! all parts. A file that fills the open module `cutaway::store` defines what a fragment stores for the inside test.

use super::rasterise::{Swept, rasterise};
use super::store::Store;
use super::surface::{DrawPass, Surfaces};
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::CrossingSource;
use crate::passes::frame::input::counted;
use crate::passes::frame::rasteriser::Rasteriser;
use crate::passes::frame::refusal::Refusal;
use crate::plan::Plan;
use crate::shader::Shader;

/// The nearest kept surface of each pixel, found by either rasteriser.
#[derive(Debug)]
pub(crate) enum NearestKept {
    /// Drawn by the GPU's own rasteriser.
    Drawn(Surfaces),
    /// Swept by the compute rasteriser.
    Swept(Swept),
}

/// Records the pass over the mesh by either rasteriser; returns the reason if the compute rasteriser cannot draw it.
pub(crate) fn over_mesh(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: &Store,
    crossings: &CrossingSource,
) -> Result<NearestKept, Refusal> {
    Ok(match scene.input.rasteriser {
        Rasteriser::Hardware => NearestKept::Drawn(draw_solids(plan, scene, store, crossings)),
        Rasteriser::Compute => NearestKept::Swept(rasterise(plan, scene, store, crossings)?),
    })
}

fn draw_solids(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: &Store,
    crossings: &CrossingSource,
) -> Surfaces {
    let input = scene.input;
    let (vertices, indices) = scene.mesh();
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
    ];
    bindings.extend(store.bindings.iter().cloned());
    bindings.extend(crossings.bindings.iter().cloned());
    let ranks = input.active_cuts.cut_parts();
    let solid = DrawPass {
        name: "solid".to_owned(),
        reason: format!(
            "{}: each fragment marks the crossings in front of it, and stays if it is kept",
            counted(ranks.len(), "cut part")
        ),
        shader: Shader::from("passes/solid.wgsl")
            .with(store.file)
            .with_all(crossings.files()),
        bindings,
        constants: vec![scene.lanes.constant()],
        vertices,
        indices,
        draws: (input.draws_of_rest(ranks).into_iter())
            .chain(input.draws_of_closings())
            .collect(),
    };
    let preclassified = scene.preclassified.as_ref().map(|preclassified| {
        let mut pass = DrawPass {
            name: "solid preclassified".to_owned(),
            reason: "the same for faces in or right next to a clip-surface; the side on which they lie is known beforehand"
                .to_owned(),
            shader: Shader::from("passes/preclassified.wgsl")
                .with(store.file)
                .with_all(crossings.files()),
            draws: input.draws_of_groups(ranks),
            ..solid.clone()
        };
        pass.bindings.push(preclassified.clone());
        pass
    });
    let mut surfaces = Surfaces::new(plan, scene);
    surfaces.draw(plan, solid);
    if let Some(preclassified) = preclassified.filter(|s| !s.draws.is_empty()) {
        surfaces.draw(plan, preclassified);
    }
    surfaces.draw_plain_parts(plan, scene, true);
    surfaces
}
