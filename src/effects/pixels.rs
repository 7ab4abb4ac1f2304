//! What passes over all pixels of a picture share: their buffers, their numbers, their work.

use crate::passes::SceneBuffers;
use crate::plan::{Binding, Clock, Contents, Pass, Plan, Resource, ResourceId, Role, Work};
use crate::shader::Shader;

/// A buffer of so many bytes for each pixel.
pub(super) fn per_pixel(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    name: &'static str,
    bytes: u64,
) -> ResourceId {
    let bytes = scene.input.pixel_count() * bytes;
    plan.add_resource(Resource::storage(name, bytes, Clock::Frame))
}

/// Numbers of an effect.
pub(super) fn numbers<T: bytemuck::Pod>(
    plan: &mut Plan,
    name: &'static str,
    numbers: T,
) -> Binding {
    let contents = Contents::from_values(&[numbers]);
    let uniform = Resource::upload(name, Role::Uniform, contents, Clock::Cut);
    Binding::read(name, plan.add_resource(uniform))
}

/// Adds a pass that goes over all pixels.
pub(super) fn over_pixels(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    (name, help): (&'static str, &'static str),
    shader: impl Into<Shader>,
    bindings: Vec<Binding>,
) {
    let work = Work::over(scene.input.view.size_px);
    plan.add_pass(Pass::new(name, help, shader, bindings, work));
}
