//! Appearance of a glTF primitive: base colour and its image, and vertex colours. Images always repeat, whatever the wrap mode.
//! `KHR_texture_transform` translates and scales texture coordinates. Its rotation is ignored, with a note.

use cutaway::error::Diagnostic;
use cutaway::scene::{map_channels, srgb_from_linear};
use glam::{Vec2, Vec3};
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::material::AlphaMode;
use gltf::texture::{Info, TextureTransform};
use gltf::{Primitive, Semantic};

use super::super::painted::{Paint, PaintedTriangle};
use super::accessor::{COLORS, COLORS_WITH_ALPHA, PLACES, check};
use super::images::GltfImages;

/// Reads the paint of a primitive.
pub(super) fn of(primitive: &Primitive<'_>, images: &mut GltfImages<'_>) -> Paint {
    let material = primitive.material();
    let texture = material.pbr_metallic_roughness().base_color_texture();
    Paint {
        color: color(primitive),
        image: texture.and_then(|info| images.of_texture(&info.texture())),
        is_transparent: material.alpha_mode() == AlphaMode::Blend,
    }
}

/// Adds the corner attributes of a group's triangles. A fault becomes a note, because it affects only the paint.
pub(super) fn triangles(
    (group, primitive): (u32, &Primitive<'_>),
    triangles: &[[u32; 3]],
    vertices: usize,
    buffers: &[Vec<u8>],
    (painted, notes): (&mut Vec<PaintedTriangle>, &mut Vec<Diagnostic>),
) {
    let material = primitive.material();
    let texture = material.pbr_metallic_roughness().base_color_texture();
    let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
    let mut is_right = |accessor: Option<Accessor<'_>>, wanted| {
        let checked = accessor.map(|accessor| check(&accessor, wanted, buffers));
        if let Some(Err(what)) = &checked {
            notes.push(Diagnostic::note(
                "attribute-left-out",
                format!("{what}: shown without it"),
            ));
        }
        checked.is_some_and(|checked| checked.is_ok())
    };
    let mut places: Option<Vec<Vec2>> = None;
    let transform = texture.as_ref().and_then(Info::texture_transform);
    let moved_set = transform.as_ref().and_then(TextureTransform::tex_coord);
    let set = moved_set.or_else(|| texture.as_ref().map(Info::tex_coord));
    let stored = set.and_then(|set| primitive.get(&Semantic::TexCoords(set)));
    if let Some(set) = set
        && is_right(stored.clone(), PLACES)
    {
        let unit = stored.map_or(1.0, |accessor| stored_unit(&accessor));
        let [scale, offset] = match &transform {
            Some(transform) => [transform.scale(), transform.offset()].map(Vec2::from),
            None => [Vec2::ONE, Vec2::ZERO],
        };
        let placed = |place: [f32; 2]| Vec2::from(place) * unit * scale + offset;
        let finite = |place| Some(placed(place)).filter(|p| p.is_finite());
        let read = reader.read_tex_coords(set);
        places =
            read.map(|read| (read.into_f32().map(|p| finite(p).unwrap_or_default())).collect());
    }
    let mut colors: Option<Vec<Vec3>> = None;
    let accessor = primitive.get(&Semantic::Colors(0));
    let wanted = match accessor.as_ref().map(Accessor::dimensions) {
        Some(Dimensions::Vec4) => COLORS_WITH_ALPHA,
        _ => COLORS,
    };
    if is_right(accessor, wanted) {
        let encoded = |c: [f32; 3]| {
            let linear = Some(Vec3::from(c)).filter(|c| c.is_finite());
            let linear = linear.unwrap_or(Vec3::ONE).clamp(Vec3::ZERO, Vec3::ONE);
            map_channels(linear, srgb_from_linear)
        };
        let read = reader.read_colors(0);
        colors = read.map(|read| read.into_rgb_f32().map(encoded).collect());
    }
    if transform.is_some_and(|transform| transform.rotation() != 0.0) {
        notes.push(Diagnostic::note(
            "texture-rotation-left-out",
            "shown without the rotation of KHR_texture_transform",
        ));
    }
    // Coordinates are not used if some vertices lack them.
    let places = places.filter(|all| all.len() >= vertices);
    let colors = colors.filter(|all| all.len() >= vertices);
    painted.extend(triangles.iter().map(|t| PaintedTriangle {
        group,
        uv: places.as_ref().map(|all| t.map(|i| all[i as usize])),
        colors: colors.as_ref().map(|all| t.map(|i| all[i as usize])),
    }));
}

/// Factor that undoes the reader's normalization of a coordinate. Integers without `normalized`, which `KHR_mesh_quantization` allows, are
/// not scaled.
fn stored_unit(accessor: &Accessor<'_>) -> f32 {
    match accessor.data_type() {
        DataType::U8 if !accessor.normalized() => f32::from(u8::MAX),
        DataType::U16 if !accessor.normalized() => f32::from(u16::MAX),
        _ => 1.0,
    }
}

/// The base colour in sRGB. Returns `None` for a textured material with a white factor, which does not define a colour.
fn color(primitive: &Primitive<'_>) -> Option<Vec3> {
    let material = primitive.material();
    material.index()?;
    let surface = material.pbr_metallic_roughness();
    let [r, g, b, _] = surface.base_color_factor();
    let linear = Vec3::new(r, g, b);
    if surface.base_color_texture().is_some() && linear == Vec3::ONE {
        return None;
    }
    let clamped = linear.clamp(Vec3::ZERO, Vec3::ONE);
    Some(map_channels(clamped, srgb_from_linear))
}
