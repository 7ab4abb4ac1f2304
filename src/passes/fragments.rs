//! Lists of fragments of any length: counted, laid out by a prefix sum, filled.
//!
//! All lists share one buffer, because the passes that fill it have no second binding to spare: a word for each list, 4 bytes
//! for the depth of each fragment and, where parts meet in a list, 4 for its owner. As many fragments as the frame before
//! needed; a frame that needs more says how many and marks what found no room. Nothing is sorted: parity asks for no order.
//!
//! Cannot: outgrow a storage binding, 128 MiB in core WebGPU, which holds 33 million words.

use super::recorder::NEED_OF_FRAGMENTS;
use super::{Recorder, Scan, Store};
use crate::plan::pack::FragmentPool;
use crate::plan::{
    Binding, Bounded, Capacities, Clock, Contents, DepthCompare, DepthTarget, Knob, Pass, Resource,
    ResourceId, Role, Work,
};
use crate::shader::Shader;

/// Lists of fragments, as resources.
#[derive(Clone, Debug)]
pub struct FragmentLists {
    fragments: ResourceId,
    pool: Binding,
    lists: u32,
}

impl FragmentLists {
    /// What a fragment does while lists are counted.
    pub fn counting(&self) -> Store {
        Store {
            file: "lib/store/count.wgsl",
            bindings: vec![Binding::update("fragments", self.fragments)],
        }
    }

    /// What a fragment does while lists are filled.
    pub fn keeping(&self) -> Store {
        Store {
            file: "lib/store/keep.wgsl",
            bindings: vec![
                Binding::update("fragments", self.fragments),
                self.pool.clone(),
            ],
        }
    }

    /// The bindings of a pass that makes all lists empty.
    pub fn emptied(&self) -> [Binding; 2] {
        [
            Binding::write("fragments", self.fragments),
            self.pool.clone(),
        ]
    }

    /// The bindings of `shaders/lib/fragment_runs.wgsl`.
    pub fn read(&self) -> [Binding; 2] {
        [
            Binding::read("fragments", self.fragments),
            self.pool.clone(),
        ]
    }

    /// How many lists there are.
    pub fn count(&self) -> u32 {
        self.lists
    }
}

impl Recorder<'_> {
    /// So many lists, and as many fragments in them as the last frame needed: at first one for each list. The reason where
    /// there are more lists than words can count.
    pub fn fragment_lists(
        &mut self,
        lists: u64,
        has_owners: bool,
        capacities: &Capacities,
        what: &str,
    ) -> Result<FragmentLists, String> {
        let lists = u32::try_from(lists)
            .map_err(|_| format!("{lists} lists of {what} are more than 32 bits can count"))?;
        let capacity = capacities.fragments.unwrap_or(lists);
        let words_each = if has_owners { 2 } else { 1 };
        let bytes = 4 * (u64::from(lists) + u64::from(capacity) * words_each);
        let fragments = self.once(what, |_| Resource::storage(what, bytes, Clock::Frame));
        let pool = FragmentPool {
            lists,
            capacity,
            has_owners: u32::from(has_owners),
            padding: 0,
        };
        let pool = self.uploaded("pool", Role::Uniform, Clock::Frame, |_| {
            Contents::of(&[pool])
        });
        self.plan.bounded.push(Bounded {
            what: what.to_owned(),
            slot: NEED_OF_FRAGMENTS,
            capacity,
            knob: Some(Knob::Fragments),
            exact: false,
        });
        Ok(FragmentLists {
            fragments,
            pool,
            lists,
        })
    }

    /// Lays the lists out once they are counted.
    pub fn lay_out(&mut self, lists: &FragmentLists, what: &str, need: ResourceId) {
        Scan {
            name: "lists",
            what,
            clock: Clock::Frame,
            items: lists.fragments,
            length: lists.lists,
            total: (need, NEED_OF_FRAGMENTS),
        }
        .record(&mut self.plan);
    }

    /// A pass over the cut parts in which fragments leave what an inside test wants, and are not drawn.
    pub fn draw_fragments(&mut self, name: &str, reason: &str, store: &Store) {
        let (vertices, indices) = self.mesh();
        let mut bindings = vec![self.frame(), self.parts()];
        bindings.extend(store.bindings.iter().cloned());
        let ranks = self.relevance.cut_parts().to_vec();
        let depth = self.targets().depth;
        self.plan.add_pass(Pass {
            name: name.to_owned(),
            clock: Clock::Frame,
            reason: reason.to_owned(),
            shader: Shader::from("passes/fragments.wgsl").with(store.file),
            bindings,
            constants: vec![("lane_bits", f64::from(self.lane_bits))],
            work: Work::Draw {
                color: None,
                depth: DepthTarget {
                    resource: depth,
                    layer: 0,
                    clear: true,
                    compare: DepthCompare::Always,
                },
                vertices,
                indices,
                draws: self.draws_of(&ranks),
            },
        });
    }
}
