// Converts triangle counts into index counts to draw, limited to the capacity, and reports the largest count of any clip-surface.

#import cutaway::cuts::MAX_SURFACES

@group(0) @binding(0) var<storage, read_write> arguments: array<u32>;
@group(1) @binding(3) var<storage, read_write> need: array<u32>;

// Number of tessellated clip-surfaces, and the capacity of each in triangles.
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
