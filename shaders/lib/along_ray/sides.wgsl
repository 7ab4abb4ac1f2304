// On which side of the clip-surfaces a point lies, by the relief height over it: one map lookup per relief (the open module
// `height_filter`). Used by tests at points, not along rays.

#define_import_path cutaway::sides

#import cutaway::cuts::{MAX_SURFACES, NO_RELIEF, cut_table}
#import cutaway::height_filter::filtered_height

// Distance of a point on the kept side: height over the plane plus the relief's; negative where removed.
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
