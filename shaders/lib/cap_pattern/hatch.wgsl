// Caps are hatched.

#define_import_path cutaway::cap_pattern

#import cutaway::hatching::{footing_of, has_hatch, hatch_cover, part_hatches}
#import cutaway::layers::clip_surface_of

fn patterned(color: vec3<f32>, at: vec2<u32>, word: u32, depth: f32, normal: vec3<f32>, place: u32) -> vec3<f32> {
    if !has_hatch(word, place) {
        return color;
    }
    let hatch = part_hatches[place];
    let footing = footing_of(at, clip_surface_of(word), depth, normal, hatch);
    return mix(color, hatch.color.rgb, hatch.alpha * hatch_cover(hatch, footing));
}
