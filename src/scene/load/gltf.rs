//! glTF 2.0 and GLB: geometry, placement, base colours; no images, animations or morph targets.
//!
//! Every node with a mesh becomes a part, or several if the mesh's primitives are closed solids of their own. Nodes that
//! show the same mesh share it. Skinned meshes are shown in rest pose.

use std::path::Path;
use std::sync::Arc;

use glam::{DAffine3, DMat4, DQuat, DVec3, Vec3};
use gltf::mesh::Mode;
use gltf::scene::Transform;
use gltf::{Document, Gltf, Node, Primitive, Semantic};

use super::accessor::{INDICES, VEC3, check, items};
use super::{Draft, Group, Placed, skin, uri};
use crate::error::{Error, Result};

const DAMAGED: &str =
    "the file is cut off, damaged or uses an extension: export it again as plain glTF 2.0";

pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    notes: &mut Vec<String>,
    stage: &mut dyn FnMut(&'static str),
) -> Result<Vec<Placed>> {
    let wrong = |what: String| Error::file(path, what, DAMAGED);
    check_glb(bytes).map_err(wrong)?;
    let broken = |e: gltf::Error| wrong(format!("glTF: {}", reason(&e)));
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(broken)?;
    let root = document.into_json();
    check_attributes(&root).map_err(wrong)?;
    let document = Document::from_json(root).map_err(broken)?;
    let buffers = buffers(path, &document, blob)?;
    stage("welding");
    let nodes = placed_nodes(&document).map_err(wrong)?;
    let mut world_from_node = vec![None; document.nodes().count()];
    for (node, world) in &nodes {
        world_from_node[node.index()] = Some(*world);
    }
    let mut placed = Vec::new();
    let mut shared: Vec<Option<Vec<Placed>>> = Vec::new();
    shared.resize_with(document.meshes().count(), || None);
    for (node, world) in &nodes {
        let Some(mesh) = node.mesh() else { continue };
        let name = node.name().or(mesh.name()).map(str::to_owned);
        let label = || {
            name.clone()
                .unwrap_or_else(|| format!("node {}", node.index()))
        };
        let weights = node.weights().or(mesh.weights()).unwrap_or_default();
        if weights.iter().any(|w| *w != 0.0) {
            notes.push(format!("{}: shown without its morph targets", label()));
        }
        if node.skin().is_none()
            && let Some(Some(known)) = shared.get(mesh.index())
        {
            placed.extend(known.iter().map(|p| p.at(name.clone(), *world)));
            continue;
        }
        let mut said = Vec::new();
        let (mut draft, pulls) = draft(&mesh, &buffers, &mut said).map_err(wrong)?;
        let mut world_from_part = *world;
        if let (Some(skin), Some(pulls)) = (node.skin(), pulls) {
            match skin::palette(&skin, &world_from_node, &buffers) {
                Ok(palette) => {
                    world_from_part =
                        skin::pose(&mut draft.mesh, &pulls, &palette, *world).map_err(wrong)?;
                }
                Err(why) => said.push(format!("shown where its node is: {why}")),
            }
        }
        if draft.mesh.triangles.is_empty() {
            notes.extend(said.into_iter().map(|s| format!("{}: {s}", label())));
            continue;
        }
        let solids = draft.into_solids(path, &mut said)?;
        let parts: Vec<Placed> = solids.into_iter().map(Placed::of).collect();
        placed.extend(parts.iter().map(|p| p.at(name.clone(), world_from_part)));
        if node.skin().is_none() {
            shared[mesh.index()] = Some(parts);
        }
        notes.extend(said.into_iter().map(|s| format!("{}: {s}", label())));
    }
    if placed.is_empty() {
        return Err(Error::file(
            path,
            "no node of its scene has triangles",
            "export it with meshes; points, lines and curves are not cut",
        ));
    }
    Ok(placed)
}

