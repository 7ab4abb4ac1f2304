// No triangle of the frame is preclassified: every sample keeps its depth.

#define_import_path cutaway::classifying

#import cutaway::sweep::Sample

fn classify(sample: Sample) -> Sample {
    return sample;
}
