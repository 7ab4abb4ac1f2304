// On which side of a sheet a point lies, where the sheet is as fine as the view asks for: its height over the triangle below it, found
// by halving as it was made. Time in proportion to how often that is halved, where the point is within the slab of heights.

#define_import_path cutaway::sheet_side

#import cutaway::bisection::{half_of, middle_of, root_of}
#import cutaway::cuts::cut_table
#import cutaway::domain::{domains, relief_at}
#import cutaway::refinement::is_halved

// By how much a point is on the kept side of the sheet, along the normal of the plane; negative where removed.
fn height_over_sheet(surface: u32, point: vec3<f32>) -> f32 {
    // Beyond the slab of all heights the side is known without a look at the triangles, and no less than this far.
    let over_plane = dot(cut_table.surfaces[surface].height_row, vec4<f32>(point, 1.0));
    let slab = cut_table.surfaces[surface].slab;
    if over_plane + slab.x > 0.0 {
        return over_plane + slab.x;
    }
    if over_plane + slab.y < 0.0 {
        return over_plane + slab.y;
    }
    let from_corner = point - domains.surfaces[surface].corner.xyz;
    let x = domains.surfaces[surface].step_x.xyz;
    let y = domains.surfaces[surface].step_y.xyz;
    let at = vec2<f32>(dot(from_corner, x) / dot(x, x), dot(from_corner, y) / dot(y, y));
    let size = i32(1u << (domains.surfaces[surface].patch_bits + domains.surfaces[surface].step_bits));
    let last = vec2<f32>(domains.surfaces[surface].patches) - 1.0;
    let patch_at = vec2<i32>(clamp(floor(at / f32(size)), vec2<f32>(0.0), last));

    // Of either triangle of the patch, that on whose side of the diagonal the point is.
    var triangle = root_of(patch_at, false, size);
    let from_diagonal = at - vec2<f32>(middle_of(triangle));
    if dot(from_diagonal, vec2<f32>(triangle.apex - middle_of(triangle))) < 0.0 {
        triangle = root_of(patch_at, true, size);
    }
    for (var depth = 0u; depth < 32u; depth++) {
        if !is_halved(surface, triangle, depth) {
            break;
        }
        let towards_a = vec2<f32>(triangle.a - triangle.b);
        triangle = half_of(triangle, dot(at - vec2<f32>(middle_of(triangle)), towards_a) < 0.0);
    }
    let to_a = vec2<f32>(triangle.a - triangle.apex);
    let to_b = vec2<f32>(triangle.b - triangle.apex);
    let from_apex = at - vec2<f32>(triangle.apex);
    let along = vec2<f32>(dot(from_apex, to_a) / dot(to_a, to_a), dot(from_apex, to_b) / dot(to_b, to_b));
    let height = relief_at(surface, triangle.apex);
    let relief = height + along.x * (relief_at(surface, triangle.a) - height) + along.y * (relief_at(surface, triangle.b) - height);
    return over_plane + relief;
}
