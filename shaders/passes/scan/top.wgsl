// Exclusive sums over words that fit one block, and the total: the single workgroup at the top of a prefix sum.

#import cutaway::scan::{run_of, scan_block}

override first: u32 = 0u;
override length: u32 = 1u;
override count_at: u32 = 0xffffffffu;
// Index of the word that receives the total.
override total_at: u32 = 0u;
// The total is written as a dispatch size in x, y and z: that many workgroups, or a few more if they take several rows.
override as_groups: bool = false;

// Most workgroups in a row: half of what WebGPU guarantees.
const GROUPS_OF_ROW: u32 = 32768u;

@group(0) @binding(1) var<storage, read_write> total: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) invocation: u32) {
    let all = scan_block(0u, run_of(first, length, count_at, invocation), 0u, invocation);
    if invocation != 0u {
        return;
    }
    if as_groups {
        let rows = max((all + GROUPS_OF_ROW - 1u) / GROUPS_OF_ROW, 1u);
        total[total_at] = (all + rows - 1u) / rows;
        total[total_at + 1u] = rows;
        total[total_at + 2u] = 1u;
    } else {
        total[total_at] = all;
    }
}
