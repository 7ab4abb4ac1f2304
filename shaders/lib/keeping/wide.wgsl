// With 64-bit atomics: depth and triangle at once.

#define_import_path cutaway::keeping

#import cutaway::nearest_wide::keep
#import cutaway::sweep::Sample

fn keep_nearest(sample: Sample) {
    keep(sample);
}
