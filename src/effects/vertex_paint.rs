//! Vertex paints: vertex colours and images from model files, drawn on the surfaces that the layers show.
//!
//! One draw of the painted parts, with its own depth buffer; 12 bytes a pixel. With any strategy and any cuts, each pixel gets the colour
//! of the surface at its visible depth. Cannot: paint caps, or distinguish surfaces of one part that are closer to each other than a
//! thousandth of their distance from the eye.

use crate::passes::DrawPass;
use crate::passes::{SceneBuffers, Surfaces, VertexPaints};
use crate::plan::{
    Binding, BufferRole, Clock, Contents, Draw, Plan, Resource, ResourceId, Vertices,
};

/// Draws the paints into a texture: the first word is the colour as RGBA8 in sRGB, or 0 where there is no paint.
pub(super) fn vertex_paint(
    plan: &mut Plan,
    scene: &SceneBuffers<'_>,
    vertex_paints: &VertexPaints,
    (layers, textures): (ResourceId, &[Binding; 2]),
) -> ResourceId {
    let mut upload = |name: &'static str, role, contents| {
        plan.add_resource(Resource::upload(name, role, contents, Clock::Solid))
    };
    let rows = upload(
        "vertex_paint_rows",
        BufferRole::Storage,
        Contents::from_values(&vertex_paints.rows),
    );
    let words = upload(
        "vertex_paint_words",
        BufferRole::Storage,
        vertex_paints.words.clone(),
    );
    let indices = upload(
        "vertex_paint indices",
        BufferRole::Index,
        vertex_paints.indices.clone(),
    );
    let [vertices, _] = scene.mesh_in_storage(Clock::Solid);
    let mut bindings = vec![
        scene.frame.clone(),
        Binding::read("layers", layers),
        Binding::read("vertex_paint_rows", rows),
        Binding::read("vertex_paint_words", words),
        vertices,
    ];
    bindings.extend(textures.iter().cloned());
    let draws = (0..)
        .zip(&vertex_paints.triangles)
        .map(|(row, triangles)| Draw {
            indices: 0..triangles * 3,
            base_vertex: 0,
            vertex_count: triangles * 3,
            instance: row,
            arguments: None,
        });
    let mut drawn = Surfaces::named(plan, scene, ["vertex_paint_colors", "vertex_paint_depth"]);
    let pass = DrawPass {
        name: "draw vertex paints".to_owned(),
        reason: "surfaces have vertex colours or images from model files".to_owned(),
        shader: "effects/vertex_paint.wgsl".into(),
        bindings,
        constants: Vec::new(),
        vertices: Vertices::None,
        indices,
        draws: draws.collect(),
    };
    drawn.draw(plan, pass);
    drawn.words
}
