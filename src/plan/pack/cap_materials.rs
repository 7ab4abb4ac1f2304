//! Materials of caps: what each part has, where textures are, and how clip-surfaces carry them.

use bytemuck::{Pod, Zeroable};

use super::{CapPlane, Layout};

/// In the place of the number of a texture: there is none.
pub const NO_TEXTURE: u32 = u32::MAX;

/// A solid that is a stack of images which fills the box of its part.
pub const FILLED_STACK: u32 = 5;

/// Words of a triangle of a vertex paint: three vertices, three colours, six coordinates, an image.
pub const VERTEX_PAINT_WORDS: usize = 13;

/// Clip-surfaces that layers can number.
pub const MOST_CAP_PLANES: usize = 256;

shared! {
    /// An image in the buffer of texels: `shaders/lib/colors/texture.wgsl`.
    Texture {
        /// Its first texel.
        first: u32,
        /// 1 where its numbers are sRGB.
        is_color: u32,
        /// Columns and rows.
        size: [u32; 2],
    }
}

shared! {
    /// The vertex paint of a part: `shaders/effects/vertex_paint.wgsl`.
    VertexPaintRow {
        /// Number of the part in the scene.
        part: u32,
        /// Its first vertex in the buffer of all parts.
        first_vertex: u32,
        /// The first word of its first triangle.
        first_word: u32,
        /// The first of its textures.
        first_image: u32,
    }
}

shared! {
    /// The material of the caps of a part: `shaders/effects/cap_materials.wgsl`.
    CapMaterial {
        /// From a point of scene space to the first coordinate in the solid: across the grain.
        x_row: [f32; 4],
        /// To the second: across the grain too.
        y_row: [f32; 4],
        /// To the third: along the grain.
        z_row: [f32; 4],
        /// Texture of colours.
        diffuse: u32,
        /// Texture of normals.
        normal: u32,
        /// Texture of light.
        light: u32,
        /// 0 for none, 1 wood, 2 marble, 3 granite, 4 a stack of images that repeats, 5 one that fills the box of the part.
        solid: u32,
        /// First image of a stack.
        first_image: u32,
        /// Number of images.
        image_count: u32,
        /// Repeats of images in a scene unit; 0 takes those of the relief.
        per_unit: f32,
        /// 1 where the part has a material.
        is_there: u32,
    }
}

shared! {
    /// The frames of all clip-surfaces: `shaders/effects/cap_materials.wgsl`.
    CapMaterialPlanes {
        /// By the number of the clip-surface: coordinates in scene units.
        planes: [CapPlane; MOST_CAP_PLANES],
        /// Repeats of the relief in a scene unit along both directions, or what stands for them.
        per_unit: [[f32; 4]; MOST_CAP_PLANES],
        /// Number of planes.
        count: u32,
        /// Repeats in a scene unit where there is no relief.
        default_per_unit: f32,
        /// 1 where the third axis is up, and not the second.
        is_z_up: u32,
        /// Unused.
        padding: u32,
    }
}
