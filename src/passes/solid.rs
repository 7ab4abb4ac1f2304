//! The pass over the mesh: every fragment ranks itself in its pixel's list of crossings, leaves to the inside test what that
//! wants, and survives where it is kept.
//!
//! One pass for the cut parts by the GPU's own rasteriser, and one that draws the others plainly; or the sweeps of the compute
//! rasteriser over all. What an inside test wants of a fragment is a file that fills the open module `cutaway::store`.

use super::Refusal;
use super::{Crossings, DrawPass, Rasteriser, Recorder, counted};
use crate::plan::{Access, Binding};
use crate::shader::Shader;

/// What the pass over the mesh leaves for an inside test.
#[derive(Clone, Debug)]
pub struct Store {
    /// File that fills `cutaway::store`.
    pub file: &'static str,
    /// What it binds: what every fragment updates, and what says how.
    pub bindings: Vec<Binding>,
}

impl Store {
    /// Fragments leave nothing: the inside test asks elsewhere, or draws the mesh again. What is bound begins empty.
    pub fn nothing(bindings: Vec<Binding>) -> Self {
        Self {
            file: "lib/store/nothing.wgsl",
            bindings,
        }
    }

    /// The bindings of the pass that makes every pixel ready for its first fragment.
    pub fn begun(&self) -> impl Iterator<Item = Binding> + '_ {
        self.bindings.iter().map(|b| Binding {
            access: match b.access {
                Access::Read => Access::Read,
                Access::Write | Access::ReadWrite => Access::Write,
            },
            ..b.clone()
        })
    }
}

impl Recorder<'_> {
    /// The pass over the mesh by either rasteriser; the reason where the compute rasteriser cannot.
    pub fn over_mesh(
        &mut self,
        rasteriser: Rasteriser,
        store: &Store,
        crossings: &Crossings,
    ) -> Result<(), Refusal> {
        match rasteriser {
            Rasteriser::Hardware => {
                self.draw_solids(store, crossings);
                Ok(())
            }
            Rasteriser::Compute => self.rasterise(store, crossings),
        }
    }

    fn draw_solids(&mut self, store: &Store, crossings: &Crossings) {
        let (vertices, indices) = self.mesh();
        let mut bindings = vec![self.frame(), self.cut_table(), self.parts()];
        bindings.extend(store.bindings.iter().cloned());
        bindings.extend(crossings.bindings());
        let ranks = self.relevance.cut_parts().to_vec();
        let groups = self.draws_of_groups(&ranks);
        let of_groups = (!groups.is_empty()).then(|| {
            let mut bindings = bindings.clone();
            bindings.push(self.settled());
            DrawPass {
                name: "solid settled".to_owned(),
                reason: "the same for faces in a clip-surface or just beside it, on the side on which they are known to lie".to_owned(),
                shader: Shader::from("passes/settled.wgsl").with(store.file),
                bindings,
                constants: vec![("lane_bits", f64::from(self.lane_bits))],
                vertices,
                indices,
                draws: groups,
            }
        });
        self.draw(DrawPass {
            name: "solid".to_owned(),
            reason: format!(
                "{}: each fragment marks the crossings it is behind, and stays where it is kept",
                counted(ranks.len(), "cut part")
            ),
            shader: Shader::from("passes/solid.wgsl").with(store.file),
            bindings,
            constants: vec![("lane_bits", f64::from(self.lane_bits))],
            vertices,
            indices,
            draws: self.draws_of_rest(&ranks),
        });
        if let Some(pass) = of_groups {
            self.draw(pass);
        }
        self.draw_plain_parts(true);
    }
}
