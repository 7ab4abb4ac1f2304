//! Shared structs of tessellations that are as fine as a view asks for.

use bytemuck::{Pod, Zeroable};

use super::Layout;

/// Borders that triangles are held against: the near plane, the sides of the picture, the faces of the box of the cut solids.
pub const BORDERS_OF_DOMAIN: usize = 11;
/// Texels of half the side of a patch, at most, as a power of two: `shaders/lib/reliefs/domain.wgsl`.
pub const MOST_HALF_BITS: u32 = 5;

shared! {
    /// The part of a clip-surface that is tessellated: `shaders/lib/reliefs/domain.wgsl`.
    Domain {
        /// Vertex (0, 0) on the plane.
        corner: [f32; 4],
        /// A step along the rows of the map, in scene space.
        step_x: [f32; 4],
        /// A step along its columns.
        step_y: [f32; 4],
        /// Texel of the map at vertex (0, 0).
        first_texel: [i32; 2],
        /// Patches along each side.
        patches: [u32; 2],
        /// Texels along a patch, as a power of two.
        patch_bits: u32,
        /// Steps along a texel, as a power of two.
        step_bits: u32,
        /// First index of the errors of its vertices.
        first_vertex: u32,
        /// First index of the twists of its cells.
        first_cell: u32,
        /// Twist that every cell is taken to have at least.
        least_twist: f32,
        /// 1 where texel axes turn the other way than `U` and `V`.
        mirrored: u32,
        /// Width and height of the map.
        map_size: [u32; 2],
        /// Its first texel in `heights`.
        map_first: u32,
        /// Wrap mode of the map.
        wrap: u32,
        /// Unused.
        padding: [u32; 2],
    }
}

impl Domain {
    /// The fields that the errors of its vertices depend on: the same wherever the clip-surface lies, as long as it covers the same
    /// texels. All zero for a plane, for which nothing is measured.
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
    /// Requirements of a view on a tessellation: `shaders/lib/reliefs/refinement.wgsl`.
    Refinement {
        /// Values at vertex (0, 0), per step along rows, per step along columns.
        borders: [[f32; 4]; BORDERS_OF_DOMAIN],
        /// Least depth over vertex (0, 0), per step along rows, per step along columns, of the near plane, in whole units.
        depth: [i32; 4],
        /// Greatest error of the map that is not seen at a depth of one unit.
        error_per_depth: f32,
        /// Triangles that there is room for.
        capacity: u32,
        /// First index of its list of deep patches.
        first_patch: u32,
        /// Unused.
        padding: u32,
    }
}
