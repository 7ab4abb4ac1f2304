// Linear blend skinning: a vertex is moved by the weighted mean of its joint matrices (Magnenat-Thalmann, Laperriere and Thalmann 1988).
// Time in proportion to the joint influences per vertex.

#define_import_path cutaway::skin

#import cutaway::pose::{Standing, pose, standing_by}
#import cutaway::position::position_of_vertex

// For each position and one past the last, the word at which its joint influences begin; then the influences: matrix, weight as bits.
@group(1) @binding(5) var<storage, read> pulls: array<u32>;
// Three rows per matrix.
@group(1) @binding(6) var<storage, read> joints: array<vec4<f32>>;

// Most joints that influence one position.
const MOST_JOINTS: u32 = 1024u;

fn skinned(at: Standing, vertex: u32) -> Standing {
    let position = position_of_vertex[vertex];
    let first = pulls[position];
    let count = (pulls[position + 1u] - first) / 2u;
    var rows = array<vec4<f32>, 3>();
    for (var n = 0u; n < min(count, MOST_JOINTS); n++) {
        let i = first + 2u * n;
        // A joint missing from the pose moves nothing, as matrix 0 does.
        let joint = select(0u, pulls[i], pulls[i] < pose.joint_count);
        let weight = bitcast<f32>(pulls[i + 1u]);
        rows[0] += weight * joints[3u * joint];
        rows[1] += weight * joints[3u * joint + 1u];
        rows[2] += weight * joints[3u * joint + 2u];
    }
    return standing_by(rows, at);
}
