//! The list of crossings: insertion, overflow, ties, storage and rank against sorting on the CPU.

use cutaway::plan::Capacities;
use cutaway::plan::pack::{CutTable, Frame};

use crate::plans::words::{Random, answers_with, words_of};

const SEED: u64 = 0x11_57;
const MOST: usize = Capacities::MOST_CROSSINGS as usize;

#[derive(Clone, Copy, Debug)]
struct Crossing {
    z: f32,
    surface: u32,
    enters_kept: bool,
}

#[derive(Clone, Debug)]
struct Case {
    capacity: usize,
    crossings: Vec<Crossing>,
}

fn cases() -> Vec<Case> {
    let random = &mut Random(SEED);
    let mut all = Vec::new();
    for capacity in [1, 2, 3, 7, 15, 31, 38] {
        for _ in 0..120 {
            let count = random.below(2 * capacity + 4).min(40);
            // From a grid, so that equal depths are common and all others far apart.
            let crossings = (0..count)
                .map(|_| Crossing {
                    z: (1 + random.below(96)) as f32 / 128.0,
                    surface: random.below(32),
                    enters_kept: random.bit(),
                })
                .collect();
            all.push(Case {
                capacity: capacity as usize,
                crossings,
            });
        }
        // In order, against it, and all at one depth.
        let line = |z: &dyn Fn(usize) -> f32| Case {
            capacity: capacity as usize,
            crossings: (0..40)
                .map(|i| Crossing {
                    z: z(i),
                    surface: i as u32 % 32,
                    enters_kept: i % 2 == 0,
                })
                .collect(),
        };
        all.push(line(&|i| 1.0 - i as f32 / 64.0));
        all.push(line(&|i| 0.25 + i as f32 / 64.0));
        all.push(line(&|_| 0.5));
    }
    all
}

/// The crossings as they should be stored: nearest first, among equals first those that leave what is kept (`leaves_first`), of these
/// the last to come, and of the others the first.
fn sorted(case: &Case, leaves_first: bool) -> Vec<(f32, u32)> {
    let mut all: Vec<(usize, &Crossing)> = case.crossings.iter().enumerate().collect();
    all.sort_by(|(i, a), (j, b)| {
        let [a_first, b_first] = [a, b].map(|c| c.enters_kept != leaves_first);
        let by_arrival = if a_first { j.cmp(i) } else { i.cmp(j) };
        (b.z.total_cmp(&a.z))
            .then(b_first.cmp(&a_first))
            .then(by_arrival)
    });
    all.truncate(case.capacity);
    all.into_iter().map(|(_, c)| (c.z, c.surface)).collect()
}

fn frame(pixels: usize) -> Frame {
    let mut frame: Frame = bytemuck::Zeroable::zeroed();
    frame.size_px = [pixels as u32, 1];
    frame
}

fn cut_table(surface_count: u32) -> CutTable {
    let mut table: CutTable = bytemuck::Zeroable::zeroed();
    table.surface_count = surface_count;
    table
}

/// Words per case: head, sides, then z and surface of each place of the longest list, then the need so far.
const PER_CASE: usize = 2 + 2 * MOST + 1;

fn ask(cases: &[Case], surface_count: u32) -> Vec<Vec<u32>> {
    ask_after(cases, surface_count, false)
}

