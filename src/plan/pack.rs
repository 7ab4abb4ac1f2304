//! The structs shared between the CPU and the shaders, in WGSL layout.
//!
//! Each is declared once by a macro that also lists its fields, so that a test can compare names, offsets and sizes with
//! naga's layout of the composed shaders. No `vec3`: rows of four.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec4};

use crate::scene::PreparedSurface;

mod layout;
mod normal;

pub use cap_materials::{
    CapMaterial, CapMaterialPlanes, FILLED_STACK, MOST_CAP_PLANES, NO_TEXTURE, Texture,
    VERTEX_PAINT_WORDS, VertexPaintRow,
};
pub use composite::Composite;
pub use cutter::CutterFace;
pub use frame::{Frame, frame};
pub(crate) use frame::{box_margin, most_box_margin};
pub use ghost::Ghost;
pub use hatch::{CapPlane, HatchLine, HatchPlanes, MOST_HATCH_PLANES, PartHatch};
pub use layout::Layout;
use layout::row;
pub use lists::{Cascade, FragmentPool, SheetPool};
pub use normal::{pack_normal, unpack_normal};
pub use occlusion::{Ground, Horizon, ReliefSky, Unsharp};
pub use pyramid::{LOWEST, Pyramid, SIDE};
pub use sprite::{Sprite, sprite_frame};
pub use style::Style;

