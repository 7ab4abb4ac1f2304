// The side of a sheet on which a point lies, for an adaptive tessellation: its height over the triangle below it, found by repeating the
// halvings. Time in proportion to the number of halvings, if the point is within the height slab.

#define_import_path cutaway::sheet_side

#import cutaway::bisection::{half_of, middle_of, root_of}
#import cutaway::cuts::cut_table
#import cutaway::domain::{domains, relief_at}
#import cutaway::refinement::is_halved

// Distance of a point on the kept side of the sheet, along the plane's normal; negative where removed.
fn height_over_sheet(surface: u32, point: vec3<f32>) -> f32 {
    // Beyond the slab of all heights the side is known without the triangles, and so is a lower bound on the distance.
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

    // Of the patch's two triangles, the one on the point's side of the diagonal.
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
