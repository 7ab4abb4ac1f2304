//! Parts that no cut reaches, drawn as they are.
//!
//! One pass for all of them by the GPU's own rasteriser, and one for their faces that lie on each other, where there are any.

use super::recorder::{DrawPass, Recorder, counted};

/// The place value of parts drawn where no list of crossings is known; `UNRANKED` in `shaders/lib/layers.wgsl`.
const UNRANKED: f64 = 254.0;

impl Recorder<'_> {
    /// Draws the parts that no cut reaches. `ranked` frames find such a surface's place among crossings later.
    pub fn draw_plain_parts(&mut self, ranked: bool) {
        let ranks = self.relevance.plain_parts().to_vec();
        if ranks.is_empty() && self.drawn {
            return;
        }
        let (vertices, indices) = self.mesh();
        let bindings = vec![self.frame(), self.parts()];
        let reason = if ranks.is_empty() {
            "clears the targets: every part is removed or capped".to_owned()
        } else if self.relevance.lanes == 0 {
            "no part is cut open: the solids as they are".to_owned()
        } else {
            format!(
                "no cut reaches {}: drawn plainly",
                counted(ranks.len(), "part")
            )
        };
        let mut constants = Vec::new();
        if ranked {
            constants.push(("place", UNRANKED));
        }
        if !self.view.near_cap {
            constants.push(("passes_exits", 1.0));
        }
        self.draw(DrawPass {
            name: "surface".to_owned(),
            reason,
            shader: "passes/surface.wgsl".into(),
            bindings,
            constants: constants.clone(),
            vertices,
            indices,
            draws: self.draws_of_rest(&ranks),
        });
        let doubled = self.draws_of_groups(&ranks);
        if !doubled.is_empty() {
            let pass = DrawPass {
                name: "surface doubled".to_owned(),
                reason: "of faces that lie on each other the one that faces the eye".to_owned(),
                shader: "passes/doubled.wgsl".into(),
                bindings: vec![self.frame(), self.parts(), self.settled()],
                constants,
                vertices,
                indices,
                draws: doubled,
            };
            self.draw(pass);
        }
    }
}
