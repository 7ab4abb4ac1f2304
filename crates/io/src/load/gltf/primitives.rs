//! The triangles of a glTF mesh: all primitives as groups of one draft, with the motion of their vertices.

use cutaway::error::Diagnostic;
use glam::{DVec3, Vec3};
use gltf::material::AlphaMode;
use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};

use super::super::painted::vertex_paint;
use super::super::{Draft, Group};
use super::accessor::{INDICES, check};
use super::follow::Followers;
use super::images::GltfImages;
use super::paint;
use super::quantized::triples;
use super::skin;

/// Reads all primitives of a mesh as groups of one draft. `joints` is the number of joints in the mesh's skin, if there is one.
pub(super) fn draft(
    mesh: &gltf::Mesh<'_>,
    joints: Option<usize>,
    (buffers, images): (&[Vec<u8>], &mut GltfImages<'_>),
    notes: &mut Vec<Diagnostic>,
) -> Result<Draft, String> {
    let mut draft = Draft::default();
    let mut paints = Vec::new();
    let mut painted = Vec::new();
    let mut normals = Some(Vec::new());
    let mut followers = Followers::new(joints);
    let mut left_out = 0;
    for primitive in mesh.primitives() {
        let label = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
        let at = |what: String| format!("{label}: {what}");
        let first = draft.mesh.positions.len() as u32;
        let accessor = primitive
            .get(&Semantic::Positions)
            .ok_or_else(|| at("it has no positions".to_owned()))?;
        let positions: Vec<[f32; 3]> = triples(accessor, buffers).map_err(at)?;
        let Some(triangles) = triangles(&primitive, positions.len(), buffers).map_err(at)? else {
            left_out += 1;
            continue;
        };
        let normal_of: Option<Vec<[f32; 3]>> = primitive
            .get(&Semantic::Normals)
            .map(|accessor| triples(accessor, buffers).map_err(at))
            .transpose()?
            .filter(|n| n.len() >= positions.len());
        normals = normals.zip(normal_of).map(|(mut all, of)| {
            let unit = |i: u32| Vec3::from(of[i as usize]).normalize_or_zero();
            all.extend(triangles.iter().map(|t| t.map(unit)));
            all
        });
        let vertices = positions.len();
        let mut said = Vec::new();
        if joints.is_some() {
            let pulls = skin::pulls(&primitive, vertices, buffers, &mut said).map_err(at)?;
            followers.pull(&pulls, vertices).map_err(at)?;
        }
        let all = draft.mesh.positions.len() + vertices;
        followers
            .morph(&primitive, vertices, all, buffers, &mut said)
            .map_err(at)?;
        let group = draft.groups.len() as u32;
        let paint = paint::of(&primitive, images);
        if primitive.material().alpha_mode() == AlphaMode::Mask {
            said.push(Diagnostic::note(
                "alpha-mask",
                "drawn without the holes of its alpha mask",
            ));
        }
        draft.groups.push(Group {
            name: None,
            color: paint.color,
            material: primitive.material().name().map(str::to_owned),
            is_transparent: paint.is_transparent,
        });
        paints.push(paint);
        let (from, to) = ((group, &primitive), (&mut painted, &mut said));
        paint::triangles(from, &triangles, vertices, buffers, to);
        notes.extend(said.into_iter().map(|note: Diagnostic| note.about(&label)));
        let more = triangles.len();
        draft
            .group_of_triangle
            .extend(std::iter::repeat_n(group, more));
        let shifted = triangles.into_iter().map(|t| t.map(|i| i + first));
        draft.mesh.triangles.extend(shifted);
        let wide = positions.into_iter().map(|p| DVec3::from(p.map(f64::from)));
        draft.mesh.positions.extend(wide);
    }
    let mut targets = mesh.primitives().map(|p| p.morph_targets().len());
    let first = targets.next().unwrap_or(0);
    if targets.any(|more| more != first) {
        notes.push(Diagnostic::note("morph-targets-differ", "its primitives differ in their number of morph targets: vertices without a target stay"));
    }
    draft.mesh.corner_normals = normals;
    draft.mesh.vertex_paint = vertex_paint(&paints, true, painted.iter().copied());
    draft.motion = followers.finish(draft.mesh.positions.len(), notes);
    if left_out > 0 {
        notes.push(Diagnostic::note(
            "points-left-out",
            format!("left out {left_out} primitives of points or lines"),
        ));
    }
    Ok(draft)
}

/// Returns the triangles of a primitive, after checking their indices. Returns `None` for points and lines.
fn triangles(
    primitive: &Primitive<'_>,
    vertices: usize,
    buffers: &[Vec<u8>],
) -> Result<Option<Vec<[u32; 3]>>, String> {
    let mode = primitive.mode();
    if !matches!(
        mode,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
    ) {
        return Ok(None);
    }
    let corners: Vec<u32> = match primitive.indices() {
        None => (0..vertices as u32).collect(),
        Some(accessor) => {
            check(&accessor, INDICES, buffers)?;
            let reader = primitive.reader(|b| buffers.get(b.index()).map(Vec::as_slice));
            let read = reader.read_indices().ok_or("its indices cannot be read")?;
            read.into_u32().collect()
        }
    };
    if let Some(index) = corners.iter().find(|i| **i as usize >= vertices) {
        return Err(format!(
            "an index refers to vertex {index}, but there are only {vertices}"
        ));
    }
    Ok(Some(match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .map(|(k, w)| {
                if k % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[1], w[0], w[2]]
                }
            })
            .collect(),
        Mode::TriangleFan => match corners.as_slice() {
            [hub, rim @ ..] => rim.windows(2).map(|w| [*hub, w[0], w[1]]).collect(),
            [] => Vec::new(),
        },
        _ if !corners.len().is_multiple_of(3) => {
            return Err(format!(
                "the index count {} is not a multiple of 3",
                corners.len()
            ));
        }
        _ => corners
            .chunks_exact(3)
            .map(|c| [c[0], c[1], c[2]])
            .collect(),
    }))
}
