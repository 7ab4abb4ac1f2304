//! Inputs of the pose pass that do not change with the pose: a part's rest-pose vertices and all that can move them, packed once per mesh.
//!
//! *Rest space* is part space moved to the middle of the mesh and scaled by a power of two, so that f32 loses no precision that
//! the scene would show. Morph targets, joint influences and outward directions are stored per position; vertices that shading splits
//! refer to their position, so that they move identically to the last bit.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::packed_closing::PackedClosing;
use super::packed_vertex_paint::PackedVertexPaint;
use super::vertex::{Vertex, packed_triangles};
use crate::plan::Contents;
use crate::plan::pack::pack_normal;
use crate::scene::{Bounds, Motion, Part, Prepared, Scene, SceneSpace, facing_out};

/// Index of the matrix for positions without joint influences; it holds only the placement.
pub(crate) const UNPULLED: u32 = 0;
/// Index of the matrix that maps every point to the image of part space's origin.
pub(crate) const ORIGIN: u32 = 1;
/// Index of the first joint's matrix.
pub(crate) const FIRST_JOINT: u32 = 2;

/// A part in the rest pose.
#[derive(Clone, Debug)]
pub(crate) struct RestPart {
    /// Maps part space to rest space.
    space: SceneSpace,
    /// Rest-space position and normal, per vertex.
    pub(crate) vertices: Contents,
    pub(crate) vertex_count: u32,
    pub(crate) position_count: u32,
    pub(crate) position_of_vertex: Contents,
    /// Vertex indices of the triangles.
    pub(crate) indices: Arc<[u8]>,
    /// Its vertex paint, if its mesh has one.
    pub(crate) vertex_paint: Option<Arc<PackedVertexPaint>>,
    /// The triangles as they are cut, by position index.
    pub(crate) triangles: Arc<Vec<[u32; 3]>>,
    /// True if the triangles are reversed because the placement mirrors.
    pub(crate) mirrored: bool,
    /// Bounds in part space.
    pub(crate) bounds: Bounds,
    /// Volume in part space.
    pub(crate) volume: f64,
    /// Displacements of morph targets, target by target.
    pub(crate) displacements: Option<Contents>,
    /// Joint influences of a skin.
    pub(crate) pulls: Option<Contents>,
    /// Outward directions of a mesh that can be inflated.
    pub(crate) outward: Option<Contents>,
}

impl RestPart {
    /// Packs a part; its pose does not matter.
    pub(crate) fn of(part: &Part, mirrored: bool) -> Self {
        let space = SceneSpace::new(&part.mesh.bounds());
        let mut still = Part::new(part.name.clone(), part.mesh.clone());
        still.world_from_part = DAffine3::IDENTITY;
        // The same steps as for a static part, in a scene that contains only this part.
        let alone = Scene {
            parts: vec![still],
            stage: Some(part.mesh.bounds()),
            ..Scene::default()
        };
        let placed = Prepared::new(&alone).parts.remove(0);
        let shading = &placed.shading;
        let at = shading.positions_of_vertex.iter();
        let vertices: Vec<Vertex> = (at.zip(&shading.normals))
            .map(|(p, n)| Vertex {
                position: placed.positions[*p as usize].to_array(),
                normal: pack_normal(*n),
            })
            .collect();
        let turned = shading.triangles.iter().map(|t| facing_out(*t, mirrored));
        let turned: Vec<[u32; 3]> = turned.collect();
        let positions = part.mesh.positions.len();
        let motion = part.motion.as_deref();
        Self {
            vertices: Contents::from_values(&vertices),
            vertex_count: vertices.len() as u32,
            position_count: positions as u32,
            position_of_vertex: Contents::from_values(&shading.positions_of_vertex),
            indices: packed_triangles(turned.iter().copied(), |v| {
                placed.positions[shading.positions_of_vertex[v as usize] as usize]
            }),
            vertex_paint: (part.mesh.vertex_paint.as_ref()).map(|vertex_paint| {
                Arc::new(PackedVertexPaint::of(vertex_paint, &turned, mirrored))
            }),
            triangles: placed.triangles.clone(),
            mirrored,
            bounds: part.mesh.bounds(),
            volume: part.mesh.volume(),
            displacements: motion.and_then(|m| displacements(m, positions, space.scale)),
            pulls: motion.and_then(|m| pulls(m, positions)),
            outward: motion.and_then(|m| outward(m, positions)),
            space,
        }
    }

