// The quads that become grids: a rectangle on the plane of each clip-surface, in cells. Bound as @group(1) @binding(7).

#define_import_path cutaway::quads

#import cutaway::cuts::{NO_RELIEF, cut_table}
#import cutaway::height_filter::filtered_height

struct Quad {
    // Corner of the quad and its steps per cell, in scene space.
    corner: vec4<f32>,
    step_u: vec4<f32>,
    step_v: vec4<f32>,
    // Cells along a side, in x.
    cells: vec4<u32>,
}

@group(1) @binding(7) var<storage, read> quads: array<Quad>;

// A point of the plane, given in cells from the corner.
fn plane_point(surface: u32, at: vec2<f32>) -> vec3<f32> {
    return quads[surface].corner.xyz + at.x * quads[surface].step_u.xyz + at.y * quads[surface].step_v.xyz;
}

// Height of the relief over a point of the plane, in scene units.
fn relief_over(surface: u32, point: vec3<f32>) -> f32 {
    if cut_table.surfaces[surface].first_texel == NO_RELIEF {
        return 0.0;
    }
    let p = vec4<f32>(point, 1.0);
    let texel = vec2<f32>(
        dot(cut_table.surfaces[surface].texel_x_row, p),
        dot(cut_table.surfaces[surface].texel_y_row, p),
    );
    return filtered_height(surface, texel) * cut_table.surfaces[surface].scale.z;
}
