//! The pass over the mesh: every fragment counts the crossings before it, leaves to the inside test what that
//! wants, and survives where it is kept.
//!
//! One pass for the cut parts by the GPU's own rasteriser, and one that draws the others plainly; or the sweeps of the compute
//! rasteriser over all. What an inside test wants of a fragment is a file that fills the open module `cutaway::store`.

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

/// The nearest kept surface of each pixel, by whichever rasteriser.
#[derive(Debug)]
pub(crate) enum NearestKept {
    /// By the GPU's own.
    Drawn(Surfaces),
    /// By the compute rasteriser.
    Swept(Swept),
}

/// Records the pass over the mesh by either rasteriser; the reason where the compute rasteriser cannot.
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
            "{}: each fragment marks the crossings it is behind, and stays where it is kept",
            counted(ranks.len(), "cut part")
        ),
        shader: Shader::from("passes/solid.wgsl")
            .with(store.file)
            .with_all(&crossings.files()),
        bindings,
        constants: vec![scene.lanes.constant()],
        vertices,
        indices,
        draws: input.draws_of_rest(ranks),
    };
    let preclassified = scene.preclassified.as_ref().map(|preclassified| {
        let mut pass = DrawPass {
            name: "solid preclassified".to_owned(),
            reason: "the same for faces in a clip-surface or just beside it, on the side on which they are known to lie"
                .to_owned(),
            shader: Shader::from("passes/preclassified.wgsl")
                .with(store.file)
                .with_all(&crossings.files()),
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
