//! Surface colours of the faces of a half, if they differ from the part colour.
//!
//! Where a face was divided, corner attributes are interpolated between the corners of the original triangle. Colours are interpolated in
//! linear light, as in rendering.

use std::collections::BTreeMap;

use cutaway::scene::{
    Part, TexturedTriangle, VertexPaint, linear_from_srgb, map_channels, srgb_from_linear,
};
use cutaway::slice::Half;
use glam::{DVec3, Vec3};

use super::solid::Solid;

/// The vertex paint of the faces of a half. Returns `None` if the part has no vertex paint or is painted over.
pub(super) fn vertex_paint_of(part: &Part, half: &Half) -> Option<VertexPaint> {
    let vertex_paint = part.mesh.vertex_paint.as_ref();
    let vertex_paint = vertex_paint.filter(|_| !part.material.is_painted_over)?;
    let posed = part.posed_mesh();
    let at = |i: u32| (part.world_from_part).transform_point3(posed.positions[i as usize]);
    let faces = half.sources.iter().zip(&half.mesh.triangles);
    let triangles = faces.map(|(source, face)| {
        let source = *source as usize;
        let corners = part.mesh.triangles[source].map(at);
        let whole = &vertex_paint.triangles[source];
        let shares = face.map(|i| shares(corners, half.mesh.positions[i as usize]));
        TexturedTriangle {
            colors: shares.map(|shares| mixed(whole.colors, shares)),
            uv: shares.map(|[a, b, c]| whole.uv[0] * a + whole.uv[1] * b + whole.uv[2] * c),
            image: whole.image,
        }
    });
    Some(VertexPaint {
        images: vertex_paint.images.clone(),
        triangles: triangles.collect(),
    })
}

/// Barycentric weight of each corner of a triangle at a point inside the triangle.
fn shares(corners: [DVec3; 3], at: DVec3) -> [f32; 3] {
    if let Some(corner) = corners.iter().position(|c| *c == at) {
        return [0, 1, 2].map(|i| f32::from(u8::from(i == corner)));
    }
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let twice = normal.length_squared();
    if twice <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let share = |from: DVec3, to: DVec3| {
        let share = (to - from).cross(at - from).dot(normal) / twice;
        share.clamp(0.0, 1.0) as f32
    };
    let (of_b, of_c) = (share(c, a), share(a, b));
    [(1.0 - of_b - of_c).max(0.0), of_b, of_c]
}

fn mixed(colors: [[u8; 4]; 3], shares: [f32; 3]) -> [u8; 4] {
    if colors == [colors[0]; 3] {
        return colors[0];
    }
    let linear = colors.map(|[r, g, b, _]| {
        map_channels(
            Vec3::from([r, g, b].map(f32::from)) / 255.0,
            linear_from_srgb,
        )
    });
    let sum = linear[0] * shares[0] + linear[1] * shares[1] + linear[2] * shares[2];
    let [r, g, b] = (map_channels(sum, srgb_from_linear) * 255.0)
        .round()
        .to_array();
    [r as u8, g as u8, b as u8, 255]
}

/// A vertex with its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ColoredVertex {
    /// Index of the vertex position.
    pub(super) at: u32,
    pub(super) color: [u8; 4],
}

/// The mesh of a solid with one colour per vertex. If corners at one position differ in colour, each colour gets a separate vertex.
pub(super) fn by_vertex(solid: &Solid<'_>) -> (Vec<ColoredVertex>, Vec<[u32; 3]>) {
    let [own, cap] = [solid.color, solid.cap_color].map(|color| {
        let [r, g, b] = super::solid::bytes_of(color);
        [[r, g, b, 255]; 3]
    });
    let mut vertices = Vec::new();
    let mut numbers: BTreeMap<ColoredVertex, u32> = BTreeMap::new();
    let triangles = (solid.mesh.triangles.iter().enumerate()).map(|(t, corners)| {
        let colors = match solid.vertex_paint.as_ref() {
            _ if t >= solid.faces => cap,
            Some(vertex_paint) => vertex_paint.triangles[t].colors,
            None => own,
        };
        [0, 1, 2].map(|i| {
            let vertex = ColoredVertex {
                at: corners[i],
                color: colors[i],
            };
            *numbers.entry(vertex).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    (vertices, triangles)
}
