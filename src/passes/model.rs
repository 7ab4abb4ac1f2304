//! A scene packed for upload, once: vertices, indices and heights do not change with the view or the strategy.

use std::ops::Range;

use rayon::prelude::*;

use crate::plan::Contents;
use crate::plan::pack::{NO_RELIEF, flat_height, pack_normal};
use crate::scene::{Prepared, Scene};

/// A vertex as the shaders read it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    normal: u32,
}

/// Where a part is in the shared buffers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshRange {
    /// Range of indices.
    pub indices: Range<u32>,
    /// Added to each index.
    pub base_vertex: i32,
}

/// A scene ready to be recorded.
#[derive(Clone, Debug)]
pub struct Model {
    /// The scene in scene space.
    pub prepared: Prepared,
    /// Vertices of all parts.
    pub vertices: Contents,
    /// Indices of all parts.
    pub indices: Contents,
    /// Where each part is, by rank.
    pub ranges: Vec<MeshRange>,
    /// Heights of all reliefs, one after the other; parts that share a map share its texels.
    pub heights: Contents,
    /// First texel of each clip-surface, or [`NO_RELIEF`] for planes and flat reliefs.
    pub first_texel: Vec<u32>,
}

impl Model {
    /// Packs a scene.
    pub fn of(scene: &Scene) -> Self {
        Self::of_prepared(Prepared::of(scene))
    }

    /// Packs a prepared scene.
    pub fn of_prepared(prepared: Prepared) -> Self {
        let meshes: Vec<(Vec<Vertex>, Vec<u32>)> = prepared
            .parts
            .par_iter()
            .map(|part| {
                let shading = &part.shading;
                let vertices = shading
                    .positions_of_vertex
                    .iter()
                    .zip(&shading.normals)
                    .map(|(p, n)| Vertex {
                        position: part.positions[*p as usize].to_array(),
                        normal: pack_normal(*n),
                    });
                (
                    vertices.collect(),
                    shading.triangles.as_flattened().to_vec(),
                )
            })
            .collect();
        let mut ranges = Vec::with_capacity(meshes.len());
        let (mut first_index, mut base_vertex) = (0_u32, 0_i32);
        for (vertices, indices) in &meshes {
            let end = first_index + indices.len() as u32;
            ranges.push(MeshRange {
                indices: first_index..end,
                base_vertex,
            });
            first_index = end;
            base_vertex += vertices.len() as i32;
        }
        let (vertices, indices): (Vec<_>, Vec<_>) = meshes.into_iter().unzip();

        let mut heights: Vec<f32> = Vec::new();
        let mut packed: Vec<(*const crate::scene::OffsetMap, u32)> = Vec::new();
        let first_texel = prepared
            .surfaces
            .iter()
            .map(|s| match &s.relief {
                Some(map) if flat_height(s).is_none() => {
                    let key = std::sync::Arc::as_ptr(map);
                    if let Some((_, first)) = packed.iter().find(|(k, _)| *k == key) {
                        return *first;
                    }
                    let first = heights.len() as u32;
                    heights.extend_from_slice(&map.texels);
                    packed.push((key, first));
                    first
                }
                _ => NO_RELIEF,
            })
            .collect();
        if heights.is_empty() {
            // Bindings cannot be empty; no plane reads it.
            heights.push(0.0);
        }
        Self {
            prepared,
            vertices: Contents::of(&vertices.concat()),
            indices: Contents::of(&indices.concat()),
            ranges,
            heights: Contents::of(&heights),
            first_texel,
        }
    }

    /// The same scene with nothing removed, sharing what is packed: what `draw_only_ms` measures.
    #[must_use]
    pub fn without_cuts(&self) -> Self {
        let mut uncut = self.clone();
        uncut.prepared.cuts.clear();
        uncut.prepared.surfaces.clear();
        uncut.prepared.parts.iter_mut().for_each(|p| p.cuts.clear());
        uncut.first_texel.clear();
        uncut
    }

    /// Whether a clip-surface is a true relief rather than a plane or a flat map.
    pub fn is_relief(&self, surface: usize) -> bool {
        self.first_texel[surface] != NO_RELIEF
    }
}
