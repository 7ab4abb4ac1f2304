//! Occlusion of caps by their own relief, from maps computed from its heights (Trapp and Döllner 2013, section 4.2). Unlike a search in
//! the picture, the maps do not depend on the camera, and hidden surfaces occlude too.
//!
//! One pass over the pixels; the maps are computed once per relief, on the cut clock. Cannot: account for other caps or for the mesh.

use crate::effects::pixels::{Pixels, VISIBILITY, numbers, per_pixel};
use crate::passes::SceneBuffers;
use crate::plan::{Binding, BufferRole, Clock, Plan, Resource, ResourceId, pack};
use crate::shader::Shader;

/// Returns true if this pass is needed: the style requests it, and some part is cut by a relief.
pub(in crate::effects) fn is_drawn(scene: &SceneBuffers<'_>) -> bool {
    let model = scene.input.model;
    model.prepared.style.occlusion.relief > 0.0
        && scene.input.active_cuts.lanes > 0
        && model.relief_sky.has_reliefs()
}

/// Fraction of the light that reaches each pixel; includes the occlusion found around the pixel, if the style has any.
pub(in crate::effects) fn relief_sky(
    plan: &mut Plan,
    pixels: Pixels<'_>,
    layers: ResourceId,
    found: Option<ResourceId>,
) -> ResourceId {
    let scene = pixels.scene;
    let model = scene.input.model;
    let style = &model.prepared.style.occlusion;
    let numbers = numbers(
        plan,
        "relief_sky",
        pack::ReliefSky {
            cap: style.cap,
            relief: style.relief,
            padding_a: 0,
            padding_b: 0,
        },
    );
    let maps = model.relief_sky.contents().clone();
    let maps = Resource::upload("relief_sky_maps", BufferRole::Storage, maps, Clock::Cut);
    let maps = plan.add_resource(maps);
    let visibility = per_pixel(plan, scene, VISIBILITY, 4);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.cut_table.clone(),
        Binding::read("heights", maps),
        Binding::read("layers", layers),
        Binding::write("visibility", visibility),
        numbers,
    ];
    let before = match found {
        Some(found) => {
            bindings.push(Binding::read("open_sky", found));
            "lib/sky_before/found.wgsl"
        }
        None => "lib/sky_before/all.wgsl",
    };
    let shader = Shader::from("effects/relief_sky.wgsl").with(before);
    let about = (
        "light reliefs",
        "a relief hides some of the sky from its caps",
    );
    pixels.add_pass(plan, about, shader, bindings);
    visibility
}
