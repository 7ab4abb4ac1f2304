// Exclusive sums over a block of words that begin with the sum of all blocks before it. A workgroup owns a block.

#import cutaway::scan::{BLOCK_WORDS, run_of, scan_block}

override first: u32 = 0u;
override length: u32 = 1u;
override count_at: u32 = 0xffffffffu;

@group(0) @binding(1) var<storage, read> sums: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    let run = run_of(first, length, count_at, invocation);
    if group.x * BLOCK_WORDS >= run.length {
        return;
    }
    _ = scan_block(group.x, run, sums[group.x], invocation);
}
