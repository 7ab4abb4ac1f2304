// Turns the fragments of a pixel into its words of the mask: each is behind the crossings before its depth, and XOR of these
// thermometers is what the mask would have held. An invocation owns a pixel.

#import cutaway::crossings::rank_of
#import cutaway::cuts::parts
#import cutaway::fragment_runs::{depth_of, owner_of, run_of}
#import cutaway::frame::{frame, pixel_index}
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
    let total = 1u << (lane_bits - 1u);
    // Parts are drawn one by one, so a word is rarely left and come back to.
    var word = 0u;
    var bits = 0u;
    for (var i = run.first; i < run.end; i++) {
        let owner = owner_of(i);
        if parts[owner].lane_word != word {
            toggle(pixel, word, bits);
            word = parts[owner].lane_word;
            bits = 0u;
        }
        let thermometer = (1u << rank_of(depth_of(i), pixel).behind) - 1u;
        bits ^= (thermometer | total) << parts[owner].lane_shift;
    }
    toggle(pixel, word, bits);
    if !run.fits {
        doubt(pixel);
    }
}
