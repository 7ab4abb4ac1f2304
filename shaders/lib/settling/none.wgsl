// No triangle of the frame is settled: every sample keeps its depth.

#define_import_path cutaway::settling

#import cutaway::sweep::Sample

fn settle(sample: Sample) -> Sample {
    return sample;
}
