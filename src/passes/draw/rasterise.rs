//! Draws a frame with the compute rasteriser: finds touched tiles, sweeps the mesh, decides each pixel, and paints covered pixels.
//!
//! Every sample stores what the inside test needs and keeps the nearest kept triangle. With 64-bit atomics that is
//! one sweep over the triangles. Core WebGPU lacks them: there a first sweep finds the greatest depth-buffer value and a second
//! one the first triangle at that value, which gives the same picture.
//!
//! Only pixels in touched tiles are processed ([`Touched`]).
//!
//! Cost per frame: transforming the mesh, the sweeps, and 12 bytes per pixel in addition to the inside test's storage.

use super::layers::{Layered, layers, overlap, picture};
use super::resolve::{Inside, cap_normal, constants_of_decision};
use super::screen::{Fresh, ScreenOf};
use super::share::Share;
use super::slabs::PixelList;
use super::store::Store;
use super::sweep::SweepPasses;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::crossings::CrossingSource;
use crate::passes::frame::dispatch::groups_along;
use crate::passes::frame::on_screen::{OnScreen, ScreenMesh};
use crate::passes::frame::rasteriser::Rasteriser;
use crate::passes::frame::refusal::Refusal;
use crate::passes::frame::touched::Touched;
use crate::plan::{Access, Binding, Clock, Pass, Plan, Resource, ResourceId, Work};
use crate::shader::Shader;

impl<'a> SceneBuffers<'a> {
    /// Transforms the mesh to the screen before crossings are computed, so that only touched tiles compute them; also prepares pixels for
    /// fragments. `to_come` describes the crossing lists made later. Does nothing for the GPU's own rasteriser, or where lists must cover
    /// all pixels, as they must for hosts. Returns the reason if there are too many parts.
    pub(crate) fn on_screen_first(
        mut self,
        plan: &mut Plan,
        store: &Store,
        to_come: &CrossingSource,
    ) -> Result<Self, Refusal> {
        let input = self.input;
        if input.rasteriser == Rasteriser::Compute && !input.keeps_list {
            let share = Share::of_crossings(&self, store, to_come);
            self.on_screen = Some(take_to_screen(plan, &self, Some(store), share, None)?);
        }
        Ok(self)
    }
}

/// Results of the sweeps over the mesh.
#[derive(Clone, Debug)]
pub(crate) struct Swept {
    /// The nearest kept triangle of each pixel.
    nearest: ResourceId,
    /// The layers, and the picture if it is made along with them. Both hold only background at this point.
    layers: ResourceId,
    picture: Option<ResourceId>,
    touched: Touched,
    /// File that fills `cutaway::rows`; then the frame screen's sweep parameters, and its table of drawn parts.
    rows: &'static str,
    sweep: ResourceId,
    drawn_parts: ResourceId,
    /// The pixels that remain to be decided, if the others are settled.
    undecided: Option<PixelList>,
}

impl Swept {
    pub(super) fn of(on_screen: OnScreen, undecided: Option<PixelList>) -> Self {
        let screen = &on_screen.screen;
        Self {
            rows: screen.rows(),
            sweep: screen.sweep.resource,
            drawn_parts: screen.drawn_parts.resource,
            nearest: on_screen.nearest,
            layers: on_screen.layers,
            picture: on_screen.picture,
            touched: on_screen.touched,
            undecided,
        }
    }
}

