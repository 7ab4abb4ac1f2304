//! Ground: the shadow that the kept parts cast on the ground. One pass over the pixels, with one look-up per background pixel.
//!
//! The map is computed beforehand ([`GroundShadow`](crate::passes::GroundShadow)); a model without a map has no shadow. Cannot: cast
//! shadows on the model itself. Strokes in the shadow are slightly darker.

use super::pixels::over_picture;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, BufferRole, Clock, Plan, Resource, ResourceId};

/// Darkens the background where the ground is in shadow.
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
    let numbers = upload("ground", BufferRole::Uniform, &shadow.numbers);
    let darkness = upload("ground_darkness", BufferRole::Storage, &shadow.darkness);
    let about = ("shade ground", "the kept parts cast a shadow on the ground");
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
