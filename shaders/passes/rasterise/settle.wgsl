// Decides the pixels in which no crossing can matter, which show their nearest kept surface, and lists all others. A slab matters if a
// fragment is within it, or if the number of a part's fragments behind it is odd. Either all lanes are zero: no slab matters. Or the surface
// is in front of all slabs that do, the number of all fragments is even, and none was lost. In core WebGPU the triangle is claimed and added
// later (`settled.wgsl`). Workgroups share the touched tiles, an invocation owns a pixel of each.

#import cutaway::frame::{depth_from_buffer, frame, pixel_index}
#import cutaway::layers::{SURFACE, WORDS_PER_PIXEL, layer_word}
#import cutaway::parity::all_bits
#import cutaway::share::{pixel_at, turns}
#import cutaway::slab_bits::slab_bits
#import cutaway::slabs::slab_sides
#import cutaway::touched::{TILE_PX, tile_at, tile_count}
#import cutaway::touched_list::touched

// As in `lib/lists/pixel_list.wgsl`.
struct PixelList {
    count: atomic<u32>,
    words: array<u32>,
}

@group(1) @binding(3) var<storage, read_write> layers: array<u32>;
// Code of the triangle, and its depth-buffer value as bits.
@group(1) @binding(5) var<storage, read> nearest: array<vec2<u32>>;
@group(1) @binding(6) var<storage, read> within_list: array<u32>;
@group(1) @binding(7) var<storage, read_write> pixel_list: PixelList;
// Workgroups over the listed pixels, then those over the listed samples: three words each.
@group(2) @binding(9) var<storage, read_write> listed_groups: array<atomic<u32>>;

override lane_bits: u32 = 32u;

// Puts the depth range of a tile into the list, because the pass that reads the list has no binding to spare.
fn copy_reach(tile: u32) {
    let reach = max(touched.reach, touched.tiles[tile].reach);
    pixel_list.words[2u * tile] = reach.x;
    pixel_list.words[2u * tile + 1u] = reach.y;
}

// Workgroups of a dispatch in one dimension, by core WebGPU.
const MOST_GROUPS: u32 = 65535u;
// Four turns of a workgroup: drivers that run shaders on a CPU load uniforms once per invocation.
const PIXELS_OF_GROUP: u32 = 1024u;
const SAMPLES_OF_GROUP: u32 = 256u;

fn list_pixel(xy: vec2<u32>) {
    let place = atomicAdd(&pixel_list.count, 1u);
    pixel_list.words[2u * tile_count() + place] = xy.x | (xy.y << 16u);
    if place % PIXELS_OF_GROUP == 0u {
        atomicMax(&listed_groups[0], min(place / PIXELS_OF_GROUP + 1u, MOST_GROUPS));
    }
}

// True if a fragment is in front of these slabs.
fn is_before(slabs: u32, z: f32, xy: vec2<u32>) -> bool {
    let sides = slab_sides(z, xy);
    return ((sides.within | sides.behind) & slabs) == 0u;
}

fn settle(xy: vec2<u32>) {
    let pixel = pixel_index(xy);
    let found = nearest[pixel];
    let word = all_bits(pixel);
    let bits = slab_bits(word, lane_bits);
    let is_sure = found.y != 0u && !bits.is_total_odd && !bits.is_lost;
    if word != 0u && !(is_sure && is_before(bits.odd | bits.within, bitcast<f32>(found.y), xy)) {
        list_pixel(xy);
        return;
    }
    let first = pixel * WORDS_PER_PIXEL;
    layers[first + 2u] = bitcast<u32>(depth_from_buffer(bitcast<f32>(found.y)));
    if found.y != 0u {
        layers[first] = layer_word(SURFACE, 0u, 0u);
        layers[first + 1u] = found.x;
    }
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
) {
    if group.x == 0u && all(local.xy == vec2<u32>(0u)) {
        let samples = min(within_list[0], arrayLength(&within_list) / 4u - 1u);
        atomicStore(&listed_groups[3], min((samples + SAMPLES_OF_GROUP - 1u) / SAMPLES_OF_GROUP, MOST_GROUPS));
    }
    let end = turns(group, groups);
    for (var turn = 0u; turn < end; turn++) {
        let xy = pixel_at(turn, group, groups, local);
        if all(xy < frame.size_px) {
            settle(xy);
            if all(local.xy == vec2<u32>(0u)) {
                copy_reach(tile_at(xy / TILE_PX));
            }
        }
    }
}
