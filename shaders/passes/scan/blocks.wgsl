// Exclusive sums over a block of words that begin with the sum of all blocks before it. A workgroup owns a block.

#import cutaway::scan::scan_block

override length: u32 = 1u;

@group(0) @binding(1) var<storage, read> sums: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    _ = scan_block(group.x, length, sums[group.x], invocation);
}
