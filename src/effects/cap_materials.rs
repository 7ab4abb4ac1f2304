//! Cap materials: images in the (u, v) of clip-surfaces, and solid textures (Trapp and Döllner 2013, sections 4.1 and 4.2, Fig. 11).
//!
//! One pass over the pixels before lighting; 12 bytes a pixel, and 4/3 of the size of the images. Cannot: follow a part that bends, or
//! orient images on cutter faces other than along the scene axes.

use super::pixels::{Pixels, per_pixel};
use super::vertex_paint::vertex_paint;
use crate::passes::SceneBuffers;
use crate::plan::{Binding, BufferRole, Clock, Contents, Plan, Resource, ResourceId, pack};
use crate::scene::PreparedSurface;
use crate::shader::Shader;

/// Writes the material colours into the picture; returns layers with the normals for lighting, or none if nothing has a material.
pub(super) fn cap_materials(
    plan: &mut Plan,
    pixels: Pixels<'_>,
    (layers, picture): (ResourceId, ResourceId),
) -> Option<ResourceId> {
    let scene = pixels.scene;
    let cap_materials = scene.input.model.cap_materials.as_ref()?;
    let is_cut = scene.input.active_cuts.lanes > 0;
    if cap_materials.vertex_paints.is_none() && !(is_cut && cap_materials.has_materials()) {
        return None;
    }
    let [textures, texels] = cap_materials.textures();
    let textures = Resource::upload("textures", BufferRole::Storage, textures, Clock::Cut);
    let texels = Resource::upload("texels", BufferRole::Storage, texels, Clock::Cut);
    let textures = [
        Binding::read("textures", plan.add_resource(textures)),
        Binding::read("texels", plan.add_resource(texels)),
    ];
    let vertex_paints = cap_materials.vertex_paints.as_ref();
    let vertex_paints = vertex_paints
        .map(|vertex_paints| vertex_paint(plan, scene, vertex_paints, (layers, &textures)));
    let lit = per_pixel(plan, scene, "lit_layers", 12);
    let mut table = |name: &'static str, role, contents| {
        let table = Resource::upload(name, role, contents, Clock::Cut);
        Binding::read(name, plan.add_resource(table))
    };
    let planes = planes_of(scene, cap_materials.default_per_unit());
    let planes = Contents::from_values(&[planes]);
    let mut bindings = vec![
        scene.frame.clone(),
        scene.parts.clone(),
        Binding::read("layers", layers),
        table(
            "cap_materials",
            BufferRole::Storage,
            cap_materials.materials(),
        ),
        Binding::write("picture", picture),
        Binding::write("lit_layers", lit),
        table("cap_material_planes", BufferRole::Uniform, planes),
    ];
    bindings.extend(textures);
    let shader = Shader::from("effects/cap_materials.wgsl").with(match vertex_paints {
        Some(_) => "lib/vertex_paint/drawn.wgsl",
        None => "lib/vertex_paint/none.wgsl",
    });
    bindings.extend(
        vertex_paints.map(|vertex_paints| Binding::read("vertex_paint_colors", vertex_paints)),
    );
    let about = (
        "cap materials",
        "materials and vertex paints give caps and surfaces their colours",
    );
    pixels.add_pass(plan, about, shader, bindings);
    Some(lit)
}

/// The texture planes of all clip-surfaces; a clip-surface without a relief gets `default_per_unit` texture repeats per scene unit.
fn planes_of(scene: &SceneBuffers<'_>, default_per_unit: f32) -> pack::CapMaterialPlanes {
    let mut planes: pack::CapMaterialPlanes = bytemuck::Zeroable::zeroed();
    planes.default_per_unit = default_per_unit;
    planes.is_z_up = u32::from(scene.input.model.prepared.up().z > 0.5);
    let rows = planes.planes.iter_mut().zip(&mut planes.per_unit);
    for ((plane, per_unit), surface) in rows.zip(&scene.input.model.prepared.surfaces) {
        *plane = plane_of(surface);
        let [u, v] = match surface.relief {
            Some(_) => surface.map_per_unit.map(|per_unit| per_unit as f32),
            None => [default_per_unit; 2],
        };
        *per_unit = [u, v, 0.0, 0.0];
        planes.count += 1;
    }
    planes
}

/// The texture plane of a clip-surface, in the coordinates of its relief.
fn plane_of(surface: &PreparedSurface) -> pack::CapPlane {
    let row = |direction: glam::DVec3| {
        let offset = -direction.dot(surface.origin);
        direction.extend(offset).as_vec4().to_array()
    };
    let is_cutter = f64::from(u8::from(surface.volume.is_some()));
    pack::CapPlane {
        u_row: row(surface.frame.u_hat),
        v_row: row(surface.frame.v_hat),
        normal: surface.frame.normal.extend(is_cutter).as_vec4().to_array(),
    }
}
