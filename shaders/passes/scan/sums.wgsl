// The sum of each block of words. A workgroup owns a block.

#import cutaway::scan::{sum_of_own, sums_before}

override length: u32 = 1u;

@group(0) @binding(1) var<storage, read_write> sums: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    let all = sums_before(sum_of_own(group.x, length, invocation), invocation);
    if invocation == 0u {
        sums[group.x] = all.y;
    }
}
