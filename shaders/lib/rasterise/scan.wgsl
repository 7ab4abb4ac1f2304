// Exclusive sums over a block of words by one workgroup of 256: each invocation owns eight consecutive words. Bound as @group(0)
// @binding(0).
//
// Sums are of u32 and wrap: the caller keeps the total below 2^32.

#define_import_path cutaway::scan

#import cutaway::sums::sums_before

// Words per block; `src/passes/draw/scan.rs` computes the number of blocks from it.
const BLOCK_WORDS: u32 = 2048u;
// Invocations of a workgroup, as a power of two.
const ROUNDS: u32 = 8u;

@group(0) @binding(0) var<storage, read_write> items: array<u32>;

// The words of `items` that are summed.
struct Run {
    first: u32,
    length: u32,
}

// Value that replaces a word index if the length is known beforehand.
const NOWHERE: u32 = 0xffffffffu;

var<workgroup> run_length: u32;

// The run of words from `first` on: `most` words, or fewer if word `count_at` of the buffer is less. The run is uniform over a workgroup,
// so a workgroup without any of the words may return early.
fn run_of(first: u32, most: u32, count_at: u32, invocation: u32) -> Run {
    if invocation == 0u {
        run_length = most;
        if count_at != NOWHERE {
            run_length = min(most, items[count_at]);
        }
    }
    return Run(first, workgroupUniformLoad(&run_length));
}

// The sum of this invocation's words of a block; words beyond the run do not count.
fn sum_of_own(block: u32, run: Run, invocation: u32) -> u32 {
    let first = block * BLOCK_WORDS + 8u * invocation;
    var sum = 0u;
    for (var k = 0u; k < 8u; k++) {
        if first + k < run.length {
            sum += items[run.first + first + k];
        }
    }
    return sum;
}

// Replaces each word of a block by `start` plus the sum of the words before it in the block; returns the sum of the block.
fn scan_block(block: u32, run: Run, start: u32, invocation: u32) -> u32 {
    let sums = sums_before(sum_of_own(block, run, invocation), invocation, ROUNDS);
    let first = block * BLOCK_WORDS + 8u * invocation;
    var sum = start + sums.x;
    for (var k = 0u; k < 8u; k++) {
        if first + k < run.length {
            let value = items[run.first + first + k];
            items[run.first + first + k] = sum;
            sum += value;
        }
    }
    return sums.y;
}
