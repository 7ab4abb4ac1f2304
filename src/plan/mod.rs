//! The passes of a frame as plain data.
//!
//! A strategy records a [`Plan`]: passes in order, each with the resources that it reads and writes by name, its clock,
//! and the reason for it. A plan prints ([`Plan::to_text`]), is checked against its own rules and the limits of
//! core WebGPU without an adapter ([`Plan::check`]), and is run by one module, `gpu`. The plan lists everything:
//! there is no other target, buffer or clear.

mod check;
mod clock;
mod cpu;
mod due;
#[doc(hidden)]
pub mod pack;
mod pass;
mod resource;
mod text;
mod work;

pub use check::Limits;
pub use clock::Clock;
pub use cpu::{CpuStep, CpuWork, Recorded};
pub use due::Due;
pub use pass::{Access, Binding, Pass};
pub use resource::{BufferRole, Contents, Format, Piece, Resource, ResourceId, Shape};
pub use work::{
    ARGUMENT_BYTES, Arguments, ColorTarget, DISPATCH_ARGUMENT_BYTES, DepthCompare, DepthTarget,
    Draw, INDEX_BYTES, Stencil, StencilStep, VERTEX_BYTES, Vertices, Work, groups_over,
};

/// A bounded buffer and the need that the frame must report for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bounded {
    /// Name of the bounded quantity: "crossings per pixel".
    pub what: String,
    /// Word of the `need` resource that receives the largest need.
    pub slot: u32,
    /// Capacity, in units of `what`.
    pub capacity: u32,
    /// Member of [`Capacities`] to change when the need differs; `None` if the capacity is fixed.
    pub resizes: Option<Capacity>,
    /// True if a need below the capacity also requires a new plan: the buffer must match the true need exactly.
    pub exact: bool,
}

impl Bounded {
    /// Message for a frame that needed more.
    pub fn shortage(&self, need: u32) -> String {
        format!("{} need {need}, there are {}", self.what, self.capacity)
    }
}

/// Buffer capacity that a frame's report can change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Capacity {
    /// [`Capacities::crossings`].
    Crossings,
    /// The element of [`Capacities::layers`] for the part with this rank.
    Layers(usize),
    /// [`Capacities::fragments`].
    Fragments,
    /// [`Capacities::sheets`].
    Sheets,
    /// [`Capacities::triangles`].
    Triangles,
}

/// Sizes of bounded buffers for which a plan is recorded. They grow as frames report their needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Capacities {
    /// Crossings per pixel; at most [`Self::MOST_CROSSINGS`].
    pub crossings: Option<u32>,
    /// Layers of each part's sprite, indexed by rank; parts beyond the list have [`Capacities::FIRST_LAYERS`].
    pub layers: Vec<u32>,
    /// Fragments in all lists of a frame.
    pub fragments: Option<u32>,
    /// Fragments in all sheets of a frame: surfaces that are drawn to find where rays cross them.
    pub sheets: Option<u32>,
    /// Triangles that a frame makes from clip-surfaces.
    pub triangles: Option<u32>,
    /// True if reliefs already have pyramids, so that from now on rays use them in any view.
    pub pyramids: bool,
}

impl Capacities {
    /// Initial number of layers of a sprite.
    pub const FIRST_LAYERS: u32 = 2;
    /// Maximum crossings of a pixel for which memory is ever allocated: they fill a lane of 32 words.
    pub const MOST_CROSSINGS: u32 = 1023;
    /// Crossings that a one-word lane can distinguish.
    pub const CROSSINGS_OF_A_WORD: u32 = 31;
    /// Bands of at most this many rows are not split further: if a limit is still exceeded, the cause is not the pixel count.
    pub const FEWEST_ROWS: u32 = 64;

    /// Capacities before any frame has reported its needs.
    pub const UNKNOWN: Self = Self {
        crossings: None,
        layers: Vec::new(),
        fragments: None,
        sheets: None,
        triangles: None,
        pyramids: false,
    };

    /// Layers for the sprite of the part with this rank.
    pub fn layers_of(&self, rank: usize) -> u32 {
        self.layers.get(rank).copied().unwrap_or(Self::FIRST_LAYERS)
    }

    /// Records a frame's need of a bounded structure; returns true if the next frame uses another size for it.
    pub fn learn(&mut self, bounded: &Bounded, need: u32) -> bool {
        let is_right = need <= bounded.capacity && (!bounded.exact || need == bounded.capacity);
        let (false, Some(capacity)) = (is_right, bounded.resizes) else {
            return false;
        };
        let before = self.clone();
        self.set(capacity, need);
        *self != before
    }

