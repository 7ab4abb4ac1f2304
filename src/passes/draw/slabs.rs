//! Marks lanes by the slabs of clip-surfaces before crossings are listed, so that rays are walked only where a crossing can matter.
//!
//! A clip-surface lies in a slab: between the planes at its least and its greatest height. A sample outside of a slab is kept or removed by
//! the side it is on, and lies in front of all crossings there or behind all of them. So one sweep leaves for each pixel the parity of the
//! samples behind each slab, the nearest sample that is kept for certain, and a list of the samples within slabs. A pixel is settled if no
//! sample is within a slab and all parities are even, or if its nearest sample is in front of all other slabs. Only in the other pixels are
//! crossings computed: each begins with the parity of its slab, and the samples within the slab are added. Layers and picture are those of
//! the full lists, as long as these do not overflow: `docs/algorithm.md` has the proof.
//!
//! Cost: 4 bytes per pixel for the list of pixels, 16 per sample within a slab, for which there are 4 bytes per pixel at first. Only for up
//! to eight clip-surfaces, reliefs among them. Not for cutters, parts with counts, or preclassified triangles.

use super::rasterise::{Swept, take_to_screen};
use super::share::Share;
use super::solid::NearestKept;
use super::store::Store;
use super::sweep::SweepPasses;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::{Crossings, fours_file};
use crate::passes::frame::dispatch::GROUP;
use crate::passes::frame::input::Input;
use crate::passes::frame::need::{NEED_OF_FRAGMENTS, need};
use crate::passes::frame::on_screen::OnScreen;
use crate::passes::frame::rasteriser::Rasteriser;
use crate::passes::frame::refusal::Refusal;
use crate::passes::frame::touched::tiles_in;
use crate::plan::pack::MOST_PLANES;
use crate::plan::{
    Access, Arguments, Binding, Bounded, Capacities, Capacity, Clock, DISPATCH_ARGUMENT_BYTES,
    Pass, Plan, Resource, ResourceId, Work,
};
use crate::shader::Shader;

/// Bits of a lane that are not about one slab, besides the bit of the total, and bits about each: `shaders/lib/inside_tests/slab_bits.wgsl`.
const BITS_OF_ALL_SLABS: u32 = 1;
const BITS_OF_SLAB: u32 = 2;
/// Bytes of a listed sample, and before the first: `shaders/lib/lists/within_list.wgsl`.
const SAMPLE_BYTES: u64 = 16;
/// Share of the height of the cut parts' box from which a slab is thick.
const THICK: f64 = 0.25;
/// Pixels for each sample that the list holds at first.
const PIXELS_PER_SAMPLE: u64 = 4;
/// Most samples of the list. If a frame needs more, the crossings of all pixels are listed.
const MOST_SAMPLES: u32 = 1 << 22;

/// Lanes that are marked by slabs, and the lists of what is left.
#[derive(Clone, Debug)]
pub(crate) struct SlabMarks {
    on_screen: OnScreen,
    mask: ResourceId,
    within: ResourceId,
    /// The pixels whose crossings matter.
    pub(crate) pixels: PixelList,
}

/// A list of pixels whose crossings matter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelList {
    list: ResourceId,
    /// Numbers of workgroups, over the pixels and over the samples within slabs.
    groups: ResourceId,
}

impl PixelList {
    /// Binding for passes over the listed pixels.
    pub(crate) fn binding(self) -> Binding {
        Binding::read("pixel_list", self.list)
    }

    /// A dispatch whose workgroups share the listed pixels.
    pub(crate) fn shared(self) -> Work {
        over_listed(self.groups, 0)
    }
}

fn over_listed(groups: ResourceId, which: u64) -> Work {
    let arguments = Arguments {
        resource: groups,
        offset: which * DISPATCH_ARGUMENT_BYTES,
    };
    Work::ComputeIndirect { arguments }
}

