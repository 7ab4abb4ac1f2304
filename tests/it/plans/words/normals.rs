//! Octahedral normals and layer words: the twins of `pack::pack_normal` and `pack::unpack_normal`.

use cutaway::plan::pack::{pack_normal, unpack_normal};
use glam::{DVec3, Vec3};

use crate::plans::words::{Random, answers, words_of};

const SEED: u64 = 0x0c7a;

/// The angle that 16 bits leave. A step of the square is 1 / 32767, half of it is lost along either axis; the third
/// coordinate moves by the sum, so the point of the octahedron moves by at most sqrt(6) halves, and it is at least
/// 1 / sqrt(3) from the centre: sqrt(18) / 2 / 32767 = 6.5e-5 rad. Rounding in f32 adds 1e-6.
const MOST_ANGLE: f64 = 6.6e-5;

fn directions() -> Vec<Vec3> {
    let random = &mut Random(SEED);
    let mut all: Vec<Vec3> = (0..20_000)
        .map(|_| Vec3::new(random.signed(), random.signed(), random.signed()))
        .filter(|v| v.length() > 1e-3)
        .map(Vec3::normalize)
        .collect();
    // Axes, edges and faces of the octahedron, and what lies just beside them.
    for x in -1..=1 {
        for y in -1..=1 {
            for z in -1..=1 {
                let v = Vec3::new(x as f32, y as f32, z as f32);
                if v != Vec3::ZERO {
                    all.push(v.normalize());
                    for axis in Vec3::AXES {
                        all.push((v + axis * 1e-7).normalize());
                        all.push((v - axis * 1e-7).normalize());
                    }
                }
            }
        }
    }
    all.extend([Vec3::new(-0.0, 0.0, 1.0), Vec3::new(0.0, -0.0, -1.0)]);
    all
}

/// The angle between two vectors, exact for small ones as well.
fn angle(a: Vec3, b: Vec3) -> f64 {
    let (a, b): (DVec3, DVec3) = (a.as_dvec3(), b.as_dvec3());
    a.cross(b).length().atan2(a.dot(b))
}

fn ask_packed(pack_normal: &str, directions: &[Vec3]) -> Vec<u32> {
    let shader = format!(
        "{pack_normal}
@group(0) @binding(0) var<storage, read> directions: array<array<f32, 3>>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&directions) {{ return; }}
    let d = directions[id.x];
    let word = pack_normal(vec3<f32>(d[0], d[1], d[2]));
    words[2u * id.x] = word & 0xffffu;
    words[2u * id.x + 1u] = word >> 16u;
}}"
    );
    let rows: Vec<[f32; 3]> = directions.iter().map(|d| d.to_array()).collect();
    answers(
        &shader,
        &[("directions", words_of(&rows))],
        directions.len(),
        2,
    )
    .iter()
    .map(|w| w[0] | w[1] << 16)
    .collect()
}

fn ask_unpacked(packed: &[u32]) -> Vec<Vec3> {
    let shader = "#import cutaway::layers::unpack_normal
@group(0) @binding(0) var<storage, read> packed: array<u32>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&packed) { return; }
    let n = unpack_normal(packed[id.x]);
    words[3u * id.x] = bitcast<u32>(n.x);
    words[3u * id.x + 1u] = bitcast<u32>(n.y);
    words[3u * id.x + 2u] = bitcast<u32>(n.z);
}";
    answers(shader, &[("packed", packed.to_vec())], packed.len(), 3)
        .iter()
        .map(|w| {
            Vec3::new(
                f32::from_bits(w[0]),
                f32::from_bits(w[1]),
                f32::from_bits(w[2]),
            )
        })
        .collect()
}

/// The largest difference of two packed normals in steps, over both halves.
fn steps_apart(a: u32, b: u32) -> u32 {
    let half = |w: u32, shift: u32| i32::from((w >> shift) as u16 as i16);
    (half(a, 0).abs_diff(half(b, 0))).max(half(a, 16).abs_diff(half(b, 16)))
}

