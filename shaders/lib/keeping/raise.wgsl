// In core WebGPU, before the triangles are set: only the depth.

#define_import_path cutaway::keeping

#import cutaway::nearest::raise
#import cutaway::sweep::Sample

fn keep_nearest(sample: Sample) {
    _ = raise(sample);
}
