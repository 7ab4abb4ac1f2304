//! Sweeps: passes over all triangles of a mesh on a screen; each small triangle takes one invocation, the rest are split into pieces for workgroups.
//!
//! Edge functions are exact integers and the top-left rule assigns a sample on a shared edge to exactly one triangle: coverage equals
//! that of the GPU's own rasteriser, even on devices with few raster units. A file that fills `cutaway::sample` defines what a sample
//! does when covered; if it stores fragments for an inside test, a file that fills `cutaway::store` defines how.
//!
//! The first sweep over a screen queues the triangles that are not small, and lists the small ones with a sample that requests another
//! sweep; later sweeps use these lists. A prefix sum counts the pieces of queued triangles, and a workgroup is dispatched for each
//! ([`Share`](super::share::Share)). Sweeps over one screen that use the same sample file run the same pipelines: their depths are bitwise
//! equal. After Laine & Karras, *High-performance software rasterization on GPUs* (2011).

use super::store::Store;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::CrossingSource;
use crate::passes::frame::dispatch::groups_along;
use crate::passes::frame::on_screen::ScreenMesh;
use crate::passes::frame::touched::Touched;
use crate::plan::{Access, Binding, Pass, Plan, Work};
use crate::shader::Shader;

/// Description of a sweep.
#[derive(Clone, Debug)]
pub(crate) struct SweepPasses<'a> {
    /// Prefix of the pass names: "mark" makes "mark small" and "mark large".
    pub name: &'a str,
    /// What a sample does: the reason for the passes.
    pub reason: &'a str,
    /// File that fills `cutaway::sample`.
    pub sample: &'static str,
    /// Further files that the sample needs.
    pub more_files: Vec<&'static str>,
    /// Store for fragments, if the sample writes fragments for an inside test.
    pub store: Option<&'a Store>,
    /// The crossings, if the sample counts those in front of it.
    pub crossings: Option<&'a CrossingSource>,
    /// Further bindings of the sample.
    pub bindings: Vec<Binding>,
    /// The touched tiles, if this sweep is to find them.
    pub touched: Option<Touched>,
    /// True if this sweep is to find the depth range of the cut parts in each touched tile.
    pub finds_depths: bool,
    /// True if the same screen was swept before.
    pub again: bool,
}

impl<'a> SweepPasses<'a> {
    /// A first sweep in which fragments only store what an inside test needs.
    pub(crate) fn of_fragments(name: &'a str, reason: &'a str, store: &'a Store) -> Self {
        Self {
            name,
            reason,
            sample: "lib/sample/bare.wgsl",
            more_files: Vec::new(),
            store: Some(store),
            crossings: None,
            bindings: Vec::new(),
            touched: None,
            finds_depths: false,
            again: false,
        }
    }

    /// Records the sweep over a screen: small triangles, then the pieces of the others, which the first sweep counts.
    pub(crate) fn record(&self, plan: &mut Plan, scene: &SceneBuffers<'_>, screen: &ScreenMesh) {
        let shader = |path: &'static str| {
            let touch = match self.touched {
                Some(_) if self.finds_depths => "lib/touch/depths.wgsl",
                Some(_) => "lib/touch/tiles.wgsl",
                None => "lib/touch/nothing.wgsl",
            };
            let mut shader = Shader::from(path)
                .with(self.sample)
                .with_all(&self.more_files)
                .with(touch)
                .with(screen.rows());
            if let Some(crossings) = self.crossings {
                shader =
                    shader
                        .with_all(crossings.files())
                        .with(if screen.preclassified.is_some() {
                            "lib/classifying/groups.wgsl"
                        } else {
                            "lib/classifying/none.wgsl"
                        });
            }
            match self.store {
                Some(store) => shader.with(store.file),
                None => shader,
            }
        };
        let mut bindings = screen.bindings();
        if self.again {
            let first = bindings.iter_mut().find(|b| **b == screen.sweep);
            first
                .into_iter()
                .for_each(|b| *b = screen.sweep_again.clone());
        }
        bindings.extend(self.bindings.iter().cloned());
        bindings.extend(self.touched.map(|t| t.binding(Access::ReadWrite)));
        if let Some(store) = self.store {
            bindings.extend(store.bindings.iter().cloned());
        }
        if let Some(crossings) = self.crossings {
            bindings.push(scene.cut_table.clone());
            bindings.extend(crossings.bindings.iter().cloned());
            bindings.extend(screen.preclassified.clone());
        }
        let mut small = bindings.clone();
        small.push(screen.queue(match self.again {
            true => Access::Read,
            false => Access::ReadWrite,
        }));
        bindings.push(screen.queue(Access::Read));
        let lane_bits = scene.lanes.constant();
        let name = |what: &str| screen.named(&format!("{} {what}", self.name));
        let groups = groups_along(screen.triangle_count);
        let pass = Pass::new(
            name("small"),
            self.reason,
            shader("passes/rasterise/small.wgsl"),
            small,
            Work::Compute { groups },
        );
        let mut constants = vec![lane_bits];
        constants.extend(screen.share.constants());
        constants.push(("fills_queue", f64::from(u8::from(!screen.is_queued))));
        plan.add_pass(pass.on(screen.clock).with_constants(constants));
        if !self.again && !screen.is_queued {
            screen.count_pieces(plan);
        }
        let polygon = match screen.may_clip {
            true => "lib/polygon/clipped.wgsl",
            false => "lib/polygon/plain.wgsl",
        };
        let pass = Pass::new(
            name("large"),
            "the same for triangles with many samples, and for clipped triangles",
            shader("passes/rasterise/large.wgsl").with(polygon),
            bindings,
            screen.over_pieces(),
        );
        plan.add_pass(pass.on(screen.clock).with_constants(vec![lane_bits]));
    }
}
