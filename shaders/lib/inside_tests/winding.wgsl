// Winding numbers in words: four signed bytes summed in one word, and a word that checks the sums.
//
// Bytes are summed by one addition of the whole word, so a byte that goes below 0 borrows from the next; when the bytes are separated from
// the lowest up, modulo 2^32, each returns what it borrowed. Order does not matter, nor do intermediate values: the result is exact if each
// final sum is within -128 to 127.

#define_import_path cutaway::winding

// 1 in each of the first `count` bytes, 1 to 4.
fn ones(count: u32) -> u32 {
    return 0x01010101u >> (32u - 8u * count);
}

// Byte `index` of a word, 0 to 3, as a signed sum.
fn count_at(word: u32, index: u32) -> i32 {
    var rest = word;
    var count = 0;
    for (var i = 0u; i <= min(index, 3u); i++) {
        count = (bitcast<i32>(rest) << 24u) >> 24u;
        rest = (rest - bitcast<u32>(count)) >> 8u;
    }
    return count;
}

// A fragment's contribution to the check word: its winding step in the lower half, 1 in the upper.
fn with_number(step: u32) -> u32 {
    return step + 0x10000u;
}

// The sum of all steps, and their number.
fn sum_and_number(word: u32) -> vec2<i32> {
    let sum = (bitcast<i32>(word) << 16u) >> 16u;
    return vec2<i32>(sum, bitcast<i32>((word - bitcast<u32>(sum)) >> 16u));
}

// True if some partial sum of the steps may exceed a byte: more than 127 steps have the same sign.
fn may_exceed(sum_and_number: vec2<i32>) -> bool {
    return abs(sum_and_number.x) + sum_and_number.y > 254;
}
