// The sum of each block of words. A workgroup owns a block.

#import cutaway::scan::{BLOCK_WORDS, ROUNDS, run_of, sum_of_own}
#import cutaway::sums::sums_before

override first: u32 = 0u;
override length: u32 = 1u;
override count_at: u32 = 0xffffffffu;

@group(0) @binding(1) var<storage, read_write> sums: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) invocation: u32) {
    let run = run_of(first, length, count_at, invocation);
    if group.x * BLOCK_WORDS >= run.length {
        if invocation == 0u {
            sums[group.x] = 0u;
        }
        return;
    }
    let all = sums_before(sum_of_own(group.x, run, invocation), invocation, ROUNDS);
    if invocation == 0u {
        sums[group.x] = all.y;
    }
}
