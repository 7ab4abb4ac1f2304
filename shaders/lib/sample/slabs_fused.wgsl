// Processing of a covered sample by slabs and with 64-bit atomics: one sweep. What lies within a slab is listed, and decided once the
// crossings are known.

#define_import_path cutaway::sample

#import cutaway::nearest_wide::keep
#import cutaway::slab_counting::mark_sample
#import cutaway::sweep::Sample

// Returns false: no later sweep needs to visit the triangle.
fn take(sample: Sample) -> bool {
    if mark_sample(sample) {
        keep(sample);
    }
    return false;
}
