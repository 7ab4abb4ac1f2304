//! A frame by the compute rasteriser: candidates, one pass over the mesh, one decision per pixel, and paint where there is something.
//!
//! Every sample leaves to the inside test what that wants and keeps the nearest kept triangle. With atomics of 64 bits that is
//! one sweep over the triangles. Core WebGPU lacks them: there a first sweep finds the greatest depth-buffer value and a second
//! one the first triangle at it, to the same picture.
//!
//! Cost per frame: that of the screen and the sweeps, and 12 bytes a pixel after what the inside test wants.

use super::layers::{layers, overlap, picture};
use super::resolve::{cap_normal, constants_of_decision};
use super::sweep::{GROUP, groups_along};
use super::{
    AskedCrossings, Begun, Inside, Layered, Rasteriser, Refusal, SceneBuffers, Screen, ScreenOf,
    Store, Sweep,
};
use crate::plan::{Binding, Clock, Pass, Plan, Resource, ResourceId, Work};
use crate::shader::Shader;

/// Workgroups that share the list of pixels to be painted, at most.
const PAINTING_GROUPS: u32 = 1024;

/// Pixels along a side of a tile: `shaders/lib/reach.wgsl`.
const TILE_PX: u32 = 16;

/// The mesh on the screen of a frame, before anything is swept.
#[derive(Clone, Debug)]
pub(crate) struct OnScreen {
    screen: Screen,
    nearest: ResourceId,
    painted: ResourceId,
    picture: Option<ResourceId>,
    /// Between which depths the cut parts lie in each tile, where that was asked for.
    pub(crate) reach: Option<ResourceId>,
}

impl<'a> SceneBuffers<'a> {
    /// Takes the mesh to the screen before clip-surfaces are looked for, and finds in each tile of the picture between which depths the cut
    /// parts lie, where that pays: for rays through reliefs of a mesh that the compute rasteriser takes there anyway. The reason where there
    /// are too many parts.
    pub(crate) fn with_reach(mut self, plan: &mut Plan) -> Result<Self, Refusal> {
        let input = self.input;
        // What lists of sheets begin with is told from the box of the cut solids on.
        let pays =
            input.rasteriser == Rasteriser::Compute && input.has_reliefs() && !input.keeps_list;
        if !pays || input.has_cutters() {
            return Ok(self);
        }
        let [width, height] = input.view.size_px.map(|px| u64::from(px.div_ceil(TILE_PX)));
        let bytes = (1 + width * height) * 8;
        let reach = plan.add_resource(Resource::storage("reach", bytes, Clock::Frame));
        let on_screen = take_to_screen(plan, &self, Begun::Reach(reach))?;
        let screen = &on_screen.screen;
        plan.add_pass(Pass::new(
            "tiles",
            "between which depths the cut parts lie in each tile: rays are followed there alone",
            "passes/rasterise/reach.wgsl",
            vec![
                screen.frame.clone(),
                screen.sweep.clone(),
                screen.drawn_parts.clone(),
                screen.indices.clone(),
                screen.vertices(),
                Binding::update("reach", reach),
            ],
            Work::Compute {
                groups: groups_along(screen.triangle_count),
            },
        ));
        self.on_screen = Some(on_screen);
        Ok(self)
    }
}

/// What the sweeps over the mesh leave.
#[derive(Clone, Debug)]
pub(crate) struct Swept {
    /// The nearest kept triangle of each pixel.
    nearest: ResourceId,
    /// The list of pixels that show something.
    painted: ResourceId,
    /// The picture, all background, where it is made along with the layers.
    picture: Option<ResourceId>,
    /// How the screen of the frame was gone over, and the table of the parts on it.
    sweep: ResourceId,
    drawn_parts: ResourceId,
}

/// Takes all parts to the screen of the frame.
fn take_to_screen(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    begun: Begun<'_>,
) -> Result<OnScreen, Refusal> {
    let input = scene.input;
    let mut of_pixels =
        |name: &str, bytes: u64| plan.add_resource(Resource::storage(name, bytes, Clock::Frame));
    let nearest = of_pixels("nearest", input.pixel_count() * 8);
    let painted = of_pixels("painted", input.pixel_count() * 4 + 4);
    let picture = input.is_plain().then(|| picture(plan, input));
    let mut freshened = vec![
        Binding::write("nearest", nearest),
        Binding::write("painted", painted),
    ];
    freshened.extend(picture.map(|p| Binding::write("picture", p)));
    let of = ScreenOf {
        name: "",
        view: input.view,
        frame: scene.frame.clone(),
        clock: Clock::Frame,
        ranks: &input.relevance.order,
        settles: true,
        fresh: match picture {
            Some(_) => "lib/fresh/picture.wgsl",
            None => "lib/fresh/layers.wgsl",
        },
        freshened,
        begun,
    };
    Ok(OnScreen {
        screen: Screen::record(plan, scene, of)?,
        nearest,
        painted,
        picture,
        reach: match begun {
            Begun::Reach(reach) => Some(reach),
            Begun::Nothing | Begun::Mask(_) => None,
        },
    })
}

