//! Layers: what each pixel shows. Every frame produces them before it becomes a picture.

use super::surface::Surfaces;
use crate::passes::frame::buffers::SceneBuffers;
use crate::passes::frame::input::Input;
use crate::plan::{Binding, BufferRole, Clock, Contents, Pass, Plan, Resource, ResourceId, Work};
use crate::scene::{linear_from_srgb, map_channels};

/// Completed layers of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layered {
    /// Three words per pixel.
    pub layers: ResourceId,
    /// The picture, if the passes that completed the layers also coloured the picture.
    pub picture: Option<ResourceId>,
}

/// The layers of the frame: three words per pixel.
pub(crate) fn layers(plan: &mut Plan, input: &Input<'_>) -> ResourceId {
    layers_named(plan, input, "layers")
}

fn layers_named(plan: &mut Plan, input: &Input<'_>, name: &'static str) -> ResourceId {
    let bytes = input.pixel_count() * 12;
    plan.add_resource(Resource::storage(name, bytes, Clock::Frame))
}

/// The picture of the frame: one RGBA8 word per pixel.
pub(crate) fn picture(plan: &mut Plan, input: &Input<'_>) -> ResourceId {
    let bytes = input.pixel_count() * 4;
    plan.add_resource(Resource::storage("picture", bytes, Clock::Frame))
}

/// Turns the drawn surfaces into layers.
pub(crate) fn gather(plan: &mut Plan, scene: &SceneBuffers<'_>, surfaces: &Surfaces) -> Layered {
    Layered {
        layers: gather_into(plan, scene, surfaces, ["layers", "gather"]),
        picture: None,
    }
}

/// Turns the drawn surfaces into layers, with given names for the buffer and the pass.
pub(crate) fn gather_into(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    surfaces: &Surfaces,
    [name, pass]: [&'static str; 2],
) -> ResourceId {
    let layers = layers_named(plan, scene.input, name);
    let mut bindings = vec![scene.frame.clone()];
    bindings.extend(surfaces.bindings());
    bindings.push(Binding::write("layers", layers));
    plan.add_pass(Pass::new(
        pass,
        "layers are what the picture and the comparison read",
        "passes/gather.wgsl",
        bindings,
        Work::over(scene.input.view.size_px),
    ));
    layers
}

/// The file that fills `cutaway::overlap`, and its bindings.
pub(crate) fn overlap(
    plan: &mut Plan,
    input: &Input<'_>,
    bindings: &mut Vec<Binding>,
) -> &'static str {
    let color = input.model.prepared.interference;
    let Some(color) = color.filter(|_| input.shows_overlaps()) else {
        return "lib/overlap/plain.wgsl";
    };
    let linear = map_channels(color, linear_from_srgb).extend(1.0).to_array();
    let color = Contents::from_values(&[linear]);
    let color = Resource::upload("interference", BufferRole::Uniform, color, Clock::Cut);
    bindings.push(Binding::read("interference", plan.add_resource(color)));
    "lib/overlap/hatched.wgsl"
}
