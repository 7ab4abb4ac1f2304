// In core WebGPU, once all depths are known: the triangle at the pixel's depth.

#define_import_path cutaway::keeping

#import cutaway::frame::pixel_index
#import cutaway::nearest::{claim, nearest_bits}
#import cutaway::sweep::Sample

fn keep_nearest(sample: Sample) {
    if bitcast<u32>(sample.z) == nearest_bits(pixel_index(sample.at)) {
        claim(sample);
    }
}