/// Returns true if the slab holds a large part of the box of the cut parts, and thus many samples.
fn has_thick_slab(input: &Input<'_>) -> bool {
    let active_cuts = &input.active_cuts;
    active_cuts.surfaces.iter().any(|number| {
        let surface = &input.model.prepared.surfaces[*number];
        let [low, high] = surface.heights_of(&active_cuts.cut_box);
        let [least, greatest] = surface.slab();
        (high.min(-least) - low.max(-greatest)) > THICK * (high - low)
    })
}

/// The capacity of lists of crossings, possibly raised so that lanes have room for the bits of slabs; `None` where lanes cannot be marked by
/// slabs.
pub(crate) fn capacity_for_slabs(input: &Input<'_>, capacity: u32) -> Option<u32> {
    let count = input.active_cuts.surfaces.len();
    let capacity = capacity.max(BITS_OF_ALL_SLABS + BITS_OF_SLAB * count as u32);
    let samples = input.capacities.fragments.unwrap_or(0);
    (input.rasteriser == Rasteriser::Compute
        && !input.keeps_list
        && input.preclassified.is_none()
        && count <= MOST_PLANES
        && input.has_reliefs()
        && !input.has_cutters()
        && !has_thick_slab(input)
        && capacity <= Capacities::CROSSINGS_OF_A_WORD
        && samples <= MOST_SAMPLES)
        .then_some(capacity)
}

/// Records the sweep that marks lanes by slabs, and the list of the pixels whose crossings matter.
pub(crate) fn mark_by_slabs(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: &Store,
    mask: ResourceId,
) -> Result<SlabMarks, Refusal> {
    let input = scene.input;
    let pixels = input.pixel_count();
    // The number of samples varies from view to view: some room saves new buffers.
    let needed = input.capacities.fragments.map(|n| n + n / 4);
    let capacity = needed.unwrap_or((pixels / PIXELS_PER_SAMPLE) as u32);
    let capacity = capacity.max(GROUP);
    let bytes = (u64::from(capacity) + 1) * SAMPLE_BYTES;
    let within = plan.add_resource(Resource::storage("within_list", bytes, Clock::Frame));
    // A count, two words per tile, a word per pixel.
    let words = 1 + 2 * u64::from(tiles_in(input.view.size_px)) + pixels;
    let list = Resource::storage("pixel_list", 4 * words, Clock::Frame);
    let list = plan.add_resource(list);
    plan.bounded.push(Bounded {
        what: "samples within the slabs of reliefs".to_owned(),
        slot: NEED_OF_FRAGMENTS,
        capacity,
        resizes: Some(Capacity::Fragments),
        exact: false,
    });
    let groups = Resource::arguments("listed_groups", 2 * DISPATCH_ARGUMENT_BYTES, Clock::Frame);
    let groups = plan.add_resource(groups);
    let lists = Some([
        Binding::write("listed_groups", groups),
        Binding::write("within_list", within),
        Binding::write("pixel_list", list),
    ]);
    let on_screen = take_to_screen(plan, scene, Some(store), Share::of_store(store), lists)?;
    let marks = SlabMarks {
        pixels: PixelList { list, groups },
        on_screen,
        mask,
        within,
    };
    let reason = "each sample marks its lane by the slabs in front of it, and is listed if it is within one; the nearest that is kept for certain stays";
    let sweep = marks.sweep(scene, "mark", reason, false);
    sweep.record(plan, scene, &marks.on_screen.screen);
    marks.settle(plan, scene);
    Ok(marks)
}

