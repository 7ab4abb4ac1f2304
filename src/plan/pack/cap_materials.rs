//! Cap materials: the material of each part, the positions of textures, and the mapping of clip-surfaces.

use bytemuck::{Pod, Zeroable};

use super::{CapPlane, Layout};

/// Stands for a texture number where there is no texture.
pub const NO_TEXTURE: u32 = u32::MAX;

/// Value of `solid` for a stack of images that fills the box of its part.
pub const FILLED_STACK: u32 = 5;

/// Words per triangle of a vertex paint: three vertices, three colours, six coordinates, an image.
pub const VERTEX_PAINT_WORDS: usize = 13;

/// Maximum number of clip-surfaces that layers can number.
pub const MOST_CAP_PLANES: usize = 256;

shared! {
    /// An image in the texel buffer: `shaders/lib/colors/texture.wgsl`.
    Texture {
        /// Its first texel.
        first: u32,
        /// 1 if its values are sRGB.
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
        /// Its first vertex in the shared vertex buffer.
        first_vertex: u32,
        /// First word of its first triangle.
        first_word: u32,
        /// Number of its first texture.
        first_image: u32,
    }
}

shared! {
    /// The cap material of a part: `shaders/effects/cap_materials.wgsl`.
    CapMaterial {
        /// Maps a point of scene space to the solid's first coordinate: across the grain.
        x_row: [f32; 4],
        /// Maps the point to the second coordinate: also across the grain.
        y_row: [f32; 4],
        /// Maps the point to the third coordinate: along the grain.
        z_row: [f32; 4],
        /// Number of the colour texture.
        diffuse: u32,
        /// Number of the normal texture.
        normal: u32,
        /// Number of the light texture.
        light: u32,
        /// 0 none, 1 wood, 2 marble, 3 granite, 4 a stack of images that repeats, 5 a stack that fills the part's box.
        solid: u32,
        /// First image of a stack of images.
        first_image: u32,
        /// Number of images.
        image_count: u32,
        /// Image repeats per scene unit; if 0, those of the relief are used.
        per_unit: f32,
        /// 1 if the part has a material.
        is_there: u32,
    }
}

shared! {
    /// The frames of all clip-surfaces: `shaders/effects/cap_materials.wgsl`.
    CapMaterialPlanes {
        /// By clip-surface number: planes that give coordinates in scene units.
        planes: [CapPlane; MOST_CAP_PLANES],
        /// Repeats per scene unit in both directions: those of the relief, or the default where there is no relief.
        per_unit: [[f32; 4]; MOST_CAP_PLANES],
        /// Number of planes.
        count: u32,
        /// Repeats per scene unit without a relief.
        default_per_unit: f32,
        /// 1 if the third axis is up instead of the second.
        is_z_up: u32,
        /// Unused.
        padding: u32,
    }
}
