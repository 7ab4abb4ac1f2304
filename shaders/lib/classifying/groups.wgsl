// Rows of drawn parts after the first are groups of preclassified triangles: each sample is moved to the known side of its triangle.

#define_import_path cutaway::classifying

#import cutaway::preclassified_depth::preclassified_z
#import cutaway::sweep::{Sample, sweep}

fn classify(sample: Sample) -> Sample {
    var moved = sample;
    if sample.row >= sweep.first_group {
        moved.z = preclassified_z(sample.z, sample.at, sample.row - sweep.first_group, sample.front);
    }
    return moved;
}
