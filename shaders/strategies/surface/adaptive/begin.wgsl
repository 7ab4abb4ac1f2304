// Resets the numbers of triangles and of deep patches of every tessellated clip-surface to zero. One invocation owns one of them.

@group(0) @binding(0) var<storage, read_write> arguments: array<u32>;
@group(1) @binding(14) var<storage, read_write> deep_arguments: array<u32>;

// Number of tessellated clip-surfaces, and the capacity of each in triangles.
override count: u32 = 1u;
override capacity: u32 = 1u;

@compute @workgroup_size(32)
fn main(@builtin(local_invocation_index) slot: u32) {
    if slot >= count {
        return;
    }
    let first = 5u * slot;
    arguments[first] = 0u;
    arguments[first + 1u] = 1u;
    arguments[first + 2u] = 3u * capacity * slot;
    arguments[first + 3u] = 0u;
    arguments[first + 4u] = 0u;
    deep_arguments[3u * slot] = 0u;
    deep_arguments[3u * slot + 1u] = 1u;
    deep_arguments[3u * slot + 2u] = 1u;
}