    /// The map from part space to rest space.
    pub(crate) fn rest_from_part(&self) -> DAffine3 {
        self.space.from_world()
    }

    /// The map from rest space to part space.
    pub(crate) fn part_from_rest(&self) -> DAffine3 {
        let per_unit = 1.0 / self.space.scale;
        DAffine3::from_mat3_translation(
            DMat3::from_diagonal(DVec3::splat(per_unit)),
            self.space.centre_in_world,
        )
    }

    /// The triangles that close it, facing as it is placed; `None` if it is closed.
    pub(crate) fn closing(&self) -> Option<PackedClosing> {
        let turned = self.triangles.iter().map(|t| facing_out(*t, self.mirrored));
        let position_of_vertex = self.position_of_vertex.bytes();
        let vertices: Vec<Vertex> = bytemuck::pod_collect_to_vec(&self.vertices.bytes());
        let position_of_vertex: Vec<u32> = bytemuck::pod_collect_to_vec(&position_of_vertex);
        let mut positions = vec![Vec3::ZERO; self.position_count as usize];
        for (vertex, position) in vertices.iter().zip(&position_of_vertex) {
            positions[*position as usize] = vertex.position.into();
        }
        let position = |p: u32| positions[p as usize];
        PackedClosing::of(&turned.collect::<Vec<_>>(), &position_of_vertex, position)
    }

    /// Rest units per unit of part space.
    pub(crate) fn scale(&self) -> f64 {
        self.space.scale
    }
}

/// Positions that a motion does not mention stay where they are.
fn displacements(motion: &Motion, positions: usize, scale: f64) -> Option<Contents> {
    let mut numbers: Vec<f32> = Vec::with_capacity(motion.targets.len() * positions * 3);
    for target in &motion.targets {
        let of = |i| target.get(i).copied().unwrap_or_default() * scale;
        numbers.extend((0..positions).flat_map(|i| of(i).as_vec3().to_array()));
    }
    (!numbers.is_empty()).then(|| Contents::from_values(&numbers))
}

/// First index of each position's influences, then the influences. If weights add up to less than 1, the rest goes to the origin, as
/// the sum in the f64 path does.
fn pulls(motion: &Motion, positions: usize) -> Option<Contents> {
    if motion.pulls.is_empty() {
        return None;
    }
    let mut words: Vec<u32> = vec![0; positions + 1];
    for position in 0..positions {
        words[position] = words.len() as u32;
        let given = motion.pulls_of(position);
        if given.is_empty() {
            words.extend([UNPULLED, 1.0_f32.to_bits()]);
            continue;
        }
        let sum: f64 = given.iter().map(|p| f64::from(p.weight)).sum();
        let missing = (1.0 - sum) as f32;
        if missing.abs() > 0.0 {
            words.extend([ORIGIN, missing.to_bits()]);
        }
        for pull in given {
            words.extend([FIRST_JOINT + u32::from(pull.joint), pull.weight.to_bits()]);
        }
    }
    words[positions] = words.len() as u32;
    Some(Contents::from_values(&words))
}

fn outward(motion: &Motion, positions: usize) -> Option<Contents> {
    if motion.outward.is_empty() {
        return None;
    }
    let of = |i: usize| motion.outward.get(i).copied().unwrap_or_default();
    let numbers: Vec<f32> = (0..positions)
        .flat_map(|i| of(i).as_vec3().to_array())
        .collect();
    Some(Contents::from_values(&numbers))
}
