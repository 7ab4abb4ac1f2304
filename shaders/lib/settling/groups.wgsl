// Rows of drawn parts after the first ones are groups of settled triangles: their samples are moved to the side they lie on.

#define_import_path cutaway::settling

#import cutaway::settled_depth::settled_z
#import cutaway::sweep::{Sample, sweep}

fn settle(sample: Sample) -> Sample {
    var moved = sample;
    if sample.row >= sweep.first_group {
        moved.z = settled_z(sample.z, sample.at, sample.row - sweep.first_group, sample.front);
    }
    return moved;
}
