// Deformers that only move space: they need no mesh data.

#define_import_path cutaway::deform

#import cutaway::deformers::{MOST_DEFORMERS, deformed_by}
#import cutaway::pose::{Standing, pose}

fn outward_at(vertex: u32) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn deformed(at: Standing) -> Standing {
    var standing = at;
    for (var i = 0u; i < min(pose.deformer_count, MOST_DEFORMERS); i++) {
        standing = deformed_by(i, standing);
    }
    return standing;
}
