//! Code shared by passes over the pixels of a picture: their buffers, numbers and dispatches.

use super::effect_tiles::EffectTiles;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, BufferRole, Clock, Contents, Pass, Plan, Resource, ResourceId, Work};
use crate::shader::Shader;

/// Buffer with the fraction of light left after occlusion, one f32 per pixel.
pub(crate) const VISIBILITY: &str = "visibility";

/// The pixels of a frame that effects process.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixels<'a> {
    /// The scene that is drawn.
    pub scene: &'a SceneBuffers<'a>,
    /// The tiles that contain the pixels; none if effects process the whole picture.
    pub tiles: Option<EffectTiles>,
}

impl<'a> Pixels<'a> {
    /// All pixels of the picture.
    pub(super) fn all(scene: &'a SceneBuffers<'a>) -> Self {
        Self { scene, tiles: None }
    }

    /// Adds a pass over these pixels. Its shader must use the open module `cutaway::share`.
    pub(super) fn add_pass(
        self,
        plan: &mut Plan,
        (name, help): (&'static str, &'static str),
        shader: impl Into<Shader>,
        mut bindings: Vec<Binding>,
    ) {
        let (share, work) = match self.tiles {
            Some(tiles) => {
                bindings.push(tiles.listed());
                ("lib/share/effect_tiles.wgsl", tiles.shared())
            }
            None => {
                let picture = Work::over(self.scene.input.view.size_px);
                ("lib/share/picture.wgsl", picture)
            }
        };
        let shader = shader.into().with(share);
        plan.add_pass(Pass::new(name, help, shader, bindings, work));
    }
}

/// A buffer with a fixed number of bytes for each pixel.
pub(super) fn per_pixel(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    name: &'static str,
    bytes: u64,
) -> ResourceId {
    let bytes = scene.input.pixel_count() * bytes;
    plan.add_resource(Resource::storage(name, bytes, Clock::Frame))
}

/// The parameters of an effect, as a uniform.
pub(super) fn numbers<T: bytemuck::Pod>(
    plan: &mut Plan,
    name: &'static str,
    numbers: T,
) -> Binding {
    let contents = Contents::from_values(&[numbers]);
    let uniform = Resource::upload(name, BufferRole::Uniform, contents, Clock::Cut);
    Binding::read(name, plan.add_resource(uniform))
}

/// Adds a pass over all pixels, with one invocation each.
pub(super) fn over_picture(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    (name, help): (&'static str, &'static str),
    shader: impl Into<Shader>,
    bindings: Vec<Binding>,
) {
    let work = Work::over(scene.input.view.size_px);
    plan.add_pass(Pass::new(name, help, shader, bindings, work));
}
