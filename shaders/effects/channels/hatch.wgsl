// Writes the fraction of each pixel that a hatch covers, and the pixel's position on the plane of its cap in scene units.
// 0 where there is no hatch.

#import cutaway::cuts::place_of_part
#import cutaway::frame::{frame, pixel_index}
#import cutaway::hatching::{footing_of, has_hatch, hatch_cover, part_hatches}
#import cutaway::layers::{CAP, WORDS_PER_PIXEL, clip_surface_of, kind_of, part_of, unpack_normal}

@group(1) @binding(0) var<storage, read> layers: array<u32>;
@group(1) @binding(2) var<storage, read_write> hatched: array<vec4<f32>>;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    let first = pixel * WORDS_PER_PIXEL;
    let word = layers[first];
    hatched[pixel] = vec4<f32>(0.0);
    if kind_of(word) != CAP {
        return;
    }
    let place = place_of_part(part_of(word));
    if has_hatch(word, place) {
        let hatch = part_hatches[place];
        let normal = unpack_normal(layers[first + 1u]);
        let footing = footing_of(id.xy, clip_surface_of(word), bitcast<f32>(layers[first + 2u]), normal, hatch);
        hatched[pixel] = vec4<f32>(hatch_cover(hatch, footing), footing.uv, 0.0);
    }
}