impl Placed {
    fn at(&self, name: Option<String>, world_from_part: DAffine3) -> Self {
        Self {
            name,
            color: self.color,
            mesh: Arc::clone(&self.mesh),
            world_from_part,
        }
    }
}

/// The reason in one line: of a list of faults, the first.
fn reason(error: &gltf::Error) -> String {
    match error {
        gltf::Error::Validation(faults) => {
            faults.first().map_or("invalid".to_owned(), |(at, what)| {
                format!("{at}: {what} (and {} more)", faults.len().saturating_sub(1))
            })
        }
        other => other.to_string(),
    }
}

/// The header of a binary file, before the crate computes with it.
fn check_glb(bytes: &[u8]) -> Result<(), String> {
    if !bytes.starts_with(b"glTF") {
        return Ok(());
    }
    let word = |at: usize| {
        let bytes = bytes.get(at..at + 4)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes) as usize)
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(format!(
            "it ends after {} bytes, in the header",
            bytes.len()
        ));
    };
    if version != 2 {
        return Err(format!("it is of version {version}, only 2 is read"));
    }
    if length > bytes.len() {
        return Err(format!("it holds {} of {length} bytes", bytes.len()));
    }
    if length < 20 {
        return Err(format!("its header states a length of {length} bytes"));
    }
    Ok(())
}

/// The crate's own validation looks positions up before it checks that they are there.
fn check_attributes(root: &gltf::json::Root) -> Result<(), String> {
    let primitives = root.meshes.iter().flat_map(|m| &m.primitives);
    let there = root.accessors.len();
    match primitives
        .flat_map(|p| p.attributes.values())
        .find(|a| a.value() >= there)
    {
        Some(a) => Err(format!(
            "a primitive refers to accessor {}, but there are only {there}",
            a.value()
        )),
        None => Ok(()),
    }
}

fn buffers(path: &Path, document: &Document, blob: Option<Vec<u8>>) -> Result<Vec<Vec<u8>>> {
    let mut blob = blob;
    document
        .buffers()
        .map(|buffer| {
            let bytes = match buffer.source() {
                gltf::buffer::Source::Bin => blob.take().unwrap_or_default(),
                gltf::buffer::Source::Uri(at) => uri::read(path, at)?,
            };
            if bytes.len() < buffer.length() {
                let what = format!(
                    "buffer {} holds {} of {} bytes",
                    buffer.index(),
                    bytes.len(),
                    buffer.length()
                );
                return Err(Error::file(path, what, DAMAGED));
            }
            Ok(bytes)
        })
        .collect()
}

/// All nodes of the scene with their place in the world, parents first, in the order of the file.
fn placed_nodes(document: &Document) -> Result<Vec<(Node<'_>, DAffine3)>, String> {
    let mut is_child = vec![false; document.nodes().count()];
    for child in document.nodes().flat_map(|n| n.children()) {
        is_child[child.index()] = true;
    }
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next());
    let mut roots: Vec<Node<'_>> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => document.nodes().filter(|n| !is_child[n.index()]).collect(),
    };
    roots.reverse();
    let mut waiting: Vec<_> = roots.into_iter().map(|n| (n, DAffine3::IDENTITY)).collect();
    let mut seen = vec![false; is_child.len()];
    let mut placed = Vec::new();
    while let Some((node, world_from_parent)) = waiting.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(format!(
                "node {} has two parents or is its own",
                node.index()
            ));
        }
        let world = world_from_parent * local(&node);
        if !world.is_finite() {
            return Err(format!(
                "node {} has a transform that is not finite",
                node.index()
            ));
        }
        let children: Vec<_> = node.children().collect();
        waiting.extend(children.into_iter().rev().map(|child| (child, world)));
        placed.push((node, world));
    }
    Ok(placed)
}