fn ask_after(cases: &[Case], surface_count: u32, cut_short: bool) -> Vec<Vec<u32>> {
    let shader = format!(
        "#import cutaway::crossing_list::{{List, add, finish, crossing_heads, crossing_z, crossing_surface, need}}
#import cutaway::frame::pixel_count
@group(2) @binding(0) var<storage, read> cases: array<array<u32, 122>>;
@group(2) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let pixel = id.x;
    if pixel >= pixel_count() {{ return; }}
    let capacity = cases[pixel][0];
    var list = List(pixel, capacity, 0u, 0x80000001u, {cut_short}, false);
    for (var i = 0u; i < cases[pixel][1]; i++) {{
        let what = cases[pixel][3u + 3u * i];
        let enters = cases[pixel][4u + 3u * i] != 0u;
        add(&list, bitcast<f32>(cases[pixel][2u + 3u * i]), what, enters);
    }}
    finish(&list);
    let at = pixel * {PER_CASE}u;
    words[at] = crossing_heads[pixel].x;
    words[at + 1u] = crossing_heads[pixel].y;
    for (var i = 0u; i < {MOST}u; i++) {{
        words[at + 2u + 2u * i] = 0u;
        words[at + 3u + 2u * i] = 0u;
        if i < capacity {{
            words[at + 2u + 2u * i] = bitcast<u32>(crossing_z[i * pixel_count() + pixel]);
            words[at + 3u + 2u * i] = crossing_surface[i * pixel_count() + pixel];
        }}
    }}
    words[at + {PER_CASE}u - 1u] = atomicLoad(&need[0]);
}}"
    );
    let rows: Vec<[u32; 122]> = cases
        .iter()
        .map(|case| {
            let mut row = [0; 122];
            row[0] = case.capacity as u32;
            row[1] = case.crossings.len() as u32;
            for (i, c) in case.crossings.iter().enumerate() {
                let words = [c.z.to_bits(), c.surface, u32::from(c.enters_kept)];
                row[2 + 3 * i..][..3].copy_from_slice(&words);
            }
            row
        })
        .collect();
    let n = cases.len();
    let inputs = [
        ("frame", words_of(&[frame(n)])),
        ("cut_table", words_of(&[cut_table(surface_count)])),
        ("crossing_heads", vec![UNTOUCHED; n * 2]),
        ("crossing_z", vec![UNTOUCHED; n * MOST]),
        ("crossing_surface", vec![UNTOUCHED; n * MOST]),
        ("need", vec![0]),
        ("cases", words_of(&rows)),
    ];
    answers_with(&shader, &["lib/surfaces/any.wgsl"], &inputs, n, PER_CASE)
}

/// What the buffers of the list hold before it is stored.
const UNTOUCHED: u32 = 0xabad_1dea;

/// Lists that are not what sorting gives.
fn faults(cases: &[Case], given: &[Vec<u32>], leaves_first: bool) -> Vec<String> {
    let mut faults = Vec::new();
    for (case, words) in cases.iter().zip(given) {
        let expected = sorted(case, leaves_first);
        let overflow = u32::from(case.crossings.len() > case.capacity) << 31;
        let mut wanted = vec![expected.len() as u32 | overflow, 0x8000_0001];
        for place in 0..MOST {
            match expected.get(place) {
                Some((z, surface)) => wanted.extend([z.to_bits(), *surface]),
                // Places beyond the list are not written.
                None if place < case.capacity => wanted.extend([UNTOUCHED; 2]),
                None => wanted.extend([0; 2]),
            }
        }
        if wanted[..] != words[..wanted.len()] {
            faults.push(format!("{case:?}: {words:x?} should be {wanted:x?}"));
        }
    }
    faults
}

#[test]
fn crossings_are_sorted_and_the_nearest_are_kept() {
    let cases = cases();
    let given = ask(&cases, 32);
    let found = faults(&cases, &given, true);
    assert!(
        found.is_empty(),
        "{} of {}: {:#?}",
        found.len(),
        cases.len(),
        &found[..found.len().min(2)]
    );
    let overflowing = cases
        .iter()
        .filter(|c| c.crossings.len() > c.capacity)
        .count();
    assert!(
        overflowing > 200 && cases.len() - overflowing > 200,
        "{overflowing} of {} overflow: too one-sided",
        cases.len()
    );
    // Ties in the other order are noticed.
    let reversed = faults(&cases, &given, false).len();
    assert!(
        reversed > cases.len() / 4,
        "{reversed} lists show a reversed tie"
    );
}

#[test]
fn an_overflow_reports_what_it_needed() {
    for (count, need) in [(3, 0), (4, 0), (5, 5), (40, 40)] {
        let case = Case {
            capacity: 4,
            crossings: vec![
                Crossing {
                    z: 0.5,
                    surface: 3,
                    enters_kept: true
                };
                count
            ],
        };
        let given = ask(&[case], 32);
        assert_eq!(given[0][PER_CASE - 1], need, "need of {count} crossings");
    }
}

#[test]
fn a_single_surface_is_not_stored() {
    let cases: Vec<Case> = cases().into_iter().take(200).collect();
    for words in ask(&cases, 1) {
        let surfaces = words[2..].iter().skip(1).step_by(2).take(MOST);
        let stored = surfaces.filter(|w| **w != UNTOUCHED && **w != 0).count();
        assert_eq!(stored, 0, "{words:x?}");
    }
}

