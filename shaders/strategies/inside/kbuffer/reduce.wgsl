// Converts a pixel's counts and nearest depths into its mask words: the fragments behind a crossing are all but those in front of it. A
// crossing behind the last stored depth may have more in front than are known. An invocation owns a pixel.

#import cutaway::cascade::{MOST_SLOTS, cascade, first_word}
#import cutaway::crossings::{head_of, z_at}
#import cutaway::cuts::parts
#import cutaway::frame::{frame, is_behind, pixel_count, pixel_index}
#import cutaway::lanes::MOST_LANES
#import cutaway::reduced::{clear_words, doubt, toggle, toggle_bit}

override lane_bits: u32 = 32u;

@group(1) @binding(5) var<storage, read> slots: array<u32>;
@group(1) @binding(7) var<storage, read_write> need: array<atomic<u32>>;

// Word that receives the largest count of an uncertain pixel.
override need_at: u32 = 0u;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    clear_words(pixel);
    let head = head_of(id.xy);
    for (var place = 0u; place < min(cascade.lanes, MOST_LANES); place++) {
        let first = first_word(place, pixel);
        let count = slots[first];
        let kept = min(count, min(cascade.slots, MOST_SLOTS));
        let lane_word = parts[place].lane_word;
        let lane_shift = parts[place].lane_shift;
        if (count & 1u) != 0u {
            toggle_bit(pixel, lane_word, lane_shift, lane_bits - 1u);
        }
        var bits = 0u;
        var in_front = 0u;
        for (var i = 0u; i < head.count; i++) {
            let crossing = z_at(head, i, id.xy);
            for (var k = in_front; k < kept; k++) {
                if is_behind(bitcast<f32>(slots[first + (k + 1u) * pixel_count()]), crossing) {
                    break;
                }
                in_front += 1u;
            }
            if in_front == cascade.slots && count > cascade.slots {
                doubt(pixel);
                atomicMax(&need[need_at], count);
            }
            bits |= ((count - in_front) & 1u) << (i % 32u);
            if i % 32u == 31u || i + 1u == head.count {
                toggle(pixel, lane_word + i / 32u, bits << lane_shift);
                bits = 0u;
            }
        }
    }
}
