// Builds five levels of the pyramids over offset maps in one dispatch. A workgroup owns a tile of 16 x 16 nodes of the lowest of them, each
// made by one invocation from the open module `pyramid_base`, and the nodes above it, made in shared memory.

#import cutaway::pyramid::{LOWEST, first_of, nodes_of, pyramid_table}
#import cutaway::pyramid_base::range_at
#import cutaway::pyramid_built::built

// The level below the first one built.
override from_level: u32 = 0u;

const SIDE: u32 = 16u;

var<workgroup> tile: array<vec2<f32>, 256>;

@compute @workgroup_size(16, 16)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let which = group.z;
    let size = pyramid_table.pyramids[which].map_size;
    let levels = select(0u, pyramid_table.pyramids[which].levels, pyramid_table.pyramids[which].is_own != 0u);
    let at = local.xy;
    // A missing node has an empty range.
    var range = vec2<f32>(3.4e38, -3.4e38);
    for (var i = 0u; i < 5u; i++) {
        let level = from_level + 1u + i;
        let side = SIDE >> i;
        let node = group.xy * side + at;
        let nodes = vec2<u32>(nodes_of(size.x, level), nodes_of(size.y, level));
        if level <= levels && all(at < vec2<u32>(side)) && all(node < nodes) {
            if i == 0u {
                range = range_at(which, level, node);
            }
            if level >= LOWEST {
                built[first_of(which, level) + node.y * nodes.x + node.x] = range;
            }
        }
        tile[at.y * SIDE + at.x] = range;
        workgroupBarrier();
        range = vec2<f32>(3.4e38, -3.4e38);
        if all(at < vec2<u32>(side / 2u)) {
            let first = 2u * (at.y * SIDE + at.x);
            let least = vec4<f32>(tile[first].x, tile[first + 1u].x, tile[first + SIDE].x, tile[first + SIDE + 1u].x);
            let greatest = vec4<f32>(tile[first].y, tile[first + 1u].y, tile[first + SIDE].y, tile[first + SIDE + 1u].y);
            range = vec2<f32>(
                min(min(least.x, least.y), min(least.z, least.w)),
                max(max(greatest.x, greatest.y), max(greatest.z, greatest.w)),
            );
        }
        workgroupBarrier();
    }
}
