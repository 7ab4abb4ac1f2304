//! Which sides are removed, and the inside mask: bits against brute force.

use cutaway::plan::pack::{CutTable, MAX_CUTS};

use crate::plans::words::{Random, answers, words_of};

const SEED: u64 = 0x51de;

/// A table of cuts of one to four clip-surfaces each.
fn table(random: &mut Random) -> CutTable {
    let mut table: CutTable = bytemuck::Zeroable::zeroed();
    table.cut_count = MAX_CUTS as u32;
    table.surface_count = 32;
    for bits in table.surfaces_of_cut.as_flattened_mut() {
        for _ in 0..=random.below(4) {
            *bits |= 1 << random.below(32);
        }
    }
    table
}

/// How many of some points, given by their sides and the cuts that apply, are wrongly removed or kept.
fn wrongly_removed(is_removed: &str, random: &mut Random) -> (usize, usize, usize) {
    let table = table(random);
    let mut cases: Vec<[u32; 2]> = vec![[0, 0], [!0, 0], [0, !0], [!0, !0]];
    for cut in 0..32 {
        // Exactly the sides of one cut, and all but one of them.
        let surfaces = table.surfaces_of_cut[cut / 4][cut % 4];
        cases.push([surfaces, 1 << cut]);
        cases.push([surfaces & (surfaces - 1), 1 << cut]);
        cases.push([surfaces, !(1 << cut)]);
    }
    for _ in 0..8000 {
        let sparse = random.word() as u32 & random.word() as u32;
        cases.push([random.word() as u32 & random.word() as u32, sparse]);
    }
    let shader = format!(
        "{is_removed}
@group(1) @binding(0) var<storage, read> cases: array<vec2<u32>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&cases) {{ return; }}
    words[id.x] = select(0u, 1u, is_removed(cases[id.x].x, cases[id.x].y));
}}"
    );
    let inputs = [
        ("cut_table", words_of(&[table])),
        ("cases", words_of(&cases)),
    ];
    let given = answers(&shader, &inputs, cases.len(), 1);
    let (mut wrong, mut removed) = (0, 0);
    for ([sides, cuts], words) in cases.iter().zip(given) {
        // The union over the cuts that apply of the intersections of the removed sides.
        let expected = (0..32).filter(|c| cuts >> c & 1 == 1).any(|c| {
            let surfaces = table.surfaces_of_cut[c / 4][c % 4];
            (0..32).all(|s| surfaces >> s & 1 == 0 || sides >> s & 1 == 1)
        });
        wrong += usize::from(words[0] != u32::from(expected));
        removed += usize::from(expected);
    }
    (wrong, removed, cases.len())
}

#[test]
fn cuts_are_a_union_of_intersections() {
    let random = &mut Random(SEED);
    for _ in 0..3 {
        let (wrong, removed, of) = wrongly_removed("#import cutaway::cuts::is_removed", random);
        assert_eq!(wrong, 0, "of {of}");
        assert!(
            removed > 500 && of - removed > 500,
            "{removed} of {of} are removed: too one-sided to say anything"
        );
    }
    let planted = "#import cutaway::cuts::surfaces_of_cut
fn is_removed(sides: u32, cuts: u32) -> bool {
    for (var cut = 0u; cut < 32u; cut++) {
        if ((cuts >> cut) & 1u) != 0u && (sides & surfaces_of_cut(cut)) != 0u { return true; }
    }
    return false;
}";
    let (wrong, _, of) = wrongly_removed(planted, random);
    assert!(
        wrong * 10 > of,
        "a union of unions is wrong, but only {wrong} of {of} show it"
    );
}

/// Lanes of a pixel, side by side in its words; and the fragments of the pixel, as (lane, crossings behind).
struct Pixel {
    fragments: Vec<(u32, u32)>,
}