/// Transforms all parts to the frame's screen. `store` is given if no other pass prepares the pixels of that fragment store; `slab_lists`
/// if the first sweep marks by slabs: the bindings of its lists, to be emptied.
pub(super) fn take_to_screen(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: Option<&Store>,
    share: Share,
    slab_lists: Option<[Binding; 3]>,
) -> Result<OnScreen, Refusal> {
    let input = scene.input;
    let nearest = Resource::storage("nearest", input.pixel_count() * 8, Clock::Frame);
    let nearest = plan.add_resource(nearest);
    let layers = layers(plan, input);
    let picture = input.is_plain().then(|| picture(plan, input));
    let touched = Touched::of_picture(plan, input.view.size_px);
    let kind = match picture {
        Some(_) => "lib/blank/picture.wgsl",
        None => "lib/blank/layers.wgsl",
    };
    let mut bindings = vec![
        scene.frame.clone(),
        touched.binding(Access::Read),
        Binding::write("nearest", nearest),
        Binding::write("layers", layers),
    ];
    bindings.extend(picture.map(|p| Binding::write("picture", p)));
    let shader = Shader::from("passes/rasterise/blank.wgsl").with(kind);
    let shader = match store {
        Some(store) => {
            bindings.extend(store.begun());
            shader.with("lib/begun/store.wgsl").with(store.file)
        }
        None => shader.with("lib/begun/nothing.wgsl"),
    };
    plan.add_pass(Pass::new(
        "blank",
        "resets the tiles touched by the previous frame to background; all other tiles are still background",
        shader,
        bindings,
        touched.shared(),
    ));
    let by_slabs = slab_lists.is_some();
    let mut emptied = vec![touched.binding(Access::ReadWrite)];
    emptied.extend(slab_lists.into_iter().flatten());
    let of = ScreenOf {
        name: "",
        view: input.view,
        frame: scene.frame.clone(),
        clock: Clock::Frame,
        ranks: &input.active_cuts.order,
        classifies: true,
        share,
        fresh: Fresh {
            files: match by_slabs {
                true => vec!["lib/fresh/slabs.wgsl", kind],
                false => vec!["lib/fresh/tiles.wgsl", kind],
            },
            bindings: emptied,
            items: touched.tile_count(),
        },
    };
    let mut screen = ScreenMesh::record(plan, scene, of)?;
    // No pass reads pixels before the sweep.
    let by_sweep =
        input.active_cuts.lanes == 0 || by_slabs || (store.is_some() && input.needs_no_list());
    if !by_sweep {
        find_tiles(plan, &screen, touched);
        find_closing_tiles(plan, scene, touched, true);
        screen.is_queued = true;
    }
    Ok(OnScreen {
        screen,
        nearest,
        layers,
        picture,
        touched,
    })
}

/// Finds the touched tiles: one pass takes each small triangle whole and queues the large ones, another takes their pieces.
fn find_tiles(plan: &mut Plan, screen: &ScreenMesh, touched: Touched) {
    let bindings = |queue_access| {
        let mut all = screen.bindings();
        all.extend([
            touched.binding(Access::ReadWrite),
            screen.queue(queue_access),
        ]);
        all
    };
    let pass = Pass::new(
        "tiles",
        "finds the touched tiles and the depth range of the cut parts in each; only touched tiles are processed",
        Shader::from("passes/rasterise/tiles.wgsl").with(screen.rows()),
        bindings(Access::ReadWrite),
        Work::Compute {
            groups: groups_along(screen.triangle_count),
        },
    );
    plan.add_pass(pass.with_constants(screen.share.constants().into()));
    screen.count_pieces(plan);
    plan.add_pass(Pass::new(
        "large tiles",
        "the same for triangles with many samples",
        Shader::from("passes/rasterise/large_tiles.wgsl").with(screen.rows()),
        bindings(Access::Read),
        screen.over_pieces(),
    ));
}

/// Finds the tiles in which open parts may hold a point of a clip-surface although no triangle covers them. `has_lists` states that crossings will
/// be listed, in touched tiles and at their depths.
fn find_closing_tiles(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    touched: Touched,
    has_lists: bool,
) {
    let Some(closings) = &scene.closings else {
        return;
    };
    let bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        closings.clone(),
        touched.binding(Access::ReadWrite),
    ];
    let pass = Pass::new(
        "closing tiles",
        "touches the tiles in which winding numbers may be large although no triangle covers them",
        Shader::from("passes/rasterise/closing_tiles.wgsl"),
        bindings,
        Work::Compute {
            groups: groups_along(touched.tile_count()),
        },
    );
    let closing_count = scene.input.closed_parts().len() as f64;
    plan.add_pass(pass.with_constants(vec![
        ("closing_count", closing_count),
        ("has_lists", f64::from(u8::from(has_lists))),
        (
            "near_inside",
            f64::from(u8::from(scene.input.active_cuts.near_inside)),
        ),
    ]));
}

