// Turns numbers of triangles into numbers of indices to draw, of as many as found room, and reports how many there were in the
// clip-surface that has most.

#import cutaway::cuts::MAX_SURFACES

@group(0) @binding(0) var<storage, read_write> arguments: array<u32>;
@group(1) @binding(3) var<storage, read_write> need: array<u32>;

// How many clip-surfaces are tessellated, and the triangles that there is room for in each.
override count: u32 = 1u;
override capacity: u32 = 1u;

// Word of the need buffer.
const NEED_OF_TRIANGLES: u32 = 4u;

@compute @workgroup_size(1)
fn main() {
    var most = 0u;
    for (var slot = 0u; slot < min(count, MAX_SURFACES); slot++) {
        let made = arguments[5u * slot];
        most = max(most, made);
        arguments[5u * slot] = 3u * min(made, capacity);
    }
    need[NEED_OF_TRIANGLES] = most;
}
