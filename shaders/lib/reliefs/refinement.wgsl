// Halving test of a triangle: true if its error without halving may be visible in this view. Bound as @group(1) @binding(9), (10).
//
// The result depends only on the middle of the hypotenuse, which two triangles share, so either both are halved or neither, and no vertex
// lies on the edge of another triangle (Lindstrom & Pascucci, *Visualization of large terrains made easy*, 2001). For this a middle's error
// bounds those of all its descendant middles (ensured by the measuring pass), and its depth is the least in a box that contains theirs. A
// square of side s and all its descendants lie within 1.5 s of its middle along each axis, an edge of length s and all its descendants
// within s: half a side to the edge and s beyond it, a quarter of s to the middle of the next smaller square and 1.5 s/2 beyond. Depth is
// linear on the plane and counted in integers, so no rounding breaks this.
//
// Below a texel the map is bilinear, off its chord by |twist| s² / 4 on the diagonal of a square of side s, and nowhere more. The
// error kept for a cell is such that it is no less than a quarter of its neighbours'.

#define_import_path cutaway::refinement

#import cutaway::bisection::{Triangle, middle_of}
#import cutaway::domain::{domain_texels, domains}

struct Refinement {
    // Value at vertex (0, 0), per step in x, per step in y: a triangle whose corners are all negative in one of them is invisible, or
    // outside the box of the cut solids.
    borders: array<vec4<f32>, 11>,
    // Least depth of the clip-surface over vertex (0, 0), change per step in x and in y, depth of the near plane: whole units.
    depth: vec4<i32>,
    // Greatest error of the map that is invisible at a depth of one unit.
    error_per_depth: f32,
    // Capacity in triangles.
    capacity: u32,
    // Offset of its list of deep patches.
    first_patch: u32,
    padding: u32,
}

struct Refinements {
    surfaces: array<Refinement, 32>,
}

const BORDERS_OF_DOMAIN: u32 = 11u;

@group(1) @binding(9) var<uniform> refinements: Refinements;
// For each domain the errors at its texels' vertices, row by row, and then the twists of its cells. In map units.
@group(1) @binding(10) var<storage, read> sheet_errors: array<f32>;

// Triangles of this depth are never halved.
fn greatest_depth(surface: u32) -> u32 {
    return 2u * (domains.surfaces[surface].patch_bits + domains.surfaces[surface].step_bits);
}

fn twist_of(surface: u32, cell: vec2<i32>) -> f32 {
    let size = domain_texels(surface);
    if any(cell < vec2<i32>(0)) || any(cell >= vec2<i32>(size)) {
        return 0.0;
    }
    return sheet_errors[domains.surfaces[surface].first_cell + u32(cell.y) * size.x + u32(cell.x)];
}

// Length of the side or edge that a triangle's hypotenuse stands for, in steps.
fn length_of(triangle: Triangle) -> i32 {
    let along = abs(triangle.a - triangle.b);
    return max(along.x, along.y);
}

// The error avoided by halving at the middle of a hypotenuse.
fn error_of(surface: u32, triangle: Triangle, depth: u32) -> f32 {
    let bits = vec2<u32>(domains.surfaces[surface].step_bits);
    let middle = middle_of(triangle);
    let length = length_of(triangle);
    if length > (1 << bits.x) {
        let texel = vec2<u32>(middle >> bits);
        return sheet_errors[domains.surfaces[surface].first_vertex + texel.y * (domain_texels(surface).x + 1u) + texel.x];
    }
    let side = f32(length) / f32(1u << bits.x);
    if (depth & 1u) == 0u {
        return twist_of(surface, middle >> bits) * (side * side * 0.25);
    }
    let across = select(vec2<i32>(0, 1), vec2<i32>(1, 0), triangle.a.x == triangle.b.x);
    let twist = max(twist_of(surface, (middle - across) >> bits), twist_of(surface, middle >> bits));
    return twist * (side * side * 0.0625);
}

fn is_halved(surface: u32, triangle: Triangle, depth: u32) -> bool {
    if depth >= greatest_depth(surface) {
        return false;
    }
    let length = length_of(triangle);
    let reach = select(length, length + length / 2, (depth & 1u) == 0u);
    let row = refinements.surfaces[surface].depth;
    let middle = middle_of(triangle);
    let seen_at = row.x + middle.x * row.y + middle.y * row.z - reach * (abs(row.y) + abs(row.z));
    return error_of(surface, triangle, depth) > refinements.surfaces[surface].error_per_depth * f32(max(seen_at, row.w));
}

// Mask of all borders, and the result for a triangle beyond one of them.
const ALL_BORDERS: u32 = 0x7ffu;
const OUTSIDE: u32 = 0x80000000u;

// The subset of the given borders that a triangle or one of its descendants may cross; or `OUTSIDE` if no part of the triangle is visible
// inside the box of the cut solids.
fn borders_across(surface: u32, triangle: Triangle, borders: u32) -> u32 {
    let a = vec2<f32>(triangle.a);
    let b = vec2<f32>(triangle.b);
    let c = vec2<f32>(triangle.apex);
    var across = 0u;
    var rest = borders;
    for (var n = 0u; n < BORDERS_OF_DOMAIN && rest != 0u; n++) {
        let i = firstTrailingBit(rest);
        rest &= rest - 1u;
        let border = refinements.surfaces[surface].borders[i];
        let at = border.x + vec3<f32>(dot(a, border.yz), dot(b, border.yz), dot(c, border.yz));
        if all(at < vec3<f32>(0.0)) {
            return OUTSIDE;
        }
        if any(at < vec3<f32>(0.0)) {
            across |= 1u << i;
        }
    }
    return across;
}
