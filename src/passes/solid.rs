//! The pass over the mesh: every fragment counts the crossings before it, leaves to the inside test what that
//! wants, and survives where it is kept.
//!
//! One pass for the cut parts by the GPU's own rasteriser, and one that draws the others plainly; or the sweeps of the compute
//! rasteriser over all. What an inside test wants of a fragment is a file that fills the open module `cutaway::store`.

use super::rasterise::{Swept, rasterise};
use super::{AskedCrossings, DrawPass, Rasteriser, Refusal, SceneBuffers, Surfaces, counted};
use crate::plan::{Access, Binding, Plan};
use crate::shader::Shader;

/// What the pass over the mesh leaves for an inside test.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    /// File that fills `cutaway::store`.
    pub file: &'static str,
    /// What it binds: what every fragment updates, and what says how.
    pub bindings: Vec<Binding>,
    /// Rounds of a loop that one fragment may take.
    pub rounds: u32,
}

impl Store {
    /// Fragments leave nothing: the inside test asks elsewhere, or draws the mesh again. What is bound begins empty.
    pub(crate) fn nothing(bindings: Vec<Binding>) -> Self {
        Self {
            file: "lib/store/nothing.wgsl",
            bindings,
            rounds: 0,
        }
    }

    /// The bindings of the pass that makes every pixel ready for its first fragment.
    pub(crate) fn begun(&self) -> impl Iterator<Item = Binding> + '_ {
        self.bindings.iter().map(|b| Binding {
            access: match b.access {
                Access::Read => Access::Read,
                Access::Write | Access::ReadWrite => Access::Write,
            },
            ..b.clone()
        })
    }
}

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
    crossings: &AskedCrossings,
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
    crossings: &AskedCrossings,
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
    let ranks = input.relevance.cut_parts();
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
    let settled = scene.settled.as_ref().map(|settled| {
        let mut pass = DrawPass {
            name: "solid settled".to_owned(),
            reason: "the same for faces in a clip-surface or just beside it, on the side on which they are known to lie"
                .to_owned(),
            shader: Shader::from("passes/settled.wgsl")
                .with(store.file)
                .with_all(&crossings.files()),
            draws: input.draws_of_groups(ranks),
            ..solid.clone()
        };
        pass.bindings.push(settled.clone());
        pass
    });
    let mut surfaces = Surfaces::new(plan, scene);
    surfaces.draw(plan, solid);
    if let Some(settled) = settled.filter(|s| !s.draws.is_empty()) {
        surfaces.draw(plan, settled);
    }
    surfaces.draw_plain_parts(plan, scene, true);
    surfaces
}
