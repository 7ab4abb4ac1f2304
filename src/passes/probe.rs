//! Probing: the mask by asking an image of each part's volume for the points that matter.
//!
//! One invocation per pixel; an answer for each crossing at which a part goes from removed to kept, and for the near plane where
//! it may be inside a solid. As exact as the image is; the resolve is that of every other inside test.

use std::ops::Range;

use super::{Crossings, Recorder};
use crate::plan::{Binding, Clock, ResourceId};
use crate::shader::Shader;

/// An image of the volume of parts that says which points are inside.
#[derive(Clone, Debug)]
pub struct Volume {
    /// File that fills `cutaway::volume`.
    pub file: &'static str,
    /// What it binds.
    pub bindings: Vec<Binding>,
}

impl Recorder<'_> {
    /// Asks for the parts at some places of the table.
    pub fn probe(
        &mut self,
        name: String,
        places: Range<usize>,
        volume: &Volume,
        mask: ResourceId,
        crossings: &Crossings,
    ) {
        let mut bindings = vec![
            self.frame(),
            self.cut_table(),
            self.parts(),
            Binding::update("mask", mask),
        ];
        bindings.extend(volume.bindings.iter().cloned());
        bindings.extend(crossings.bindings());
        let near_inside = f64::from(u8::from(self.relevance.near_inside));
        self.compute(
            name,
            Clock::Frame,
            "whether a crossing is inside, asked where its part goes from removed to kept",
            Shader::from("passes/probe.wgsl").with(volume.file),
            bindings,
            vec![
                ("lane_bits", f64::from(self.lane_bits)),
                ("near_inside", near_inside),
                ("first_place", places.start as f64),
                ("end_place", places.end as f64),
            ],
            self.view.size_px,
        );
    }
}