fn local(node: &Node<'_>) -> DAffine3 {
    match node.transform() {
        Transform::Matrix { matrix } => {
            DAffine3::from_mat4(DMat4::from_cols_array_2d(&matrix.map(|c| c.map(f64::from))))
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => DAffine3::from_scale_rotation_translation(
            DVec3::from(scale.map(f64::from)),
            DQuat::from_array(rotation.map(f64::from)).normalize(),
            DVec3::from(translation.map(f64::from)),
        ),
    }
}

/// All primitives of a mesh as groups of one draft, and what moves its vertices if it is skinned.
fn draft(
    mesh: &gltf::Mesh<'_>,
    buffers: &[Vec<u8>],
    notes: &mut Vec<String>,
) -> Result<(Draft, Option<Vec<skin::Pull>>), String> {
    let mut draft = Draft::default();
    let mut normals = Some(Vec::new());
    let mut pulls: Option<Vec<skin::Pull>> = None;
    let mut left_out = 0;
    for primitive in mesh.primitives() {
        let at = |what: String| {
            format!(
                "mesh {}, primitive {}: {what}",
                mesh.index(),
                primitive.index()
            )
        };
        let first = draft.mesh.positions.len() as u32;
        let accessor = primitive
            .get(&Semantic::Positions)
            .ok_or_else(|| at("it has no positions".to_owned()))?;
        let positions: Vec<[f32; 3]> = items(accessor, VEC3, buffers).map_err(at)?;
        let Some(triangles) = triangles(&primitive, positions.len(), buffers).map_err(at)? else {
            left_out += 1;
            continue;
        };
        let normal_of: Option<Vec<[f32; 3]>> = primitive
            .get(&Semantic::Normals)
            .map(|accessor| items(accessor, VEC3, buffers).map_err(at))
            .transpose()?
            .filter(|n| n.len() >= positions.len());
        normals = normals.zip(normal_of).map(|(mut all, of)| {
            let unit = |i: u32| Vec3::from(of[i as usize]).normalize_or_zero();
            all.extend(triangles.iter().map(|t| t.map(unit)));
            all
        });
        if let Some(more) = skin::pulls(&primitive, buffers).map_err(at)? {
            let all = pulls.get_or_insert_default();
            all.resize(first as usize, skin::Pull::new());
            all.extend(more);
        }
        let group = draft.groups.len() as u32;
        draft.groups.push(Group {
            name: None,
            color: color(&primitive),
        });
        let more = triangles.len();
        draft
            .group_of_triangle
            .extend(std::iter::repeat_n(group, more));
        let shifted = triangles.into_iter().map(|t| t.map(|i| i + first));
        draft.mesh.triangles.extend(shifted);
        let wide = positions.into_iter().map(|p| DVec3::from(p.map(f64::from)));
        draft.mesh.positions.extend(wide);
    }
    draft.mesh.corner_normals = normals;
    if left_out > 0 {
        notes.push(format!("left out {left_out} primitives of points or lines"));
    }
    Ok((draft, pulls))
}

/// The triangles of a primitive with indices in range; `None` for points and lines.
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
                "{} indices are no whole number of triangles",
                corners.len()
            ));
        }
        _ => corners
            .chunks_exact(3)
            .map(|c| [c[0], c[1], c[2]])
            .collect(),
    }))
}

/// The base colour as sRGB. A textured material with a white factor says nothing about its colour.
fn color(primitive: &Primitive<'_>) -> Option<Vec3> {
    let material = primitive.material();
    material.index()?;
    let surface = material.pbr_metallic_roughness();
    let [r, g, b, _] = surface.base_color_factor();
    let linear = Vec3::new(r, g, b);
    if surface.base_color_texture().is_some() && linear == Vec3::ONE {
        return None;
    }
    let encoded = |c: f32| {
        if c <= 0.003_130_8 {
            12.92 * c
        } else {
            1.055 * c.powf(1.0 / 2.4) - 0.055
        }
    };
    let clamped = linear.clamp(Vec3::ZERO, Vec3::ONE);
    Some(Vec3::from(clamped.to_array().map(encoded)))
}
