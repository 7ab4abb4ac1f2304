// Processing of a covered sample with a list of crossings in core WebGPU: two 32-bit sweeps.
//
// The first counts the crossings in front of the sample, stores the data for the inside test (the open module `store`), and raises the
// pixel's depth if the sample is kept. The second, once all depths are known, sets the triangle.

#define_import_path cutaway::sample

#import cutaway::nearest::{claim, nearest_bits, raise}
#import cutaway::counting::{is_kept, count_and_store}
#import cutaway::frame::pixel_index
#import cutaway::classifying::classify
#import cutaway::sweep::{Sample, sweep}

// Returns true if a later sweep must visit the triangle, because the sample is neither removed nor already hidden.
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
