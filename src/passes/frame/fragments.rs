//! Fragment lists of any length: counted, laid out by a prefix sum, filled.
//!
//! All lists share one buffer, because the passes that fill it have no second binding to spare: one word per list, 4 bytes
//! for the depth of each fragment and, if a list mixes parts, 4 for its owner. The capacity is the need of the frame
//! before; a frame that needs more reports how many and marks the pixels that lost fragments. Nothing is sorted: parity needs no order.
//!
//! Cannot: exceed a storage binding, 128 MiB in core WebGPU, which holds 33 million words.

use super::buffers::SceneBuffers;
use super::input::Input;
use super::need::NEED_OF_FRAGMENTS;
use super::on_screen::ScreenMesh;
use super::rasteriser::Rasteriser;
use super::refusal::Refusal;
use crate::passes::draw::scan::{Scan, ScanRange, Total};
use crate::passes::draw::screen::{Fresh, ScreenOf};
use crate::passes::draw::share::Share;
use crate::passes::draw::store::Store;
use crate::passes::draw::sweep::SweepPasses;
use crate::plan::pack::FragmentPool;
use crate::plan::{
    Binding, Bounded, BufferRole, Capacity, Clock, Contents, DepthTarget, Pass, Plan, Resource,
    ResourceId, Work,
};
use crate::shader::Shader;

/// Lists of fragments, as resources.
#[derive(Clone, Debug)]
pub(crate) struct FragmentLists {
    fragments: ResourceId,
    pool: Binding,
    layout: FragmentPool,
}

impl FragmentLists {
    /// Store for fragments while lists are counted.
    pub(crate) fn counting(&self) -> Store {
        self.stored("lib/store/count.wgsl")
    }

    /// Store for fragments while lists are filled.
    pub(crate) fn keeping(&self) -> Store {
        self.stored("lib/store/keep.wgsl")
    }

    fn stored(&self, file: &'static str) -> Store {
        Store {
            file,
            bindings: self.updated().into(),
            rounds: 0,
        }
    }

    /// The bindings of `shaders/lib/lists/fragment_lists.wgsl` while fragments are stored.
    pub(crate) fn updated(&self) -> [Binding; 2] {
        [
            Binding::update("fragments", self.fragments),
            self.pool.clone(),
        ]
    }

    /// The bindings of a pass that empties all lists.
    pub(crate) fn emptied(&self) -> [Binding; 2] {
        [
            Binding::write("fragments", self.fragments),
            self.pool.clone(),
        ]
    }

    /// The bindings of `shaders/lib/lists/fragment_runs.wgsl`.
    pub(crate) fn read(&self) -> [Binding; 2] {
        [
            Binding::read("fragments", self.fragments),
            self.pool.clone(),
        ]
    }

    /// Number of lists.
    pub(crate) fn count(&self) -> u32 {
        self.layout.lists
    }

    /// `lists` empty lists. Together they hold as many fragments as the last frame needed; at first, one per list. Returns the reason if
    /// there are more lists than 32-bit words can count.
    pub(crate) fn of_mesh(
        plan: &mut Plan,
        input: &Input<'_>,
        lists: u64,
        has_owners: bool,
        what: &str,
    ) -> Result<Self, Refusal> {
        let lists = u32::try_from(lists).map_err(|_| {
            Refusal::amount(format!(
                "{lists} lists of {what} are more than 32 bits can count"
            ))
        })?;
        let capacity = input.capacities.fragments.unwrap_or(lists);
        let words_each = if has_owners { 2 } else { 1 };
        let bytes = 4 * (u64::from(lists) + u64::from(capacity) * words_each);
        let fragments = plan.add_resource(Resource::storage(what, bytes, Clock::Frame));
        let layout = FragmentPool {
            lists,
            capacity,
            has_owners: u32::from(has_owners),
            first_list: 0,
        };
        plan.bounded.push(Bounded {
            what: what.to_owned(),
            slot: NEED_OF_FRAGMENTS,
            capacity,
            resizes: Some(Capacity::Fragments),
            exact: false,
        });
        Ok(Self {
            fragments,
            pool: pool(plan, "pool", layout),
            layout,
        })
    }

    /// The same lists for passes whose list numbers begin at `first_list`.
    #[must_use]
    pub(crate) fn starting_at(&self, plan: &mut Plan, first_list: u32) -> Self {
        let layout = FragmentPool {
            first_list,
            ..self.layout
        };
        let name = format!("pool from {first_list}");
        Self {
            pool: pool(plan, &name, layout),
            layout,
            ..*self
        }
    }

    /// Lays the lists out after counting.
    pub(crate) fn lay_out(&self, plan: &mut Plan, what: &str, need: ResourceId) {
        Scan {
            name: "lists",
            what,
            clock: Clock::Frame,
            items: self.fragments,
            run: ScanRange::known(self.layout.lists),
            total: Total::Word(need, NEED_OF_FRAGMENTS),
        }
        .record(plan);
    }
}

fn pool(plan: &mut Plan, name: &str, layout: FragmentPool) -> Binding {
    let contents = Contents::from_values(&[layout]);
    let pool = Resource::upload(name, BufferRole::Uniform, contents, Clock::Frame);
    Binding::read("pool", plan.add_resource(pool))
}

/// Stores what an inside test needs from the cut parts' fragments, without drawing the parts; returns the reason if the compute rasteriser
/// cannot do this. That rasteriser uses a separate screen, whose queue of large triangles no other pass fills.
pub(crate) fn leave_fragments(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    name: &str,
    reason: &str,
    store: &Store,
) -> Result<(), Refusal> {
    match scene.input.rasteriser {
        Rasteriser::Hardware => draw_fragments(plan, scene, name, reason, store),
        Rasteriser::Compute => {
            let of = ScreenOf {
                name,
                view: scene.input.view,
                frame: scene.frame.clone(),
                clock: Clock::Frame,
                ranks: scene.input.active_cuts.cut_parts(),
                classifies: false,
                share: Share::of_store(store),
                fresh: Fresh::nothing(),
            };
            let screen = ScreenMesh::record(plan, scene, of)?;
            SweepPasses::of_fragments("fragments", reason, store).record(plan, scene, &screen);
        }
    }
    Ok(())
}

fn draw_fragments(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    name: &str,
    reason: &str,
    store: &Store,
) {
    let (vertices, indices) = scene.mesh();
    let mut bindings = vec![scene.frame.clone(), scene.parts.clone()];
    bindings.extend(store.bindings.iter().cloned());
    let pass = Pass::new(
        name,
        reason,
        Shader::from("passes/fragments.wgsl").with(store.file),
        bindings,
        Work::Draw {
            color: None,
            depth: DepthTarget::untouched(scene.depth),
            vertices,
            indices,
            draws: scene.input.draws_of(scene.input.active_cuts.cut_parts()),
        },
    );
    plan.add_pass(pass.with_constants(vec![scene.lanes.constant()]));
}
