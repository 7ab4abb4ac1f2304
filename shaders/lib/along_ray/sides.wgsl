// The sides of the clip-surfaces on which a point lies, from the height of the relief there: one map lookup per relief (the open module
// `height_filter`). Used by tests at points, not along rays.

#define_import_path cutaway::sides

#import cutaway::cuts::{MAX_SURFACES, NO_RELIEF, cut_table}
#import cutaway::height_filter::filtered_height

// Height of a point above the relief: its height over the plane plus the relief's. Positive if kept, negative if removed.
fn kept_height(surface: u32, point: vec3<f32>) -> f32 {
    let p = vec4<f32>(point, 1.0);
    let over_plane = dot(cut_table.surfaces[surface].height_row, p);
    if cut_table.surfaces[surface].first_texel == NO_RELIEF {
        return over_plane;
    }
    let texel = vec2<f32>(dot(cut_table.surfaces[surface].texel_x_row, p), dot(cut_table.surfaces[surface].texel_y_row, p));
    return over_plane + filtered_height(surface, texel) * cut_table.surfaces[surface].scale.z;
}

// Sides of a point with respect to all clip-surfaces.
fn sides_of(point: vec3<f32>) -> u32 {
    var sides = 0u;
    for (var s = 0u; s < min(cut_table.surface_count, MAX_SURFACES); s++) {
        if kept_height(s, point) < 0.0 {
            sides |= 1u << s;
        }
    }
    return sides;
}
