// Deformers, some of which inflate: these need the outward direction.

#define_import_path cutaway::deform

#import cutaway::deformers::{MOST_DEFORMERS, deformed_by}
#import cutaway::pose::{Standing, pose}
#import cutaway::position::position_of_vertex

// Three numbers for each position: a unit vector, or zero.
@group(1) @binding(7) var<storage, read> outward: array<f32>;

fn outward_at(vertex: u32) -> vec3<f32> {
    let first = 3u * position_of_vertex[vertex];
    return vec3<f32>(outward[first], outward[first + 1u], outward[first + 2u]);
}

fn deformed(at: Standing) -> Standing {
    var standing = at;
    for (var i = 0u; i < min(pose.deformer_count, MOST_DEFORMERS); i++) {
        standing = deformed_by(i, standing);
    }
    return standing;
}
