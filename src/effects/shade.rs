//! From what was drawn to layers, and from layers to a picture: the end that every strategy and the exact reference share.

use glam::Vec3;

use super::{Input, Lanes, Model, Refusal, SceneBuffers, Surfaces};
use crate::plan::{
    Binding, Capacities, Clock, Contents, Pass, Plan, Resource, ResourceId, Role, Work,
};
use crate::scene::View;
use crate::shader::Shader;

/// What a frame ends with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    /// Three words per pixel.
    pub layers: ResourceId,
    /// One RGBA8 word per pixel.
    pub picture: ResourceId,
}

/// The layers of the frame: three words per pixel.
pub(super) fn layers(plan: &mut Plan, input: &Input<'_>) -> ResourceId {
    let bytes = input.pixel_count() * 12;
    plan.add_resource(Resource::storage("layers", bytes, Clock::Frame))
}

/// The picture of the frame: one RGBA8 word per pixel.
pub(super) fn picture(plan: &mut Plan, input: &Input<'_>) -> ResourceId {
    let bytes = input.pixel_count() * 4;
    plan.add_resource(Resource::storage("picture", bytes, Clock::Frame))
}

/// Turns what was drawn into layers, and these into a picture.
pub(crate) fn gather(plan: &mut Plan, scene: &SceneBuffers<'_>, surfaces: &Surfaces) -> Picture {
    let layers = layers(plan, scene.input);
    let mut bindings = vec![scene.frame.clone()];
    bindings.extend(surfaces.bindings());
    bindings.push(Binding::write("layers", layers));
    plan.add_pass(Pass::new(
        "gather",
        "layers are what the picture and the comparison read",
        "passes/gather.wgsl",
        bindings,
        Work::over(scene.input.view.size_px),
    ));
    shade(plan, scene, layers)
}

/// Turns layers into a picture.
pub(super) fn shade(plan: &mut Plan, scene: &SceneBuffers<'_>, layers: ResourceId) -> Picture {
    let picture = picture(plan, scene.input);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.parts.clone(),
        Binding::read("layers", layers),
        scene.place_of_part.clone(),
        Binding::write("picture", picture),
    ];
    let overlap = overlap(plan, scene.input, &mut bindings);
    plan.add_pass(Pass::new(
        "shade",
        "lit shading turns layers into a picture",
        Shader::from("passes/shade.wgsl").with(overlap),
        bindings,
        Work::over(scene.input.view.size_px),
    ));
    Picture { layers, picture }
}

/// The plan that shades layers which come from elsewhere, as words: what the exact reference found. The reason where the scene is too
/// much.
pub(crate) fn shading_of(model: &Model, view: &View, layers: &[u32]) -> Result<Plan, Refusal> {
    let capacities = Capacities::UNKNOWN;
    let input = Input::new(model, view, &capacities)?;
    let mut plan = Plan::default();
    let scene = SceneBuffers::unposed(&mut plan, &input, Lanes::none());
    let layers = Contents::from_values(layers);
    let layers = Resource::upload("layers", Role::Storage, layers, Clock::Frame);
    let layers = plan.add_resource(layers);
    let Picture { picture, .. } = shade(&mut plan, &scene, layers);
    plan.picture = Some(picture);
    Ok(plan.without_unused())
}

/// The file that fills `cutaway::overlap`, and what it binds.
pub(super) fn overlap(
    plan: &mut Plan,
    input: &Input<'_>,
    bindings: &mut Vec<Binding>,
) -> &'static str {
    let color = input.model.prepared.interference;
    let Some(color) = color.filter(|_| input.shows_overlaps()) else {
        return "lib/overlap/plain.wgsl";
    };
    let color = Contents::from_values(&[linear_from_srgb(color)]);
    let color = Resource::upload("interference", Role::Uniform, color, Clock::Cut);
    bindings.push(Binding::read("interference", plan.add_resource(color)));
    "lib/overlap/hatched.wgsl"
}

/// The colour as the shader mixes it.
fn linear_from_srgb(color: Vec3) -> [f32; 4] {
    let [r, g, b] = color.to_array().map(|c| {
        if c <= 0.040_45 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    });
    [r, g, b, 1.0]
}
