//! The plain end: lit shading, one pass over the layers. What measurements take.

use super::Picture;
use crate::passes::{SceneBuffers, overlap, picture};
use crate::plan::{Binding, Pass, Plan, ResourceId, Work};
use crate::shader::Shader;

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
