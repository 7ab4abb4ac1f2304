// Exclusive sums over what fits one block, and the total: the one workgroup at the top of a prefix sum.

#import cutaway::scan::scan_block

override length: u32 = 1u;
// Word that the total goes to.
override total_at: u32 = 0u;

@group(0) @binding(1) var<storage, read_write> total: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) invocation: u32) {
    let all = scan_block(0u, length, 0u, invocation);
    if invocation == 0u {
        total[total_at] = all;
    }
}