/// The mask of some pixels after their fragments, in words of one pixel after the other.
fn ask_mask(
    add_fragment: &str,
    lane_bits: u32,
    words_per_pixel: u32,
    pixels: &[Pixel],
) -> Vec<Vec<u32>> {
    // Pixels follow each other inside a word's plane of the mask, so their number is part of its address.
    let frame_bytes = size_of::<cutaway::plan::pack::Frame>();
    let mut frame: cutaway::plan::pack::Frame = bytemuck::Zeroable::zeroed();
    frame.size_px = [pixels.len() as u32, 1];
    assert_eq!(words_of(&[frame]).len() * 4, frame_bytes, "the uniform");
    let longest = pixels.iter().map(|p| p.fragments.len()).max().unwrap_or(0);
    let mut rows: Vec<[u32; 4]> = Vec::new();
    for pixel in pixels {
        for i in 0..longest {
            rows.push(match pixel.fragments.get(i) {
                Some((lane, behind)) => {
                    let bit = lane * lane_bits;
                    [1, bit / 32, bit % 32, *behind]
                }
                None => [0; 4],
            });
        }
    }
    let shader = format!(
        "#import cutaway::frame::pixel_count
#import cutaway::lanes::thermometer
#import cutaway::mask::{{clear, mask}}
{add_fragment}
@group(2) @binding(0) var<storage, read> fragments: array<vec4<u32>>;
@group(2) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let pixel = id.x;
    if pixel >= pixel_count() {{ return; }}
    clear(pixel);
    for (var i = 0u; i < {longest}u; i++) {{
        let f = fragments[pixel * {longest}u + i];
        if f.x != 0u {{ add_fragment(pixel, f.y, f.z, {lane_bits}u, f.w); }}
    }}
    // In halves: a word of ones is a right answer.
    for (var w = 0u; w < {words_per_pixel}u; w++) {{
        let word = atomicLoad(&mask[w * pixel_count() + pixel]);
        words[2u * (pixel * {words_per_pixel}u + w)] = word & 0xffffu;
        words[2u * (pixel * {words_per_pixel}u + w) + 1u] = word >> 16u;
    }}
}}"
    );
    let inputs = [
        ("frame", words_of(&[frame])),
        // Last frame's bits are still there.
        (
            "mask",
            vec![0xdead_beef; pixels.len() * words_per_pixel as usize],
        ),
        ("fragments", words_of(&rows)),
    ];
    answers(&shader, &inputs, pixels.len(), 2 * words_per_pixel as usize)
        .iter()
        .map(|halves| halves.chunks(2).map(|h| h[0] | h[1] << 16).collect())
        .collect()
}

/// Lanes that do not say what the fragments say.
fn wrong_lanes(add_fragment: &str, lane_bits: u32) -> (usize, usize) {
    let random = &mut Random(SEED + u64::from(lane_bits));
    let words_per_pixel = (lane_bits / 16).max(2);
    let lanes = words_per_pixel * 32 / lane_bits;
    let mut pixels: Vec<Pixel> = Vec::new();
    // One fragment at each place: behind none, behind all.
    for behind in 0..lane_bits {
        pixels.push(Pixel {
            fragments: vec![(behind % lanes, behind)],
        });
    }
    for _ in 0..500 {
        let fragments = (0..random.below(12))
            .map(|_| (random.below(lanes), random.below(lane_bits)))
            .collect();
        pixels.push(Pixel { fragments });
    }
    let given = ask_mask(add_fragment, lane_bits, words_per_pixel, &pixels);
    let (mut wrong, mut of) = (0, 0);
    for (pixel, words) in pixels.iter().zip(given) {
        for lane in 0..lanes {
            let count = |is: &dyn Fn(u32) -> bool| {
                pixel
                    .fragments
                    .iter()
                    .filter(|(l, b)| *l == lane && is(*b))
                    .count() as u32
            };
            let bit = |i: u32| {
                let at = lane * lane_bits + i;
                words[at as usize / 32] >> (at % 32) & 1
            };
            let total = bit(lane_bits - 1) == count(&|_| true) & 1;
            let crossings = 0..lane_bits - 1;
            let all = crossings.map(|i| bit(i) == count(&|behind| behind > i) & 1);
            wrong += usize::from(!all.fold(total, |all, is| all & is));
            of += 1;
        }
    }
    (wrong, of)
}

#[test]
fn a_lane_holds_the_parity_behind_each_crossing() {
    for lane_bits in [2, 4, 8, 16, 32, 64, 96, 1024] {
        let (wrong, of) = wrong_lanes("#import cutaway::mask::add_fragment", lane_bits);
        assert_eq!(wrong, 0, "of {of} lanes of {lane_bits} bits");
        // The thermometer up to and including the crossing ahead.
        let planted = "fn add_fragment(pixel: u32, word: u32, shift: u32, lane_bits: u32, behind: u32) {
    let last = (lane_bits - 1u) / 32u;
    for (var w = 0u; w <= last; w++) {
        let total = select(0u, 1u << ((lane_bits - 1u) % 32u), w == last);
        atomicXor(&mask[(word + w) * pixel_count() + pixel], (thermometer(behind + 1u, w) | total) << shift);
    }
}";
        let (wrong, of) = wrong_lanes(planted, lane_bits);
        assert!(
            wrong * 20 > of,
            "{lane_bits} bits: only {wrong} of {of} lanes show one crossing too many"
        );
    }
}