/// Rasterises all parts: fills the inside test's store, and finds the nearest kept triangle of each pixel. Returns the reason if there are
/// too many parts.
pub(crate) fn rasterise(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: &Store,
    crossings: &CrossingSource,
) -> Result<Swept, Refusal> {
    let input = scene.input;
    let on_screen = match &scene.on_screen {
        Some(on_screen) => on_screen.clone(),
        None => {
            let share = Share::of_crossings(scene, store, crossings);
            take_to_screen(plan, scene, None, share, None)?
        }
    };
    let OnScreen {
        screen,
        nearest,
        touched,
        ..
    } = &on_screen;
    let marking = SweepPasses {
        name: "mark",
        reason: "each sample marks the crossings in front of it, and stores its triangle if that is the nearest kept one",
        sample: "lib/sample/fused.wgsl",
        more_files: Vec::new(),
        store: Some(store),
        crossings: Some(crossings),
        bindings: vec![Binding::update("nearest", *nearest)],
        touched: (!screen.is_queued).then_some(*touched),
        finds_depths: false,
        again: false,
    };
    if input.wide_atomics {
        marking.record(plan, scene, screen);
    } else {
        let marking = SweepPasses {
            reason: "each sample marks the crossings in front of it, and raises its pixel's depth if the sample is kept",
            sample: "lib/sample/raised.wgsl",
            ..marking
        };
        marking.record(plan, scene, screen);
        let claiming = SweepPasses {
            name: "claim",
            reason: "the first triangle at a pixel's depth claims the pixel",
            again: true,
            ..marking
        };
        claiming.record(plan, scene, screen);
    }
    if !screen.is_queued {
        find_closing_tiles(plan, scene, *touched, false);
    }
    Ok(Swept::of(on_screen, None))
}

/// Decides what each pixel shows, and paints the pixels that are not background.
pub(crate) fn decide_and_paint(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    swept: Swept,
    inside: Inside,
    crossings: &CrossingSource,
) -> Layered {
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        Binding::read("nearest", swept.nearest),
        Binding::update("layers", swept.layers),
    ];
    let (shader, of_pixels, work) = match swept.undecided {
        Some(list) => {
            let shader = Shader::from("passes/rasterise/decide_listed.wgsl");
            (shader, list.binding(), list.shared())
        }
        None => {
            let shader = Shader::from("passes/rasterise/decide.wgsl");
            let tiles = swept.touched.binding(Access::Read);
            (
                shader.with("lib/share/touched.wgsl"),
                tiles,
                swept.touched.shared(),
            )
        }
    };
    bindings.push(of_pixels);
    bindings.extend(inside.bindings);
    bindings.extend(crossings.bindings.iter().cloned());
    let decide = Pass::new(
        "decide",
        "the nearest crossing that is inside a part and enters it is a cap, unless a surface is in front of it",
        shader.with_all(&inside.files).with_all(crossings.files()),
        bindings,
        work,
    );
    plan.add_pass(decide.with_constants(constants_of_decision(scene)));
    paint(plan, scene, swept, crossings)
}

/// Completes the layers of non-background pixels, and also colours these pixels if the style needs no other pass.
fn paint(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    swept: Swept,
    crossings: &CrossingSource,
) -> Layered {
    let [vertices, indices] = scene.mesh_in_storage(Clock::Frame);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        vertices,
        indices,
        swept.touched.binding(Access::Read),
        Binding::update("layers", swept.layers),
        Binding::read("sweep", swept.sweep),
        Binding::read("drawn_parts", swept.drawn_parts),
    ];
    let cap_normal = cap_normal(scene, &mut bindings);
    let mut shader = Shader::from("passes/rasterise/paint.wgsl")
        .with("lib/share/touched.wgsl")
        .with(swept.rows)
        .with(crossings.surfaces_file)
        .with(cap_normal);
    let mut reason =
        "part, side and normal come from the triangle that claimed the pixel, or from a cap";
    shader = match swept.picture {
        Some(picture) => {
            reason = "part, side and normal come from the triangle that claimed the pixel, or from a cap; lit shading colours both";
            bindings.push(scene.parts.clone());
            bindings.push(Binding::update("picture", picture));
            let overlap = overlap(plan, scene.input, &mut bindings);
            shader.with("lib/coloring/lit.wgsl").with(overlap)
        }
        None => shader.with("lib/coloring/none.wgsl"),
    };
    let work = swept.touched.shared();
    plan.add_pass(Pass::new("paint", reason, shader, bindings, work));
    Layered {
        layers: swept.layers,
        picture: swept.picture,
    }
}
