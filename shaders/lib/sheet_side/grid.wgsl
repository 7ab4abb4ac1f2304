// The side of a sheet on which a point lies, for a grid: its height over the triangle of the cell below it.

#define_import_path cutaway::sheet_side

#import cutaway::cuts::cut_table
#import cutaway::quads::{plane_point, quads, relief_over}

fn height_of_vertex(surface: u32, at: vec2<f32>) -> f32 {
    return relief_over(surface, plane_point(surface, at));
}

// Distance of a point on the kept side of the sheet, along the plane's normal; negative where removed.
fn height_over_sheet(surface: u32, point: vec3<f32>) -> f32 {
    let from_corner = point - quads[surface].corner.xyz;
    let u = quads[surface].step_u.xyz;
    let v = quads[surface].step_v.xyz;
    let at = vec2<f32>(dot(from_corner, u) / dot(u, u), dot(from_corner, v) / dot(v, v));
    let cell = clamp(floor(at), vec2<f32>(0.0), vec2<f32>(f32(quads[surface].cells.x - 1u)));
    let within = at - cell;
    // The diagonal runs from the first to the last corner.
    let first = height_of_vertex(surface, cell);
    let last = height_of_vertex(surface, cell + 1.0);
    let is_below = within.x >= within.y;
    let third = height_of_vertex(surface, cell + select(vec2<f32>(0.0, 1.0), vec2<f32>(1.0, 0.0), is_below));
    let along = select(within.yx, within, is_below);
    let relief = first + along.x * (third - first) + along.y * (last - third);
    return dot(cut_table.surfaces[surface].height_row, vec4<f32>(point, 1.0)) + relief;
}
