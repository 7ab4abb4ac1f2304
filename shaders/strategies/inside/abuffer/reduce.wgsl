// Converts a pixel's fragments into its mask words: each is behind the crossings in front of its depth, and the XOR of these thermometers
// is what `mask` would have stored. An invocation owns a pixel.

#import cutaway::crossings::crossings_before
#import cutaway::cuts::parts
#import cutaway::fragment_runs::{MOST_FRAGMENTS, depth_of, owner_of, run_of}
#import cutaway::frame::{frame, pixel_index}
#import cutaway::lanes::{MOST_CROSSINGS, thermometer}
#import cutaway::reduced::{clear_words, doubt, toggle}

override lane_bits: u32 = 32u;

@compute @workgroup_size(16, 16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= frame.size_px) {
        return;
    }
    let pixel = pixel_index(id.xy);
    clear_words(pixel);
    let run = run_of(pixel);
    let total = 1u << ((lane_bits - 1u) % 32u);
    let before_last = max(lane_bits / 32u, 1u) - 1u;
    // Parts are drawn one by one, so the current word rarely changes back and forth. It is the last of its lane; earlier words are nonempty
    // only for fragments behind a crossing.
    var word = 0u;
    var bits = 0u;
    for (var n = 0u; n < min(run.end - run.first, MOST_FRAGMENTS); n++) {
        let i = run.first + n;
        let owner = owner_of(i);
        let first = parts[owner].lane_word;
        if first + before_last != word {
            toggle(pixel, word, bits);
            word = first + before_last;
            bits = 0u;
        }
        let behind = crossings_before(depth_of(i), id.xy).behind;
        for (var w = 0u; w < min((min(behind, MOST_CROSSINGS) + 31u) / 32u, before_last); w++) {
            toggle(pixel, first + w, thermometer(behind, w));
        }
        bits ^= (thermometer(behind, before_last) | total) << parts[owner].lane_shift;
    }
    toggle(pixel, word, bits);
    if !run.fits {
        doubt(pixel);
    }
}
