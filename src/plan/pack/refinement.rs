//! Shared structs of tessellations that are refined to suit a view.

use bytemuck::{Pod, Zeroable};

use super::Layout;

/// Borders that triangles are tested against: the near plane, the sides of the picture, the faces of the box of the cut solids.
pub const BORDERS_OF_DOMAIN: usize = 11;
/// Maximum texels in half the side of a patch, as a power of two: `shaders/lib/reliefs/domain.wgsl`.
pub const MOST_HALF_BITS: u32 = 5;

shared! {
    /// The tessellated part of a clip-surface: `shaders/lib/reliefs/domain.wgsl`.
    Domain {
        /// Position of vertex (0, 0) on the plane.
        corner: [f32; 4],
        /// One step along the rows of the map, in scene space.
        step_x: [f32; 4],
        /// One step along the columns of the map, in scene space.
        step_y: [f32; 4],
        /// Map texel at vertex (0, 0).
        first_texel: [i32; 2],
        /// Number of patches along each side.
        patches: [u32; 2],
        /// Texels per patch side, as a power of two.
        patch_bits: u32,
        /// Steps per texel, as a power of two.
        step_bits: u32,
        /// First index of the errors of the domain's vertices.
        first_vertex: u32,
        /// First index of the twists of the domain's cells.
        first_cell: u32,
        /// Minimum twist assumed for every cell.
        least_twist: f32,
        /// 1 if the texel axes have the opposite orientation to `U` and `V`.
        mirrored: u32,
        /// Width and height of the map.
        map_size: [u32; 2],
        /// The map's first texel in `heights`.
        map_first: u32,
        /// Wrap mode of the map.
        wrap: u32,
        /// Unused.
        padding: [u32; 2],
    }
}

impl Domain {
    /// The fields that the vertex errors depend on: the same wherever the clip-surface lies, as long as it covers the same
    /// texels. All zero for a plane, for which no errors are measured.
    #[must_use]
    pub fn as_measured(&self) -> Self {
        if self.map_size == [0, 0] {
            return Self::zeroed();
        }
        Self {
            corner: [0.0; 4],
            step_x: [0.0; 4],
            step_y: [0.0; 4],
            step_bits: 0,
            mirrored: 0,
            ..*self
        }
    }
}

shared! {
    /// A view's requirements on a tessellation: `shaders/lib/reliefs/refinement.wgsl`.
    Refinement {
        /// For each border, its value at vertex (0, 0) and the change per step along rows and along columns.
        borders: [[f32; 4]; BORDERS_OF_DOMAIN],
        /// Least depth over vertex (0, 0), depth change per step along rows and along columns, depth of the near plane; all in whole units.
        depth: [i32; 4],
        /// Largest map error that is invisible at a depth of one unit.
        error_per_depth: f32,
        /// Triangle capacity.
        capacity: u32,
        /// First index of the list of deep patches.
        first_patch: u32,
        /// Unused.
        padding: u32,
    }
}
