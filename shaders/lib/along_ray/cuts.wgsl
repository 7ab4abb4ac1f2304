// The cuts: for each part, the sides of clip-surfaces that are removed. Bound as @group(0) @binding(1) and (2).
//
// A point's *sides* are one bit per clip-surface, set where the point lies on the removed side. A cut removes the points
// that are on the removed side of all its clip-surfaces. A point of a part is removed if any cut of the part removes it.

#define_import_path cutaway::cuts

const MAX_SURFACES: u32 = 32u;

struct ClipSurface {
    // Rows that map a point (x, y, z, 1) of scene space to its height over the plane and to texel coordinates of the offset map, with texel
    // centres at integers.
    height_row: vec4<f32>,
    texel_x_row: vec4<f32>,
    texel_y_row: vec4<f32>,
    // Directions in scene space: the step along each texel axis, and the normal, pointing to the kept side.
    u_hat: vec4<f32>,
    v_hat: vec4<f32>,
    normal: vec4<f32>,
    // Texels per scene unit along u_hat and v_hat, height of a texel of value 1, unused.
    scale: vec4<f32>,
    // Least and greatest height of the relief over the plane, in scene units.
    slab: vec2<f32>,
    // First texel in the heights buffer, or NO_RELIEF.
    first_texel: u32,
    wrap: u32,
    map_size: vec2<u32>,
    // Greatest number of map cells that a ray crosses inside the box.
    cell_limit: u32,
    // Number of this clip-surface in the scene.
    surface: u32,
}

// Greatest number of relief cells along a ray: `cell_limit` in `src/plan/pack.rs`.
const MOST_CELLS: u32 = 32768u;

const NO_RELIEF: u32 = 0xffffffffu;

struct CutTable {
    surface_count: u32,
    cut_count: u32,
    // 1 if the crossings with at least one clip-surface store a normal.
    has_normals: u32,
    padding: u32,
    // [i][j] has one bit per clip-surface of cut 4 i + j.
    surfaces_of_cut: array<vec4<u32>, 8>,
    surfaces: array<ClipSurface, 32>,
}

struct Part {
    // One bit per cut that applies to the part.
    cuts: u32,
    // Location of this part's bits or counts in the inside mask: word, and shift or WINDING.
    lane_word: u32,
    lane_shift: u32,
    // Index of the part in the scene.
    part: u32,
    // Colour in sRGB.
    color: vec4<f32>,
    cap_color: vec4<f32>,
    // Not a property of this part: the table index of the part whose scene index equals this row's number.
    place: u32,
    // Number of its closing, or NO_CLOSING.
    closing: u32,
    // 1 if the part is filled by the nonzero rule.
    is_nonzero: u32,
    padding: u32,
}

@group(0) @binding(1) var<uniform> cut_table: CutTable;
@group(0) @binding(2) var<storage, read> parts: array<Part>;

// The table index of a part of the scene.
fn place_of_part(part: u32) -> u32 {
    return parts[part].place;
}

fn surfaces_of_cut(cut: u32) -> u32 {
    return cut_table.surfaces_of_cut[cut / 4u][cut % 4u];
}

// True if these cuts remove a point with these sides.
fn is_removed(sides: u32, cuts: u32) -> bool {
    var rest = cuts;
    for (var i = 0u; i < 32u && rest != 0u; i++) {
        let cut = firstTrailingBit(rest);
        rest &= rest - 1u;
        let surfaces = surfaces_of_cut(cut);
        if (sides & surfaces) == surfaces {
            return true;
        }
    }
    return false;
}
