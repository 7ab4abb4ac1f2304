//! Resolving: what each pixel shows, decided from its crossings, the inside test and the nearest kept surface.
//!
//! The same pass for every inside test and both rasterisers; what differs fills its open modules. Time in proportion to pixels
//! and, where they have crossings, to cut parts.

use super::{Crossings, Rasteriser, Recorder};
use crate::plan::{Binding, Clock};
use crate::shader::Shader;

/// How the inside test is answered.
#[derive(Clone, Debug)]
pub struct Inside {
    /// File that fills `cutaway::inside`.
    pub file: &'static str,
    /// What it binds.
    pub bindings: Vec<Binding>,
}

impl Recorder<'_> {
    /// Records the pass.
    pub fn resolve(&mut self, rasteriser: Rasteriser, inside: Inside, crossings: &Crossings) {
        let layers = self.layers();
        let mut bindings = vec![self.frame(), self.cut_table(), self.parts()];
        let drawn = match rasteriser {
            Rasteriser::Hardware => {
                let targets = self.targets();
                bindings.extend([
                    Binding::read("surface_words", targets.words),
                    Binding::read("surface_depth", targets.depth),
                    Binding::write("layers", layers),
                ]);
                "lib/drawn/targets.wgsl"
            }
            Rasteriser::Compute => {
                bindings.push(Binding::update("layers", layers));
                "lib/drawn/layers.wgsl"
            }
        };
        bindings.extend(inside.bindings);
        bindings.extend(crossings.bindings());
        let cap_normal = if self.has_reliefs() {
            bindings.push(self.heights());
            "lib/cap_normal/reliefs.wgsl"
        } else {
            "lib/cap_normal/planes.wgsl"
        };
        let mut constants = vec![
            ("lane_bits", f64::from(self.lane_bits)),
            ("lane_count", self.relevance.lanes as f64),
            (
                "near_inside",
                f64::from(u8::from(self.relevance.near_inside)),
            ),
        ];
        if self.shows_overlaps() {
            constants.push(("overlaps", 1.0));
        }
        self.compute(
            "resolve",
            Clock::Frame,
            "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it",
            Shader::from("passes/resolve.wgsl")
                .with(inside.file)
                .with(drawn)
                .with(cap_normal),
            bindings,
            constants,
            self.view.size_px,
        );
    }
}
