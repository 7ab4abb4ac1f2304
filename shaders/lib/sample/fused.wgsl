// Processing of a covered sample with a list of crossings and 64-bit atomics: one sweep.
//
// It counts the crossings in front of the sample, stores the data for the inside test (the open module `store`), and keeps the nearest kept
// triangle, depth and number in one word.

#define_import_path cutaway::sample

#import cutaway::nearest_wide::keep
#import cutaway::counting::count_and_store
#import cutaway::classifying::classify
#import cutaway::sweep::Sample

// Returns false: no later sweep needs to visit the triangle.
fn take(found: Sample) -> bool {
    let sample = classify(found);
    if count_and_store(sample) {
        keep(sample);
    }
    return false;
}
