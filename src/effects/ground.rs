//! Ground: the shadow of what is kept, where nothing else is. One pass over the pixels, with a look-up where there is background.
//!
//! The map is made beforehand ([`GroundShadow`](crate::passes::GroundShadow)); a model that was given none has no shadow. Cannot: lie on the
//! model itself, and strokes around it are a little darker in it.

use super::pixels::over_picture;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, Clock, Plan, Resource, ResourceId, Role};

/// Darkens the ground in a picture of layers.
pub(super) fn ground(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    (layers, picture): (ResourceId, ResourceId),
) {
    let model = scene.input.model;
    let Some(shadow) = &model.ground else {
        return;
    };
    let mut upload = |name, role, contents: &crate::plan::Contents| {
        let resource = Resource::upload(name, role, contents.clone(), Clock::Cut);
        Binding::read(name, plan.add_resource(resource))
    };
    let numbers = upload("ground", Role::Uniform, &shadow.numbers);
    let darkness = upload("ground_darkness", Role::Storage, &shadow.darkness);
    let about = ("shade ground", "what is kept hides light from the ground");
    over_picture(
        plan,
        scene,
        about,
        "effects/ground.wgsl",
        vec![
            scene.frame.clone(),
            Binding::read("layers", layers),
            Binding::update("picture", picture),
            darkness,
            numbers,
        ],
    );
}
