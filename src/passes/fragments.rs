//! Lists of fragments of any length: counted, laid out by a prefix sum, filled.
//!
//! All lists of a kind share one buffer, because the passes that fill it have no second binding to spare: a word for each list, 4 bytes
//! for the depth of each fragment and, where parts meet in a list, 4 for its owner. As many fragments as the frame before
//! needed; a frame that needs more says how many and marks what found no room. Nothing is sorted: parity asks for no order.
//!
//! Cannot: outgrow a storage binding, 128 MiB in core WebGPU, which holds 33 million words.

use super::Refusal;
use super::recorder::{NEED_OF_FRAGMENTS, NEED_OF_SHEETS};
use super::{Rasteriser, Recorder, Scan, ScreenOf, Store, Sweep, pixels};
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
    layout: FragmentPool,
    kind: Kind,
}

/// What keeps the lists of one plan apart.
#[derive(Clone, Copy, Debug)]
struct Kind {
    /// What the passes that lay them out are named after.
    lists: &'static str,
    /// Name of their layout.
    pool: &'static str,
    /// Word of the need buffer.
    slot: u32,
    /// What makes room.
    knob: Knob,
}

/// Fragments of the mesh.
const OF_MESH: Kind = Kind {
    lists: "lists",
    pool: "pool",
    slot: NEED_OF_FRAGMENTS,
    knob: Knob::Fragments,
};
/// Fragments of sheets.
const OF_SHEETS: Kind = Kind {
    lists: "sheets",
    pool: "sheet pool",
    slot: NEED_OF_SHEETS,
    knob: Knob::Sheets,
};

impl FragmentLists {
    /// What a fragment does while lists are counted.
    pub fn counting(&self) -> Store {
        self.stored("lib/store/count.wgsl")
    }

    /// What a fragment does while lists are filled.
    pub fn keeping(&self) -> Store {
        self.stored("lib/store/keep.wgsl")
    }

    fn stored(&self, file: &'static str) -> Store {
        Store {
            file,
            bindings: self.updated().into(),
        }
    }

    /// The bindings of `shaders/lib/fragment_lists.wgsl` while fragments come.
    pub fn updated(&self) -> [Binding; 2] {
        [
            Binding::update("fragments", self.fragments),
            self.pool.clone(),
        ]
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
        self.layout.lists
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
    ) -> Result<FragmentLists, Refusal> {
        self.lists_of(OF_MESH, lists, has_owners, capacities.fragments, what)
    }

    /// A list of sheet fragments for each pixel: depths, and a word of `shaders/lib/sheet_words.wgsl` in the place of owners.
    pub(super) fn sheet_lists(
        &mut self,
        capacities: &Capacities,
        what: &str,
    ) -> Result<FragmentLists, Refusal> {
        let lists = pixels(self.view.size_px);
        self.lists_of(OF_SHEETS, lists, true, capacities.sheets, what)
    }

    fn lists_of(
        &mut self,
        kind: Kind,
        lists: u64,
        has_owners: bool,
        capacity: Option<u32>,
        what: &str,
    ) -> Result<FragmentLists, Refusal> {
        let lists = u32::try_from(lists).map_err(|_| {
            Refusal::amount(format!(
                "{lists} lists of {what} are more than 32 bits can count"
            ))
        })?;
        let capacity = capacity.unwrap_or(lists);
        let words_each = if has_owners { 2 } else { 1 };
        let bytes = 4 * (u64::from(lists) + u64::from(capacity) * words_each);
        let fragments = self.once(what, |_| Resource::storage(what, bytes, Clock::Frame));
        let layout = FragmentPool {
            lists,
            capacity,
            has_owners: u32::from(has_owners),
            first_list: 0,
        };
        self.plan.bounded.push(Bounded {
            what: what.to_owned(),
            slot: kind.slot,
            capacity,
            knob: Some(kind.knob),
            exact: false,
        });
        let pool = self.pool(kind.pool, layout);
        Ok(FragmentLists {
            fragments,
            pool,
            layout,
            kind,
        })
    }

    /// The same lists for passes that count theirs from `first_list`.
    pub fn lists_from(&mut self, lists: &FragmentLists, first_list: u32) -> FragmentLists {
        let layout = FragmentPool {
            first_list,
            ..lists.layout
        };
        FragmentLists {
            pool: self.pool(&format!("{} from {first_list}", lists.kind.pool), layout),
            layout,
            ..*lists
        }
    }

    fn pool(&mut self, name: &str, layout: FragmentPool) -> Binding {
        let contents = Contents::of(&[layout]);
        let id = self.once(name, |_| {
            Resource::upload(name, Role::Uniform, contents, Clock::Frame)
        });
        Binding::read("pool", id)
    }

    /// Lays the lists out once they are counted.
    pub fn lay_out(&mut self, lists: &FragmentLists, what: &str, need: ResourceId) {
        Scan {
            name: lists.kind.lists,
            what,
            clock: Clock::Frame,
            items: lists.fragments,
            length: lists.layout.lists,
            total: (need, lists.kind.slot),
        }
        .record(&mut self.plan);
    }

    /// Has the fragments of the cut parts leave what an inside test wants, without drawing them; the reason where the compute
    /// rasteriser cannot. That takes the mesh to a screen of its own, whose queue of large triangles nobody else fills.
    pub fn leave_fragments(
        &mut self,
        rasteriser: Rasteriser,
        name: &str,
        reason: &str,
        store: &Store,
    ) -> Result<(), Refusal> {
        match rasteriser {
            Rasteriser::Hardware => {
                self.draw_fragments(name, reason, store);
                Ok(())
            }
            Rasteriser::Compute => {
                let ranks = self.relevance.cut_parts().to_vec();
                let (frame, view) = (self.frame(), self.view);
                let screen = self.screen(ScreenOf {
                    name,
                    view,
                    frame,
                    clock: Clock::Frame,
                    ranks: &ranks,
                    settles: false,
                    fresh: "lib/fresh/nothing.wgsl",
                    freshened: Vec::new(),
                })?;
                self.sweep(&screen, &sweep_of_fragments("fragments", reason, store));
                Ok(())
            }
        }
    }

    fn draw_fragments(&mut self, name: &str, reason: &str, store: &Store) {
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
                    stencil: None,
                },
                vertices,
                indices,
                draws: self.draws_of(&ranks),
            },
        });
    }
}

/// A first sweep in which fragments do nothing but leave what an inside test wants.
pub fn sweep_of_fragments<'a>(name: &'a str, reason: &'a str, store: &'a Store) -> Sweep<'a> {
    Sweep {
        name,
        reason,
        sample: "lib/sample/bare.wgsl",
        store: Some(store),
        crossings: None,
        bindings: Vec::new(),
        again: false,
    }
}
