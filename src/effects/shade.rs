//! The plain style, which measurements use: lit shading, in one pass over the layers.

use super::FrameOutput;
use super::pixels::over_picture;
use crate::passes::{SceneBuffers, overlap, picture};
use crate::plan::{Binding, Plan, ResourceId};
use crate::shader::Shader;

/// Turns layers into a picture.
pub(super) fn shade(plan: &mut Plan, scene: &SceneBuffers<'_>, layers: ResourceId) -> FrameOutput {
    let picture = picture(plan, scene.input);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.parts.clone(),
        Binding::read("layers", layers),
        Binding::write("picture", picture),
    ];
    let overlap = overlap(plan, scene.input, &mut bindings);
    let about = ("shade", "lit shading turns layers into a picture");
    let shader = Shader::from("passes/shade.wgsl").with(overlap);
    over_picture(plan, scene, about, shader, bindings);
    FrameOutput { layers, picture }
}