const LIBRARY: &str = "#import cutaway::layers::pack_normal";

#[test]
fn normals_pack_alike_on_both_sides() {
    let directions = directions();
    let given = ask_packed(LIBRARY, &directions);
    let expected: Vec<u32> = directions.iter().map(|d| pack_normal(*d)).collect();
    let mut differing = 0;
    for ((d, g), e) in directions.iter().zip(&given).zip(&expected) {
        // One step: WGSL leaves quotients 2.5 units in the last place and lets halves round either way.
        let apart = steps_apart(*g, *e);
        assert!(apart <= 1, "{d} packs to {g:08x} there, {e:08x} here");
        differing += usize::from(apart > 0);
        let off = angle(unpack_normal(*g), *d);
        assert!(off <= MOST_ANGLE, "{d} comes back {off} rad off");
    }
    // 2.5 units in the last place on either side of each of 32767 halves are 1 % of all quotients, in each of two halves.
    assert!(
        differing * 50 < directions.len(),
        "{differing} of {} differ by a step: too many for rounding",
        directions.len()
    );
}

#[test]
fn normals_unpack_alike_on_both_sides() {
    let random = &mut Random(SEED);
    let mut packed: Vec<u32> = (0..20_000).map(|_| random.word() as u32).collect();
    // The ends of the range, where -32768 means -1 as well.
    packed.extend([
        0,
        0x7fff,
        0x8000,
        0x8001,
        0x7fff_0000,
        0x8000_0000,
        0x8000_8000,
        0x7fff_7fff,
    ]);
    for (word, there) in packed.iter().zip(ask_unpacked(&packed)) {
        let here = unpack_normal(*word);
        let off = angle(there, here);
        // Two normalisations of the same rounded numbers.
        assert!(
            off <= 1e-6 && (there.length() - 1.0).abs() < 1e-6,
            "{word:08x} is {there} there, {here} here"
        );
    }
}

#[test]
fn a_packing_that_forgets_the_fold_is_noticed() {
    let planted = "fn pack_normal(n: vec3<f32>) -> u32 { return pack2x16snorm(n.xy / (abs(n.x) + abs(n.y) + abs(n.z))); }";
    let directions = directions();
    let wrong = ask_packed(planted, &directions)
        .iter()
        .zip(&directions)
        .filter(|(w, d)| angle(unpack_normal(**w), **d) > MOST_ANGLE)
        .count();
    assert!(
        wrong * 3 > directions.len(),
        "half of the sphere is lost, but only {wrong} of {} show it",
        directions.len()
    );
}

#[test]
fn layer_words_come_apart_as_they_were_put_together() {
    let shader = "#import cutaway::layers::{layer_word, kind_of, clip_surface_of, part_of}
@group(0) @binding(0) var<storage, read> given: array<array<u32, 3>>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&given) { return; }
    let word = layer_word(given[id.x][0], given[id.x][1], given[id.x][2]);
    words[4u * id.x] = word;
    words[4u * id.x + 1u] = kind_of(word);
    words[4u * id.x + 2u] = clip_surface_of(word);
    words[4u * id.x + 3u] = part_of(word);
}";
    let mut cases: Vec<[u32; 3]> = Vec::new();
    for kind in 0..3 {
        for clip_surface in [0, 1, 31, 254, 255] {
            for part in [0, 1, 255, 256, 65_534] {
                cases.push([kind, clip_surface, part]);
            }
        }
    }
    let given = answers(shader, &[("given", words_of(&cases))], cases.len(), 4);
    for (case, words) in cases.iter().zip(given) {
        let [kind, clip_surface, part] = *case;
        let expected = [
            kind | clip_surface << 8 | part << 16,
            kind,
            clip_surface,
            part,
        ];
        assert_eq!(words, expected, "{case:?}");
    }
}
