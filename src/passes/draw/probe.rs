//! Probing: fills the inside mask by sampling an image of each part's volume at the points that matter.
//!
//! One invocation per pixel tests each crossing at which a part goes from removed to kept, and the near plane where it may lie inside a
//! solid. The answers are as exact as the image; resolving is the same as for every other inside test.

use std::ops::Range;

use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::{Crossings, LISTED};
use crate::plan::{Binding, Pass, Plan, ResourceId, Work};
use crate::shader::Shader;

/// An image of the parts' volumes, from which an inside test reads which points are inside.
#[derive(Clone, Debug)]
pub(crate) struct Volume {
    /// File that fills `cutaway::volume`.
    pub file: &'static str,
    /// Bindings of the file.
    pub bindings: Vec<Binding>,
}

impl Volume {
    /// Records the pass that probes the parts at a range of table positions.
    pub(crate) fn probe(
        &self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        places: Range<usize>,
        mask: ResourceId,
        crossings: &Crossings,
    ) {
        let mut bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            scene.parts.clone(),
            Binding::update("mask", mask),
        ];
        bindings.extend(self.bindings.iter().cloned());
        bindings.extend(crossings.bindings());
        let near_inside = f64::from(u8::from(scene.input.active_cuts.near_inside));
        let pass = Pass::new(
            format!("probe {}", places.start),
            "tests whether a crossing is inside its part, if the part goes from removed to kept there",
            Shader::from("passes/probe.wgsl")
                .with(self.file)
                .with_all(&LISTED),
            bindings,
            Work::over(scene.input.view.size_px),
        );
        plan.add_pass(pass.with_constants(vec![
            scene.lanes.constant(),
            ("near_inside", near_inside),
            ("first_place", places.start as f64),
            ("end_place", places.end as f64),
        ]));
    }
}
