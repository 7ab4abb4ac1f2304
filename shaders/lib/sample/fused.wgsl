// What a covered sample does where a list of crossings is known and atomics have 64 bits: one sweep.
//
// It counts the crossings before the sample, stores the data for the inside test (the open module `store`), and keeps
// the nearest kept triangle, depth and number in one word.

#define_import_path cutaway::sample

#import cutaway::nearest_wide::keep
#import cutaway::counting::count_and_store
#import cutaway::classifying::classify
#import cutaway::sweep::Sample

// No later sweep is to see the triangle.
fn take(found: Sample) -> bool {
    let sample = classify(found);
    if count_and_store(sample) {
        keep(sample);
    }
    return false;
}
