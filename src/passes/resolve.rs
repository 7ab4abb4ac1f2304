//! Resolving: what each pixel shows, decided from its crossings, the inside test and the nearest kept surface.
//!
//! The same decision for every inside test and both rasterisers; what differs fills open modules. Time in proportion to pixels
//! and, where they have crossings, to cut parts. After the GPU's own rasteriser it is one pass; the compute rasteriser has
//! `decide` and `paint` in its place.

use super::{Crossings, Rasteriser, Recorder};
use crate::plan::{Binding, Clock, ResourceId};
use crate::shader::Shader;

/// How the inside test is answered.
#[derive(Clone, Debug)]
pub struct Inside {
    /// File that fills `cutaway::inside`.
    pub file: &'static str,
    /// What it binds.
    pub bindings: Vec<Binding>,
}

impl Inside {
    /// The answers in the lanes of a mask, all of bits.
    pub fn mask(mask: ResourceId) -> Self {
        Self {
            file: "lib/inside/mask.wgsl",
            bindings: vec![Binding::read("mask", mask)],
        }
    }

    /// The answers in the lanes of a mask, some of counts.
    pub fn winding(mask: ResourceId) -> Self {
        Self {
            file: "lib/inside/winding.wgsl",
            ..Self::mask(mask)
        }
    }
}

impl Recorder<'_> {
    /// Records the pass, or those of the compute rasteriser, which paint as well.
    pub fn resolve(&mut self, rasteriser: Rasteriser, inside: Inside, crossings: &Crossings) {
        match rasteriser {
            Rasteriser::Hardware => self.resolve_drawn(inside, crossings),
            Rasteriser::Compute => self.decide_and_paint(inside, crossings),
        }
    }

    fn resolve_drawn(&mut self, inside: Inside, crossings: &Crossings) {
        let targets = self.targets();
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            self.parts(),
            Binding::read("surface_words", targets.words),
            Binding::read("surface_depth", targets.depth),
            Binding::write("layers", self.layers()),
        ];
        bindings.extend(inside.bindings);
        bindings.extend(crossings.bindings());
        let cap_normal = self.cap_normal(&mut bindings);
        self.compute(
            "resolve",
            Clock::Frame,
            "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it",
            Shader::from("passes/resolve.wgsl")
                .with(inside.file)
                .with(cap_normal),
            bindings,
            self.of_lanes(),
            self.view.size_px,
        );
    }

    /// The constants of a pass that decides.
    pub(super) fn of_lanes(&self) -> Vec<(&'static str, f64)> {
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
        constants
    }

    /// The file that fills `cutaway::cap_normal`, and what it binds.
    pub(super) fn cap_normal(&mut self, bindings: &mut Vec<Binding>) -> &'static str {
        let reliefs = self.has_reliefs();
        if reliefs {
            bindings.push(self.heights());
        }
        match (self.has_cutters(), reliefs) {
            (false, false) => "lib/cap_normal/planes.wgsl",
            (false, true) => "lib/cap_normal/reliefs.wgsl",
            (true, false) => "lib/cap_normal/cutters.wgsl",
            (true, true) => "lib/cap_normal/cutters_reliefs.wgsl",
        }
    }
}
