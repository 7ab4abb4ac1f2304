//! Fixed point: products in two words, edge functions over tiles and spans of rows, against 128-bit integers.

use crate::plans::words::{Random, answers, words_of};

const SEED: u64 = 0xf1_8ed;

const TILES: &str = "
@group(0) @binding(0) var<storage, read> cases: array<array<i32, 9>>;
@group(0) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&cases) { return; }
    let c = cases[id.x];
    let product = wide_product(c[0], c[1]);
    let edge = tile_edge(vec2<i32>(c[2], c[3]), vec2<i32>(c[4], c[5]), vec2<i32>(c[6], c[7]));
    let span = row_inside(edge, c[8], vec2<i32>(0, 63));
    words[5u * id.x] = product.x;
    words[5u * id.x + 1u] = product.y;
    words[5u * id.x + 2u] = select(0u, u32(span.y - span.x + 1), span.x <= span.y);
    words[5u * id.x + 3u] = select(0u, u32(span.x), span.x <= span.y);
    words[5u * id.x + 4u] = bitcast<u32>(edge_value(edge, vec2<i32>(span.x, c[8])));
}";

/// Two factors; an edge and the first sample of a tile within the guard band, often near to each other; a row.
fn cases() -> Vec<[i32; 9]> {
    let random = &mut Random(SEED);
    let mut within = |most: u32| random.below(2 * most + 1) as i32 - most as i32;

    (0..20_000)
        .map(|i| {
            let reach = [1 << 22, 1 << 18, 1 << 13, 600][i % 4];
            let near = |at: i32, by: i32| (at + by) / 256 * 256 + 128;
            let (a, b) = (
                [within(reach), within(reach)],
                [within(reach), within(reach)],
            );
            // On the edge or beside it, so that signs change within the tile.
            let middle = [0, 1].map(|k| (a[k] + b[k]) / 2);
            let spread = if i % 3 == 0 { reach } else { 1 << 13 };
            let sample = [
                near(middle[0], within(spread)),
                near(middle[1], within(spread)),
            ];
            let row = within(31) + 32;
            [
                within(0x3fff_ffff),
                within(0x3fff_ffff),
                a[0],
                a[1],
                b[0],
                b[1],
                sample[0],
                sample[1],
                row.min(63),
            ]
        })
        .collect()
}

fn wrong(cases: &[[i32; 9]], given: &[Vec<u32>]) -> usize {
    let (mut wrong, mut mixed) = (0, 0);
    for (case, words) in cases.iter().zip(given) {
        let c = case.map(i128::from);
        let product = i128::from((u64::from(words[0]) | u64::from(words[1]) << 32).cast_signed());
        let (dx, dy) = (c[4] - c[2], c[5] - c[3]);
        let at = |x: i128| dx * (c[7] + 256 * c[8] - c[3]) - dy * (c[6] + 256 * x - c[2]);
        let is_owner = dy < 0 || (dy == 0 && dx > 0);
        let inside: Vec<i128> = (0..64)
            .filter(|x| at(*x) > 0 || (at(*x) == 0 && is_owner))
            .collect();
        mixed += usize::from(!inside.is_empty() && inside.len() < 64);
        let mut is_right = product == c[0] * c[1] && inside.len() == words[2] as usize;
        if let Some(first) = inside.first() {
            let value = f64::from(f32::from_bits(words[4]));
            let truth = at(*first) as f64;
            // Where 64 bits were rounded first, an edge function is far from 0 over the whole tile.
            is_right &=
                *first == i128::from(words[3]) && (value - truth).abs() <= truth.abs() * 1e-6;
        }
        wrong += usize::from(!is_right);
    }
    assert!(mixed > 2000, "only {mixed} rows are crossed by their edge");
    wrong
}

#[test]
fn edges_over_tiles_are_exact() {
    let cases = cases();
    let inputs = [("cases", words_of(&cases))];
    let library = "#import cutaway::wide::wide_product\n#import cutaway::tiles::{edge_value, row_inside, tile_edge}";
    let ask = |library: &str, cases_of: &[(&str, Vec<u32>)]| {
        answers(&format!("{library}{TILES}"), cases_of, cases.len(), 5)
    };
    assert_eq!(
        wrong(&cases, &ask(library, &inputs)),
        0,
        "of {} cases",
        cases.len()
    );
    // Floats in the place of integers lose what is beyond 24 bits, and the rule of shared edges with it.
    let planted = "#import cutaway::wide::wide_product
struct Edge { value: f32, direction: vec2<f32> }
fn tile_edge(a: vec2<i32>, b: vec2<i32>, sample: vec2<i32>) -> Edge {
    let d = vec2<f32>(b - a);
    let s = vec2<f32>(sample - a);
    return Edge(d.x * s.y - d.y * s.x, d);
}
fn edge_value(edge: Edge, step: vec2<i32>) -> f32 {
    return edge.value + 256.0 * (edge.direction.x * f32(step.y) - edge.direction.y * f32(step.x));
}
fn row_inside(edge: Edge, row: i32, span: vec2<i32>) -> vec2<i32> {
    var found = vec2<i32>(1, 0);
    for (var x = 0; x < 64; x++) {
        if edge_value(edge, vec2<i32>(x, row)) >= 0.0 {
            found = vec2<i32>(select(found.x, x, found.x > found.y), x);
        }
    }
    return found;
}";
    assert!(
        wrong(&cases, &ask(planted, &inputs)) > 10,
        "floats are noticed"
    );
}
