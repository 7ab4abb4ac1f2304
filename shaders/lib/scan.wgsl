// Exclusive sums over a block of words by one workgroup of 256: each invocation owns eight words in a row, and the sums of the
// invocations are added up in eight rounds of doubling reach (Hillis & Steele 1986). Bound as @group(0) @binding(0).
//
// Sums are of u32 and wrap: who calls keeps the total below 2^32.

#define_import_path cutaway::scan

// Words of a block; `src/passes/scan.rs` counts blocks by it.
const BLOCK_WORDS: u32 = 2048u;

@group(0) @binding(0) var<storage, read_write> items: array<u32>;

var<workgroup> reached: array<u32, 256>;

// The sum of the values of the invocations before this one, and of all.
fn sums_before(value: u32, invocation: u32) -> vec2<u32> {
    reached[invocation] = value;
    workgroupBarrier();
    for (var round = 0u; round < 8u; round++) {
        let reach = 1u << round;
        var sum = reached[invocation];
        if invocation >= reach {
            sum += reached[invocation - reach];
        }
        workgroupBarrier();
        reached[invocation] = sum;
        workgroupBarrier();
    }
    return vec2<u32>(reached[invocation] - value, reached[255]);
}

// The sum of this invocation's words of a block; words from `length` on do not count.
fn sum_of_own(block: u32, length: u32, invocation: u32) -> u32 {
    let first = block * BLOCK_WORDS + 8u * invocation;
    var sum = 0u;
    for (var k = 0u; k < 8u; k++) {
        if first + k < length {
            sum += items[first + k];
        }
    }
    return sum;
}

// Replaces each word of a block by `start` and the sum of the words before it in the block; returns the sum of the block.
fn scan_block(block: u32, length: u32, start: u32, invocation: u32) -> u32 {
    let sums = sums_before(sum_of_own(block, length, invocation), invocation);
    let first = block * BLOCK_WORDS + 8u * invocation;
    var sum = start + sums.x;
    for (var k = 0u; k < 8u; k++) {
        if first + k < length {
            let value = items[first + k];
            items[first + k] = sum;
            sum += value;
        }
    }
    return sums.y;
}
