//! Joins solids that a file splits across several nodes. Static open meshes become one part if they close each other.
//!
//! Edges are equal if their ends are equal in f32. Meshes that share edges are only joined if the result is closed.
//!
//! Cost: one sort of the open edges of all parts.

use std::sync::Arc;

use cutaway::error::Diagnostic;
use cutaway::scene::Edges;
use cutaway::scene::topology::Sets;
use cutaway::scene::weld::{has_three, renumber, weld};
use cutaway::scene::{Material, Mesh, Texture, TexturedTriangle, VertexPaint};
use glam::{DAffine3, Vec3};

use super::super::Placed;

/// An end of an edge, as the bits of its f32 coordinates.
type EdgeEnd = [u32; 3];

/// Returns the parts after joining those that form one solid.
pub(super) fn joined(placed: Vec<Placed>, notes: &mut Vec<Diagnostic>) -> Vec<Placed> {
    let mut open: Vec<([EdgeEnd; 2], u32)> = Vec::new();
    for (number, part) in (0..).zip(&placed) {
        if !part.is_closed
            && part.driver.is_none()
            && part.world_from_part.matrix3.determinant() > 0.0
        {
            open.extend(open_edges(part).map(|edge| (edge, number)));
        }
    }
    open.sort_unstable();
    let mut sets = Sets::new(placed.len());
    for pair in open.windows(2).filter(|w| w[0].0 == w[1].0) {
        sets.join(pair[0].1, pair[1].1);
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); placed.len()];
    for part in 0..placed.len() {
        members[sets.find(part as u32) as usize].push(part);
    }
    let mut parts: Vec<Option<Placed>> = placed.into_iter().map(Some).collect();
    for set in members.into_iter().filter(|set| set.len() > 1) {
        let pieces: Vec<&Placed> = set.iter().filter_map(|i| parts[*i].as_ref()).collect();
        let Some(whole) = whole(&pieces) else {
            continue;
        };
        let name = whole.name.as_deref().unwrap_or("a part");
        let count = set.len();
        notes.push(Diagnostic::note(
            "nodes-joined",
            format!("{count} nodes form one part, {name}: they close each other's open edges"),
        ));
        set.iter().for_each(|i| parts[*i] = None);
        parts[set[0]] = Some(whole);
    }
    parts.into_iter().flatten().collect()
}

fn open_edges(part: &Placed) -> impl Iterator<Item = [EdgeEnd; 2]> {
    let edges: Vec<[u32; 2]> = Edges::of(&part.mesh.triangles).open().collect();
    edges.into_iter().map(|edge| {
        let mut ends = edge.map(|i| {
            let at = (part.world_from_part).transform_point3(part.mesh.positions[i as usize]);
            // Adding 0.0 turns -0.0 into 0.0.
            (at.as_vec3() + Vec3::ZERO).to_array().map(f32::to_bits)
        });
        ends.sort_unstable();
        ends
    })
}

/// Joins pieces into one part in world space. Returns `None` if the result is not closed, or if the pieces have different roles.
fn whole(pieces: &[&Placed]) -> Option<Placed> {
    let first = pieces.first()?;
    if pieces.iter().any(|piece| piece.role != first.role) {
        return None;
    }
    let mut mesh = Mesh::default();
    for piece in pieces {
        let before = mesh.positions.len() as u32;
        let places = piece.mesh.positions.iter();
        (mesh.positions).extend(places.map(|p| piece.world_from_part.transform_point3(*p)));
        let triangles = piece.mesh.triangles.iter();
        mesh.triangles
            .extend(triangles.map(|t| t.map(|i| i + before)));
    }
    let welding = weld(&mesh.positions, &mesh.triangles);
    if welding.open > 0 {
        return None;
    }
    if let Some(welded) = welding.weld {
        mesh.positions = welded.positions;
        renumber(&mut mesh.triangles, &welded.new_from_old);
    }
    mesh.corner_normals = normals(pieces);
    mesh.vertex_paint = vertex_paint(pieces);
    Some(Placed {
        name: pieces.iter().find_map(|piece| piece.name.clone()),
        color: first.color,
        materials: pieces
            .iter()
            .flat_map(|piece| piece.materials.clone())
            .collect(),
        is_transparent: pieces.iter().all(|piece| piece.is_transparent),
        role: first.role,
        // A triangle that is flat only at the size of the whole has an edge from a vertex to itself, which counts as open.
        is_closed: mesh.triangles.iter().all(has_three),
        mesh: Arc::new(mesh),
        world_from_part: DAffine3::IDENTITY,
        driver: None,
    })
}

/// The normals of the pieces in world space, if all pieces have normals.
fn normals(pieces: &[&Placed]) -> Option<Vec<[Vec3; 3]>> {
    let mut all = Vec::new();
    for piece in pieces {
        let to_world = piece.world_from_part.matrix3.inverse().transpose();
        let turned = |n: Vec3| (to_world * n.as_dvec3()).normalize_or_zero().as_vec3();
        let own = piece.mesh.corner_normals.as_ref()?.iter();
        all.extend(own.map(|corners| corners.map(turned)));
    }
    Some(all)
}

/// The combined vertex paint of the pieces. There is one if a piece has vertex paint or if the pieces differ in colour.
fn vertex_paint(pieces: &[&Placed]) -> Option<VertexPaint> {
    let is_plain =
        |piece: &&Placed| piece.mesh.vertex_paint.is_none() && piece.color == pieces[0].color;
    if pieces.iter().all(is_plain) {
        return None;
    }
    let mut whole = VertexPaint::default();
    for piece in pieces {
        let Some(vertex_paint) = &piece.mesh.vertex_paint else {
            let color = piece.color.unwrap_or(Material::default().color) * 255.0;
            let [r, g, b] = color.round().to_array().map(|c| c as u8);
            let plain = TexturedTriangle {
                colors: [[r, g, b, 255]; 3],
                ..TexturedTriangle::default()
            };
            let count = piece.mesh.triangles.len();
            whole.triangles.extend(std::iter::repeat_n(plain, count));
            continue;
        };
        let numbers: Vec<u32> = (vertex_paint.images.iter())
            .map(|image| Texture::number_among(&mut whole.images, image) as u32)
            .collect();
        whole
            .triangles
            .extend(vertex_paint.triangles.iter().map(|t| TexturedTriangle {
                image: t.image.map(|i| numbers[i as usize]),
                ..*t
            }));
    }
    Some(whole)
}