/// Fragments that count otherwise than the definition.
fn wrong_counts(counting: &str, surface_count: u32) -> (usize, usize) {
    let random = &mut Random(SEED);
    let pixels = 600;
    let per_pixel = 12;
    let mut heads = Vec::new();
    let (mut z, mut surface) = (
        vec![UNTOUCHED; pixels * MOST],
        vec![UNTOUCHED; pixels * MOST],
    );
    let (mut fragments, mut expected) = (Vec::new(), Vec::new());
    for pixel in 0..pixels {
        // Short lists and long ones are searched in different ways.
        let longest = [8, 33, MOST as u32][pixel % 3];
        let count = random.below(longest + 1) as usize;
        let start = random.word() as u32 & 0x7fff_ffff;
        let mut depths: Vec<f32> = (0..count)
            .map(|_| (1 + random.below(40)) as f32 / 64.0)
            .collect();
        depths.sort_by(|a, b| b.total_cmp(a));
        let surfaces: Vec<u32> = (0..count).map(|_| random.below(surface_count)).collect();
        for i in 0..count {
            z[i * pixels + pixel] = depths[i].to_bits();
            surface[i * pixels + pixel] = surfaces[i];
        }
        // The mark of an overflow is no part of the count.
        heads.extend([count as u32 | u32::from(random.bit()) << 31, start]);
        for _ in 0..per_pixel {
            // On the same grid: a fragment at a crossing's depth is not behind it.
            let at = (1 + random.below(40)) as f32 / 64.0;
            fragments.push(at);
            let behind = depths.iter().filter(|d| at < **d).count();
            let sides = surfaces[..behind].iter().fold(start, |s, i| s ^ 1 << i);
            expected.push([behind as u32, sides]);
        }
    }
    let shader = format!(
        "{counting}
#import cutaway::frame::pixel_count
@group(2) @binding(0) var<storage, read> fragments: array<f32>;
@group(2) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&fragments) || pixel_count() == 0u {{ return; }}
    let rank = crossings_before(fragments[id.x], vec2<u32>(id.x / {per_pixel}u, 0u));
    words[2u * id.x] = rank.behind;
    words[2u * id.x + 1u] = rank.sides;
}}"
    );
    let inputs = [
        ("frame", words_of(&[frame(pixels)])),
        ("cut_table", words_of(&[cut_table(surface_count)])),
        ("crossing_heads", heads),
        ("crossing_z", z),
        ("crossing_surface", surface),
        ("fragments", words_of(&fragments)),
    ];
    let list = ["lib/crossings/list.wgsl", "lib/surfaces/any.wgsl"];
    let given = answers_with(&shader, &list, &inputs, fragments.len(), 2);
    let wrong = expected
        .iter()
        .zip(&given)
        .filter(|(e, g)| e[..] != g[..])
        .count();
    (wrong, fragments.len())
}

#[test]
fn a_fragment_is_behind_what_is_strictly_nearer() {
    for surface_count in [1, 2, 32] {
        let (wrong, of) = wrong_counts(
            "#import cutaway::crossings::crossings_before",
            surface_count,
        );
        assert_eq!(wrong, 0, "of {of} with {surface_count} surfaces");
        // With >= in the place of > a fragment lies behind its own depth.
        let planted = "#import cutaway::crossings::{head_of, surface_at, z_at}
#import cutaway::passed::Before
fn crossings_before(z: f32, at: vec2<u32>) -> Before {
    let head = head_of(at);
    var rank = Before(0u, head.sides);
    for (var i = 0u; i < head.count; i++) {
        if z > z_at(head, i, at) { break; }
        rank.behind++;
        rank.sides ^= 1u << surface_at(head, i, at);
    }
    return rank;
}";
        let (wrong, of) = wrong_counts(planted, surface_count);
        assert!(wrong * 10 > of, "only {wrong} of {of} show it");
    }
}

#[test]
fn a_walk_that_is_cut_short_is_told_and_claims_no_crossing_that_was_not_stored() {
    let cases = cases();
    let given = ask_after(&cases, 32, true);
    for (case, words) in cases.iter().zip(&given) {
        let stored = case.crossings.len().min(case.capacity) as u32;
        assert_eq!(words[0], stored | 1 << 31, "{case:?}");
        // What a longer walk would have found nobody knows: no longer list is asked for than was needed so far.
        let longest = cases.iter().map(|c| c.crossings.len()).max();
        assert!(
            words[PER_CASE - 1] as usize <= longest.unwrap_or(0),
            "{case:?}"
        );
    }
}
