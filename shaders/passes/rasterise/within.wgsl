// Decides the listed samples within slabs, now that the crossings of their pixels are known: each toggles the bits of those crossings in
// front of it that are in its slabs, and may be the nearest kept sample of its pixel (the open module `keeping`). An invocation owns a sample.

#import cutaway::claims::{is_front, triangle_of}
#import cutaway::crossings::{crossings_before, head_of, surface_at}
#import cutaway::cuts::is_removed
#import cutaway::exits::is_passed
#import cutaway::frame::{pixel_count, pixel_index}
#import cutaway::keeping::keep_nearest
#import cutaway::lanes::CROSSINGS_OF_A_WORD
#import cutaway::layers::{BACKGROUND, WORDS_PER_PIXEL, kind_of}
#import cutaway::sweep::{Sample, drawn_parts}
#import cutaway::touched::turns_among
#import cutaway::within_words::{row_of_word, slabs_of_word}

struct WithinList {
    count: u32,
    padding: array<u32, 3>,
    samples: array<vec4<u32>>,
}

@group(1) @binding(3) var<storage, read> layers: array<u32>;
@group(1) @binding(4) var<storage, read_write> mask: array<atomic<u32>>;
@group(1) @binding(6) var<storage, read> within_list: WithinList;
@group(1) @binding(7) var<storage, read_write> need: array<atomic<u32>>;

// False if an earlier pass has marked the samples.
override marks: bool = true;

// The bits of those of the first `behind` crossings whose clip-surfaces are given.
fn crossings_in_slabs(at: vec2<u32>, behind: u32, slabs: u32) -> u32 {
    let head = head_of(at);
    var bits = 0u;
    for (var i = 0u; i < min(behind, CROSSINGS_OF_A_WORD); i++) {
        bits |= ((slabs >> surface_at(head, i, at)) & 1u) << i;
    }
    return bits;
}

fn decide_sample(entry: vec4<u32>) {
    let at = vec2<u32>(entry.x & 0xffffu, entry.x >> 16u);
    let pixel = pixel_index(at);
    if kind_of(layers[pixel * WORDS_PER_PIXEL]) != BACKGROUND {
        // The pixel is settled: its crossings were not computed.
        return;
    }
    let row = row_of_word(entry.w);
    let part = drawn_parts.parts[row];
    let sample = Sample(at, bitcast<f32>(entry.y), triangle_of(entry.z), row, part, is_front(entry.z), 0u);
    let before = crossings_before(sample.z, at);
    if marks {
        let bits = crossings_in_slabs(at, before.behind, slabs_of_word(entry.w));
        atomicXor(&mask[part.lane_word * pixel_count() + pixel], bits << part.lane_shift);
    }
    if !is_removed(before.sides, part.cuts) && !is_passed(sample.front) {
        keep_nearest(sample);
    }
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let count = min(within_list.count, arrayLength(&within_list.samples));
    let end = turns_among((count + 63u) / 64u, group.x, groups.x);
    for (var turn = 0u; turn < end; turn++) {
        let place = (group.x + turn * groups.x) * 64u + local;
        if place < count {
            decide_sample(within_list.samples[place]);
        }
    }
    if group.x == 0u && local == 0u {
        atomicMax(&need[2], within_list.count);
    }
}
