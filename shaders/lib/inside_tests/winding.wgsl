// Winding numbers in words: four signed bytes added up in one word, and the word that checks them.
//
// Bytes are summed by one addition of the whole word, so a byte that goes below 0 borrows from the next; taken apart from the
// lowest up, in arithmetic modulo 2^32, each gives back what it borrowed. Order does not matter, and what a byte passes on the
// way does not either: exact where each sum ends within -128 to 127.

#define_import_path cutaway::winding

// 1 in each of the first `count` bytes, 1 to 4.
fn ones(count: u32) -> u32 {
    return 0x01010101u >> (32u - 8u * count);
}

// A word of which each byte `index`, 0 to 3, is the sum.
fn count_at(word: u32, index: u32) -> i32 {
    var rest = word;
    var count = 0;
    for (var i = 0u; i <= min(index, 3u); i++) {
        count = (bitcast<i32>(rest) << 24u) >> 24u;
        rest = (rest - bitcast<u32>(count)) >> 8u;
    }
    return count;
}

// What a fragment adds to the word that checks: its step in the lower half, 1 in the upper.
fn with_number(step: u32) -> u32 {
    return step + 0x10000u;
}

// The sum of all steps, and how many there were.
fn sum_and_number(word: u32) -> vec2<i32> {
    let sum = (bitcast<i32>(word) << 16u) >> 16u;
    return vec2<i32>(sum, bitcast<i32>((word - bitcast<u32>(sum)) >> 16u));
}

// Whether the sums of some of these steps may be beyond a byte: more than 127 of them go the same way.
fn may_exceed(sum_and_number: vec2<i32>) -> bool {
    return abs(sum_and_number.x) + sum_and_number.y > 254;
}
