// Morph targets: each moves a position by a weighted displacement. Time in proportion to the number of targets with a weight.

#define_import_path cutaway::morph

#import cutaway::pose::pose
#import cutaway::position::position_of_vertex

// Three numbers for each position, one target after another.
@group(1) @binding(3) var<storage, read> displacements: array<f32>;
// Number of the target, and its weight as bits.
@group(1) @binding(4) var<storage, read> weights: array<vec2<u32>>;

// Most targets with a weight at one time: `src/passes/frame/pose.rs`.
const MOST_TARGETS: u32 = 4096u;

fn morphed(point: vec3<f32>, vertex: u32) -> vec3<f32> {
    let position = position_of_vertex[vertex];
    var moved = point;
    for (var i = 0u; i < min(pose.weight_count, MOST_TARGETS); i++) {
        let first = 3u * (weights[i].x * pose.position_count + position);
        let by = vec3<f32>(displacements[first], displacements[first + 1u], displacements[first + 2u]);
        moved += bitcast<f32>(weights[i].y) * by;
    }
    return moved;
}
