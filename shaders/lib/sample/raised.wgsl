// What a covered sample does where a list of crossings is known, in core WebGPU: two sweeps of 32 bits.
//
// The first counts the crossings before the sample, stores the data for the inside test (the open module `store`), and
// raises the pixel's depth if it is kept. The second, once all depths are known, sets the triangle.

#define_import_path cutaway::sample

#import cutaway::nearest::{claim, nearest_bits, raise}
#import cutaway::counting::{is_kept, count_and_store}
#import cutaway::frame::pixel_index
#import cutaway::classifying::classify
#import cutaway::sweep::{Sample, sweep}

// Whether a later sweep is to see the triangle: not if each of its samples is removed or was behind another already.
fn take(found: Sample) -> bool {
    let sample = classify(found);
    if sweep.again == 0u {
        return count_and_store(sample) && raise(sample);
    }
    if bitcast<u32>(sample.z) == nearest_bits(pixel_index(sample.at)) && is_kept(sample) {
        claim(sample);
    }
    return false;
}