macro_rules! shared {
    ($(#[$doc:meta])* $name:ident { $($(#[$fdoc:meta])* $field:ident: $ty:ty),* $(,)? }) => {
        $(#[$doc])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
        pub struct $name { $($(#[$fdoc])* pub $field: $ty),* }

        impl Layout for $name {
            const NAME: &'static str = stringify!($name);
            fn fields() -> Vec<(&'static str, usize, usize)> {
                vec![$((stringify!($field), std::mem::offset_of!($name, $field), size_of::<$ty>())),*]
            }
        }
    };
}

// These modules follow the macro because they use it.
mod cap_materials;
mod composite;
mod cutter;
mod frame;
mod ghost;
mod hatch;
mod lists;
mod occlusion;
mod pose;
mod pyramid;
mod rays;
mod refinement;
mod sprite;
mod style;

pub use pose::{BEND, Deformer, INFLATE, MOST_DEFORMERS, Pose, TWIST, WAVE};
pub use rays::{MOST_PLANES, RayRow, RaySurface, RayTable, RaysOfFour, ray_table};
pub use refinement::{BORDERS_OF_DOMAIN, Domain, MOST_HALF_BITS, Refinement};

shared! {
    /// A clip-surface as functions of a point: `shaders/lib/along_ray/cuts.wgsl`.
    ClipSurface {
        /// Row giving the height over the plane.
        height_row: [f32; 4],
        /// Row giving the x texel coordinate.
        texel_x_row: [f32; 4],
        /// Row giving the y texel coordinate.
        texel_y_row: [f32; 4],
        /// Direction of `U`.
        u_hat: [f32; 4],
        /// Direction of `V`.
        v_hat: [f32; 4],
        /// Toward the kept side.
        normal: [f32; 4],
        /// Texels per scene unit in u and v, then the height of a texel of value 1.
        scale: [f32; 4],
        /// Least and greatest height of the relief; zeros if it is flat.
        slab: [f32; 2],
        /// First texel in the heights buffer.
        first_texel: u32,
        /// Wrap mode.
        wrap: u32,
        /// Width and height of the map.
        map_size: [u32; 2],
        /// Maximum number of cells that a ray crosses.
        cell_limit: u32,
        /// Number of the clip-surface in the scene.
        surface: u32,
    }
}

shared! {
    /// All cuts: `shaders/lib/along_ray/cuts.wgsl`.
    CutTable {
        /// Number of clip-surfaces.
        surface_count: u32,
        /// Number of cuts.
        cut_count: u32,
        /// 1 if crossings with some clip-surface store a normal.
        has_normals: u32,
        /// Unused.
        padding: u32,
        /// Bits of the clip-surfaces of each cut.
        surfaces_of_cut: [[u32; 4]; 8],
        /// The clip-surfaces.
        surfaces: [ClipSurface; MAX_SURFACES],
    }
}

shared! {
    /// A part: `shaders/lib/along_ray/cuts.wgsl`.
    Part {
        /// Bits of the cuts that apply.
        cuts: u32,
        /// Word of the inside mask.
        lane_word: u32,
        /// First bit in that word; 32 if the lane consists of words of counts.
        lane_shift: u32,
        /// Index in the scene.
        part: u32,
        /// Surface colour, sRGB.
        color: [f32; 4],
        /// Cap colour, sRGB.
        cap_color: [f32; 4],
        /// Not about this row's part: table position of the part whose index in the scene is this row's number.
        place: u32,
        /// Number of its closing, or `NO_CLOSING`.
        closing: u32,
        /// 1 if the part is filled by the nonzero rule.
        is_nonzero: u32,
        /// Unused.
        padding: u32,
    }
}

shared! {
    /// A quad that becomes a cap grid: `shaders/lib/reliefs/quads.wgsl`.
    Quad {
        /// First corner.
        corner: [f32; 4],
        /// Step of one cell along `U`.
        step_u: [f32; 4],
        /// Step of one cell along `V`.
        step_v: [f32; 4],
        /// Number of cells along a side; the rest is unused.
        cells: [u32; 4],
    }
}

shared! {
    /// A sweep of the compute rasteriser: `shaders/lib/rasterise/sweep.wgsl`.
    Sweep {
        /// Number of triangles of all drawn parts.
        triangle_count: u32,
        /// Number of vertices from the first to the last vertex of the drawn parts.
        vertex_count: u32,
        /// Steps of the binary search for a triangle's part.
        search_steps: u32,
        /// 0 in the first sweep over a screen, 1 in a later sweep.
        again: u32,
        /// Number of the first vertex of the drawn parts.
        first_vertex: u32,
        /// First row of preclassified groups in the table of parts.
        first_group: u32,
    }
}

shared! {
    /// Triangles of a part with the same classification: `shaders/lib/along_ray/preclassified.wgsl`.
    PreclassifiedGroup {
        /// Position of the part in the part table.
        place: u32,
        /// Bits of the clip-surfaces that preclassify the triangles.
        surfaces: u32,
        /// Subset of `surfaces` on whose removed side the triangles lie.
        removed: u32,
        /// Subset of `surfaces` in which the triangles lie.
        flush: u32,
        /// 1 if each triangle coincides with another one.
        doubled: u32,
        /// Bits of the cutters in whose faces the triangles lie.
        cutters: u32,
        /// Padding to 16 bytes.
        padding: [u32; 2],
        /// Normal of the cutter faces, up to sign; then 0.
        normal: [f32; 4],
        /// Depth-buffer value of the plane shared with other parts: change per pixel right, change per pixel down, value at the centre of
        /// the first pixel; then the part's position among the plane's parts, of which the last has 1. All 0 if there is no such plane.
        plane: [f32; 4],
    }
}

shared! {
    /// A part in the form that the compute rasteriser draws: `shaders/lib/rasterise/sweep.wgsl`.
    DrawnPart {
        /// Number of its first triangle among all drawn triangles.
        first_triangle: u32,
        /// Its first position in the indices.
        first_index: u32,
        /// Added to each index; relative to the first vertex of the sweep.
        base_vertex: u32,
        /// Bits of the cuts that apply.
        cuts: u32,
        /// Word of the inside mask.
        lane_word: u32,
        /// First bit in that word; 32 if the lane consists of words of counts.
        lane_shift: u32,
        /// Position in the part table, or `NO_LANE` if it needs no inside test.
        place: u32,
        /// Index in the scene.
        part: u32,
    }
}

/// Maximum number of parts that the compute rasteriser draws: a uniform table of fixed length.
pub const MOST_DRAWN_PARTS: usize = 1024;
/// Maximum number of groups of preclassified triangles: a uniform table of fixed length.
pub const MOST_PRECLASSIFIED_GROUPS: usize = 1024;
/// Maximum number of clip-surfaces in a scene: one bit each.
pub const MAX_SURFACES: usize = 32;
/// Maximum number of cuts in a scene: one bit each.
pub const MAX_CUTS: usize = 32;
/// `first_texel` of a plane.
pub const NO_RELIEF: u32 = u32::MAX;

/// Number of the closing of a part that is closed; `NO_CLOSING` in `shaders/lib/inside_tests/closings.wgsl`.
pub const NO_CLOSING: u32 = u32::MAX;

/// A clip-surface as functions of a point. `first_texel` is [`NO_RELIEF`] for planes; `reach` is the longest distance along which a ray
/// is followed.
pub fn clip_surface(
    surface: &PreparedSurface,
    number: usize,
    first_texel: u32,
    reach: f64,
) -> ClipSurface {
    let lift = if first_texel == NO_RELIEF {
        surface.flat_height().unwrap_or(0.0)
    } else {
        0.0
    };
    let texels = surface.relief.as_ref().map_or([1, 1], |m| m.size());
    let texels_per_unit = texels_per_unit(surface);
    let affine = |direction: DVec3, factor: f64, offset: f64| -> [f32; 4] {
        let d = direction * factor;
        let w = offset - d.dot(surface.origin);
        Vec4::new(d.x as f32, d.y as f32, d.z as f32, w as f32).to_array()
    };
    ClipSurface {
        height_row: affine(surface.frame.normal, 1.0, lift),
        texel_x_row: affine(surface.frame.u_hat, texels_per_unit[0], -0.5),
        texel_y_row: affine(surface.frame.v_hat, texels_per_unit[1], -0.5),
        u_hat: row(surface.frame.u_hat),
        v_hat: row(surface.frame.v_hat),
        normal: row(surface.frame.normal),
        scale: [
            texels_per_unit[0] as f32,
            texels_per_unit[1] as f32,
            surface.height_scale as f32,
            0.0,
        ],
        slab: slab_over_row(surface).map(|height| height as f32),
        first_texel,
        wrap: surface.wrap.code(),
        map_size: texels,
        cell_limit: cell_limit(surface, reach),
        surface: u32::try_from(number).unwrap_or(u32::MAX),
    }
}

/// Maximum number of relief cells through which a ray is followed: `shaders/lib/along_ray/cuts.wgsl`.
pub const MOST_CELLS: u32 = 32_768;

/// Maximum number of relief cells that a ray may cross within length `reach`: rays stop there, and the frame reports it.
pub fn cell_limit(surface: &PreparedSurface, reach: f64) -> u32 {
    let [x, y] = texels_per_unit(surface);
    let cells = (x.abs() + y.abs()) * reach;
    (cells as u32).saturating_add(4).min(MOST_CELLS)
}

/// Least and greatest height of a relief over the zero of `height_row`, which lies on the surface if that is flat.
fn slab_over_row(surface: &PreparedSurface) -> [f64; 2] {
    match surface.flat_height() {
        Some(_) => [0.0; 2],
        None => surface.slab(),
    }
}

fn texels_per_unit(surface: &PreparedSurface) -> [f64; 2] {
    let size = surface.relief.as_ref().map_or([1, 1], |m| m.size());
    [
        surface.map_per_unit[0] * f64::from(size[0]),
        surface.map_per_unit[1] * f64::from(size[1]),
    ]
}