    /// Sets a size.
    pub fn set(&mut self, capacity: Capacity, size: u32) {
        match capacity {
            Capacity::Crossings => self.crossings = Some(size.min(Self::MOST_CROSSINGS)),
            Capacity::Layers(rank) => {
                if self.layers.len() <= rank {
                    self.layers.resize(rank + 1, Self::FIRST_LAYERS);
                }
                self.layers[rank] = size.max(1);
            }
            Capacity::Fragments => self.fragments = Some(size),
            Capacity::Sheets => self.sheets = Some(size),
            Capacity::Triangles => self.triangles = Some(size),
        }
    }
}

/// The passes of a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Resources that passes can read and write.
    pub resources: Vec<Resource>,
    /// Passes in order; those of slower clocks come first.
    pub passes: Vec<Pass>,
    /// CPU work for the uploads, beyond packing them.
    pub on_cpu: Vec<CpuStep>,
    /// The layers of the frame: three words per pixel.
    pub layers: Option<ResourceId>,
    /// The picture: one RGBA8 word per pixel.
    pub picture: Option<ResourceId>,
    /// Words in which bounded buffers report their need.
    pub need: Option<ResourceId>,
    /// Further resources made for read-back.
    pub channels: Vec<ResourceId>,
    /// True if rays traverse relief pyramids; sets [`Capacities::pyramids`] for the following frames.
    pub has_pyramids: bool,
    /// Bounded buffers.
    pub bounded: Vec<Bounded>,
}

impl Plan {
    /// Adds a resource.
    pub fn add_resource(&mut self, resource: Resource) -> ResourceId {
        self.resources.push(resource);
        ResourceId(self.resources.len() - 1)
    }

    /// Adds a pass.
    pub fn add_pass(&mut self, pass: Pass) {
        self.passes.push(pass);
    }

    /// The resource behind a handle.
    pub fn resource(&self, id: ResourceId) -> &Resource {
        &self.resources[id.0]
    }

    /// The resource with this name.
    pub fn resource_named(&self, name: &str) -> Option<ResourceId> {
        self.resources
            .iter()
            .position(|r| r.name == name)
            .map(ResourceId)
    }

    /// Returns true if the adapter's rasteriser draws triangles with visible edges: any except the one that covers the picture.
    pub fn draws_triangles(&self) -> bool {
        self.passes.iter().any(|pass| match &pass.work {
            Work::Draw { draws, .. } => draws.iter().any(|d| *d != Draw::full_screen(d.instance)),
            Work::Compute { .. } | Work::ComputeIndirect { .. } => false,
        })
    }

    /// The plan without the resources that no pass, no CPU step and no result of the frame refers to: data
    /// uploaded for optional use by passes is dropped if no pass uses it.
    #[must_use]
    pub fn without_unused(mut self) -> Self {
        let mut is_used = vec![false; self.resources.len()];
        for id in self.mentions_mut() {
            is_used[id.0] = true;
        }
        let mut next = 0;
        let mut numbers = Vec::with_capacity(is_used.len());
        for used in &is_used {
            numbers.push(next);
            next += usize::from(*used);
        }
        for id in self.mentions_mut() {
            id.0 = numbers[id.0];
        }
        let mut id = 0;
        self.resources.retain(|_| {
            id += 1;
            is_used[id - 1]
        });
        self
    }

    fn mentions_mut(&mut self) -> impl Iterator<Item = &mut ResourceId> {
        let of_passes = self.passes.iter_mut().flat_map(Pass::resources_mut);
        let of_cpu = self.on_cpu.iter_mut().flat_map(|w| &mut w.makes);
        let of_frame = [&mut self.layers, &mut self.picture, &mut self.need];
        let of_frame = of_frame.into_iter().flatten().chain(&mut self.channels);
        of_passes.chain(of_cpu).chain(of_frame)
    }

    /// The passes of a clock, in order.
    pub fn passes_on(&self, clock: Clock) -> impl Iterator<Item = &Pass> {
        self.passes.iter().filter(move |pass| pass.clock == clock)
    }

    /// Bytes produced by the passes of a clock: resources of that clock, excluding uploads of the scene itself.
    pub fn bytes_on(&self, clock: Clock) -> u64 {
        self.resources
            .iter()
            .filter(|r| r.clock == clock && !r.is_scene)
            .map(|r| r.shape.bytes())
            .sum()
    }

    /// Bytes of scene data on a clock: meshes, poses, heights, tables.
    pub fn scene_bytes_on(&self, clock: Clock) -> u64 {
        let of_scene = self.resources.iter().filter(|r| r.is_scene);
        let of_clock = of_scene.filter(|r| r.clock == clock);
        of_clock.map(|r| r.shape.bytes()).sum()
    }
}
