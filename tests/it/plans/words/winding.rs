//! Winding numbers in the bytes of a word: summed by whole words, taken apart byte by byte.

use super::*;

/// Added to what is written, so that -1 is not what nobody wrote.
const OFFSET: i32 = 1_000_000;

/// What the four bytes of a word are to end at, and the steps that lead there in the order they come.
struct Case {
    counts: [i32; 4],
    /// Crossings that the fragment is behind, and its step.
    fragments: Vec<(u32, i32)>,
}

/// Fragments that make these counts: each is behind the first 1 to 4 crossings, so what the last one wants is done first.
fn case(counts: [i32; 4], random: &mut Random) -> Case {
    let mut fragments = Vec::new();
    let mut done = 0;
    for behind in (1..=4).rev() {
        let wanted = counts[behind - 1] - done;
        done += wanted;
        let step = if wanted < 0 { -1 } else { 1 };
        fragments.extend((0..wanted.abs()).map(|_| (behind as u32, step)));
        // Some that cancel, in between, so that bytes pass through what they do not end at.
        if random.bit() {
            fragments.extend((0..60).map(|_| (behind as u32, 1)));
            fragments.extend((0..60).map(|_| (behind as u32, -1)));
        }
    }
    for i in (1..fragments.len()).rev() {
        fragments.swap(i, random.below(i as u32 + 1) as usize);
    }
    Case { counts, fragments }
}

fn cases() -> Vec<Case> {
    let mut random = Random(256);
    let corners = [-127, -1, 0, 1, 127];
    let mut all: Vec<Case> = (0..625)
        .map(|i| [i % 5, i / 5 % 5, i / 25 % 5, i / 125])
        .map(|at| case(at.map(|i| corners[i]), &mut random))
        .collect();
    all.extend((0..600).map(|_| {
        let counts = [(); 4].map(|()| random.below(255) as i32 - 127);
        case(counts, &mut random)
    }));
    all
}

/// The counts of each byte, the sum and the number of the fragments, as the shaders find them.
fn found(cases: &[Case], decode: &str) -> Vec<Vec<u32>> {
    let shader = format!(
        "#import cutaway::winding::{{count_at, may_exceed, ones, sum_and_number, with_number}}
@group(2) @binding(0) var<storage, read> firsts: array<u32>;
@group(2) @binding(1) var<storage, read> fragments: array<u32>;
@group(2) @binding(2) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x + 1u >= arrayLength(&firsts) {{ return; }}
    var counts = 0u;
    var total = 0u;
    for (var i = firsts[id.x]; i < firsts[id.x + 1u]; i++) {{
        let step = select(1u, 0xffffffffu, fragments[i] >= 8u);
        counts += step * ones(fragments[i] % 8u);
        total += with_number(step);
    }}
    let sum = sum_and_number(total);
    for (var i = 0u; i < 4u; i++) {{
        words[7u * id.x + i] = bitcast<u32>({decode} + {OFFSET});
    }}
    words[7u * id.x + 4u] = bitcast<u32>(sum.x + {OFFSET});
    words[7u * id.x + 5u] = bitcast<u32>(sum.y + {OFFSET});
    words[7u * id.x + 6u] = select(0u, 1u, may_exceed(sum));
}}"
    );
    let mut firsts = vec![0];
    let mut fragments = Vec::new();
    for case in cases {
        fragments.extend((case.fragments.iter()).map(|(b, s)| b + if *s < 0 { 8 } else { 0 }));
        firsts.push(fragments.len() as u32);
    }
    let inputs = [("firsts", firsts), ("fragments", fragments)];
    let mut all = answers(&shader, &inputs, cases.len(), 7);
    for word in all.iter_mut().flat_map(|words| &mut words[..6]) {
        *word = word.wrapping_sub(OFFSET.cast_unsigned());
    }
    all
}

fn faults(cases: &[Case], found: &[Vec<u32>]) -> usize {
    let wrong = |(case, words): &(&Case, &Vec<u32>)| {
        let sum: i32 = case.fragments.iter().map(|(_, s)| s).sum();
        let number = case.fragments.len() as u32;
        let words: Vec<i32> = words.iter().map(|w| w.cast_signed()).collect();
        let ways = [1, -1].map(|s| case.fragments.iter().filter(|f| f.1 == s).count());
        words[..4] != case.counts
            || words[4] != sum
            || words[5] != number.cast_signed()
            || (words[6] == 1) != ways.iter().any(|w| *w > 127)
    };
    cases.iter().zip(found).filter(wrong).count()
}

#[test]
fn bytes_give_back_what_was_summed() {
    let cases = cases();
    assert_eq!(faults(&cases, &found(&cases, "count_at(counts, i)")), 0);
    // The control: a byte taken out as it stands has lent to the next.
    let naive = found(&cases, "(bitcast<i32>(counts << (24u - 8u * i)) >> 24u)");
    assert!(faults(&cases, &naive) > 300, "borrows are not noticed");
}

#[test]
fn what_ends_beyond_a_byte_is_vouched_for_by_nobody() {
    let beyond = |n: i32| Case {
        counts: [n, 0, 0, 0],
        fragments: (0..n.unsigned_abs()).map(|_| (1, n.signum())).collect(),
    };
    let cases: Vec<Case> = [127, 128, -127, -128, 300, -300].map(beyond).into();
    let found = found(&cases, "count_at(counts, i)");
    let seen: Vec<u32> = found.iter().map(|w| w[6]).collect();
    assert_eq!(seen, [0, 1, 0, 1, 1, 1], "127 are the most");
    assert_ne!(found[4][0], 300, "300 do not fit a byte");
}