/// Rasterises all parts into what an inside test wants, and into the nearest kept triangle of each pixel; the reason where there
/// are too many parts.
pub(super) fn rasterise(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    store: &Store,
    crossings: &AskedCrossings,
) -> Result<Swept, Refusal> {
    let input = scene.input;
    let OnScreen {
        screen,
        nearest,
        painted,
        picture,
        ..
    } = match &scene.on_screen {
        Some(on_screen) => on_screen.clone(),
        None if crossings.are_listed() => take_to_screen(plan, scene, Begun::Nothing)?,
        None => take_to_screen(plan, scene, Begun::Mask(store))?,
    };
    let marking = Sweep {
        name: "mark",
        reason: "each sample marks the crossings it is behind, and keeps its triangle where it is the nearest kept",
        sample: "lib/sample/fused.wgsl",
        store: Some(store),
        crossings: Some(crossings),
        bindings: vec![Binding::update("nearest", nearest)],
        again: false,
    };
    if input.wide_atomics {
        marking.record(plan, scene, &screen);
    } else {
        let marking = Sweep {
            reason: "each sample marks the crossings it is behind, and raises the depth of its pixel where it is kept",
            sample: "lib/sample/raised.wgsl",
            ..marking
        };
        marking.record(plan, scene, &screen);
        let claiming = Sweep {
            name: "claim",
            reason: "the first triangle at the depth of a pixel claims it",
            again: true,
            ..marking
        };
        claiming.record(plan, scene, &screen);
    }
    Ok(Swept {
        nearest,
        painted,
        picture,
        sweep: screen.sweep.resource,
        drawn_parts: screen.drawn_parts.resource,
    })
}

/// Decides what each pixel shows, and paints what is not background.
pub(super) fn decide_and_paint(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    swept: Swept,
    inside: Inside,
    crossings: &AskedCrossings,
) -> Layered {
    let layers = layers(plan, scene.input);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        scene.parts.clone(),
        Binding::read("nearest", swept.nearest),
        Binding::update("painted", swept.painted),
        Binding::write("layers", layers),
    ];
    bindings.extend(inside.bindings);
    bindings.extend(crossings.bindings.iter().cloned());
    let decide = Pass::new(
        "decide",
        "the nearest crossing that is inside a part and enters it is a cap, unless a surface is before it; pixels that show \
         something are listed",
        Shader::from("passes/rasterise/decide.wgsl")
            .with(inside.file)
            .with(crossings.file),
        bindings,
        Work::over(scene.input.view.size_px),
    );
    plan.add_pass(decide.with_constants(constants_of_decision(scene)));
    paint(plan, scene, swept, layers)
}

/// Completes the layers of what is not background, and colours it where that is all that the style asks for.
fn paint(plan: &mut Plan, scene: &SceneBuffers<'_>, swept: Swept, layers: ResourceId) -> Layered {
    let groups = scene.input.pixel_count().div_ceil(u64::from(GROUP));
    let groups = (groups as u32).clamp(1, PAINTING_GROUPS);
    let [vertices, indices] = scene.mesh_in_storage(Clock::Frame);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        vertices,
        indices,
        Binding::read("painted", swept.painted),
        Binding::update("layers", layers),
        Binding::read("sweep", swept.sweep),
        Binding::read("drawn_parts", swept.drawn_parts),
    ];
    let cap_normal = cap_normal(scene, &mut bindings);
    let mut shader = Shader::from("passes/rasterise/paint.wgsl").with(cap_normal);
    let mut reason =
        "the triangle that claimed a pixel gives it part, side and normal, a cap has its own";
    shader = match swept.picture {
        Some(picture) => {
            reason = "the triangle that claimed a pixel gives it part, side and normal, a cap has its own; lit shading colours both";
            let colouring = [scene.parts.clone(), scene.place_of_part.clone()];
            bindings.extend(colouring);
            bindings.push(Binding::update("picture", picture));
            let overlap = overlap(plan, scene.input, &mut bindings);
            shader.with("lib/coloring/lit.wgsl").with(overlap)
        }
        None => shader.with("lib/coloring/none.wgsl"),
    };
    let pass = Pass::new(
        "paint",
        reason,
        shader,
        bindings,
        Work::Compute {
            groups: [groups, 1, 1],
        },
    );
    plan.add_pass(pass.with_constants(vec![("stride", f64::from(groups * GROUP))]));
    Layered {
        layers,
        picture: swept.picture,
    }
}