impl SlabMarks {
    fn sweep<'a>(
        &self,
        scene: &SceneBuffers<'_>,
        name: &'a str,
        reason: &'a str,
        again: bool,
    ) -> SweepPasses<'a> {
        SweepPasses {
            name,
            reason,
            sample: match scene.input.wide_atomics {
                true => "lib/sample/slabs_fused.wgsl",
                false => "lib/sample/slabs_raised.wgsl",
            },
            more_files: vec![fours_file(scene.input)],
            store: None,
            crossings: None,
            bindings: vec![
                scene.cut_table.clone(),
                scene.ray_table.clone(),
                Binding::update("nearest", self.on_screen.nearest),
                Binding::update("mask", self.mask),
                Binding::update("within_list", self.within),
            ],
            touched: Some(self.on_screen.touched),
            finds_depths: true,
            again,
        }
    }

    /// Writes the layers of the pixels in which no crossing matters, and lists the others.
    fn settle(&self, plan: &mut Plan, scene: &SceneBuffers<'_>) {
        let bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            scene.ray_table.clone(),
            Binding::read("mask", self.mask),
            Binding::update("layers", self.on_screen.layers),
            Binding::read("nearest", self.on_screen.nearest),
            self.on_screen.touched.binding(Access::Read),
            Binding::update("pixel_list", self.pixels.list),
            Binding::update("listed_groups", self.pixels.groups),
            Binding::read("within_list", self.within),
        ];
        let pass = Pass::new(
            "settle",
            "no crossing matters without a sample within its slab and with an even number behind it, or behind a nearer surface; \
             the other pixels are listed",
            Shader::from("passes/rasterise/settle.wgsl")
                .with("lib/share/touched.wgsl")
                .with(fours_file(scene.input)),
            bindings,
            self.on_screen.touched.shared(),
        );
        plan.add_pass(pass.with_constants(vec![scene.lanes.constant()]));
    }

    /// Records the passes that decide the samples within slabs by the crossings of the listed pixels.
    pub(crate) fn finish(
        self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        crossings: &Crossings,
    ) -> NearestKept {
        if scene.input.wide_atomics {
            self.take_within(plan, scene, crossings, "lib/keeping/wide.wgsl", true);
        } else {
            self.take_within(plan, scene, crossings, "lib/keeping/raise.wgsl", true);
            let reason = "the first triangle at a pixel's depth claims the pixel";
            let sweep = self.sweep(scene, "claim", reason, true);
            sweep.record(plan, scene, &self.on_screen.screen);
            self.take_within(plan, scene, crossings, "lib/keeping/claim.wgsl", false);
            self.add_triangles(plan, scene);
        }
        NearestKept::Swept(Swept::of(self.on_screen, Some(self.pixels)))
    }

    /// Adds the triangles that claimed settled pixels.
    fn add_triangles(&self, plan: &mut Plan, scene: &SceneBuffers<'_>) {
        let bindings = vec![
            scene.frame.clone(),
            Binding::update("layers", self.on_screen.layers),
            Binding::read("nearest", self.on_screen.nearest),
            self.on_screen.touched.binding(Access::Read),
        ];
        plan.add_pass(Pass::new(
            "settled",
            "settled pixels show the triangles that claimed them",
            Shader::from("passes/rasterise/settled.wgsl").with("lib/share/touched.wgsl"),
            bindings,
            self.on_screen.touched.shared(),
        ));
    }

    fn take_within(
        &self,
        plan: &mut Plan,
        scene: &SceneBuffers<'_>,
        crossings: &Crossings,
        keeping: &'static str,
        marks: bool,
    ) {
        let screen = &self.on_screen.screen;
        let need = need(plan, scene.input, Clock::Frame);
        let mut bindings = vec![
            scene.frame.clone(),
            scene.cut_table.clone(),
            screen.drawn_parts.clone(),
            Binding::read("layers", self.on_screen.layers),
            Binding::update("mask", self.mask),
            Binding::update("nearest", self.on_screen.nearest),
            Binding::read("within_list", self.within),
            Binding::update("need", need),
        ];
        let crossings = crossings.asked();
        bindings.extend(crossings.bindings.iter().cloned());
        let pass = Pass::new(
            match marks {
                true => "within",
                false => "claim within",
            },
            "samples within slabs mark the crossings there that are in front of them, and may be the nearest kept",
            Shader::from("passes/rasterise/within.wgsl")
                .with_all(crossings.files())
                .with(keeping),
            bindings,
            over_listed(self.pixels.groups, 1),
        );
        plan.add_pass(pass.with_constants(vec![("marks", f64::from(u8::from(marks)))]));
    }
}
