// Decides what each pixel shows, surface or cap, where the compute rasteriser found the surfaces: `resolve` without what only
// painted pixels need. One invocation owns one pixel.
//
// In the place of its normal a surface keeps the code of its triangle, a cap the word of its crossing. Pixels that
// are not background are listed: they are few in most pictures, and painting is dear.

#import cutaway::decision::{Drawn, decide, write}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::lanes::Lanes
#import cutaway::layers::{BACKGROUND, SURFACE, UNCOUNTED, UNRELIABLE, kind_of, layer_word}

// Code of the triangle, and its depth-buffer value as bits.
@group(1) @binding(5) var<storage, read> nearest: array<vec2<u32>>;
// How many pixels are to be painted, then their numbers.
@group(1) @binding(6) var<storage, read_write> painted: array<atomic<u32>>;

override lane_bits: u32 = 32u;
override lane_count: u32 = 1u;
override near_inside: bool = false;
override overlaps: bool = false;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let is_inside_picture = all(id.xy < frame.size_px);
    let pixel = pixel_index(id.xy);
    var slot = 0u;
    var is_painted = false;
    if is_inside_picture {
        let found = nearest[pixel];
        var drawn = Drawn(BACKGROUND, 0u, bitcast<f32>(found.y));
        if found.y != 0u {
            // A depth that no triangle claims is a fault of the rasteriser.
            drawn.word = select(layer_word(SURFACE, UNCOUNTED, 0u), UNRELIABLE, found.x == 0u);
            drawn.normal = found.x;
        }
        let decision = decide(id.xy, Lanes(lane_bits, lane_count, near_inside, overlaps), drawn);
        write(id.xy, decision, decision.crossing);
        is_painted = kind_of(decision.word) != BACKGROUND;
    }
    if is_painted {
        slot = atomicAdd(&painted[0], 1u);
        atomicStore(&painted[1u + slot], pixel);
    }
}
