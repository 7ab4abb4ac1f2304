//! Lists of fragments in a pool with too little room: what is looked at of them.

use crate::plans::words::answers;

/// Fragments that there is room for.
const CAPACITY: u32 = 40;

/// Fragments of each list.
const LENGTHS: [u32; 9] = [0, 3, 0, 30, 9, 5, 0, 4096, 2];

/// The longest list that is looked at, as `fragment_runs.wgsl` has it.
const LONGEST: u32 = 4096;

/// First fragment, end, and whether there was room for all, of each list.
fn runs(run_of: &str) -> Vec<Vec<u32>> {
    let count = LENGTHS.len();
    let shader = format!(
        "{run_of}
@group(1) @binding(7) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(16)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= {count}u {{ return; }}
    let run = run_of(id.x);
    words[3u * id.x] = run.first;
    words[3u * id.x + 1u] = run.end;
    words[3u * id.x + 2u] = u32(run.fits);
}}"
    );
    let ends = LENGTHS.iter().scan(0, |end, length| {
        *end += length;
        Some(*end)
    });
    let mut pool: Vec<u32> = ends.collect();
    pool.resize(count + CAPACITY as usize, 0);
    let inputs = [
        ("fragments", pool),
        ("pool", vec![count as u32, CAPACITY, 0, 0]),
    ];
    answers(&shader, &inputs, count, 3)
}

/// Lists that are not the fragments that found room.
fn wrong(given: &[Vec<u32>]) -> usize {
    let mut first = 0;
    let wanted = LENGTHS.map(|length| {
        let end = first + length;
        let fits = length == 0 || (end <= CAPACITY && length <= LONGEST);
        let wanted = [first.min(CAPACITY), end.min(CAPACITY), u32::from(fits)];
        first = end;
        wanted
    });
    let pairs = wanted.iter().zip(given);
    pairs.filter(|(wanted, run)| wanted[..] != run[..]).count()
}

#[test]
fn a_list_that_found_no_room_is_empty() {
    let own = "#import cutaway::fragment_runs::run_of";
    assert_eq!(wrong(&runs(own)), 0);
    // The control: without the clamp two lists begin beyond their ends, and a loop over one would not end for long.
    let unclamped = "#import cutaway::fragment_pool::pool
#import cutaway::fragment_runs::{Run, fragments}
fn run_of(list: u32) -> Run {
    var first = 0u;
    if list > 0u { first = fragments[list - 1u]; }
    let end = fragments[list];
    let fits = (end <= pool.capacity && end - first <= 4096u) || first == end;
    return Run(first, min(end, pool.capacity), fits);
}";
    assert!(wrong(&runs(unclamped)) >= 2);
}
