// Processing of a covered sample by slabs in core WebGPU: two 32-bit sweeps, between which the samples within slabs are decided.
//
// The first marks lanes, and raises the pixel's depth if the sample is known to be kept. The second, once all depths are known, sets the
// triangle.

#define_import_path cutaway::sample

#import cutaway::frame::pixel_index
#import cutaway::nearest::{claim, nearest_bits, raise}
#import cutaway::slab_counting::{is_kept_for_certain, mark_sample}
#import cutaway::sweep::{Sample, sweep}

// Returns true if a later sweep must visit the triangle, because the sample is neither removed nor already hidden.
fn take(sample: Sample) -> bool {
    if sweep.again == 0u {
        return mark_sample(sample) && raise(sample);
    }
    if bitcast<u32>(sample.z) == nearest_bits(pixel_index(sample.at)) && is_kept_for_certain(sample) {
        claim(sample);
    }
    return false;
}
