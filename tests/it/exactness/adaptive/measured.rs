//! The errors that are measured on the device, against brute force in f64.

use std::sync::Arc;

use cutaway::Model;
use cutaway::scene::{OffsetMap, Wrap};
use glam::DVec2;

use super::common::{session, strategy};
use super::refined::{Sheet, Triangle};
use super::{WRAPS, cut_ball, noise};

/// Points along a texel at which brute force looks; the greatest deviation on a diagonal lies between two of them and is missed by at
/// most the twist times the square of half a distance.
const SAMPLES: i32 = 8;
const MISSED: f64 = 4.0 / (4.0 * (SAMPLES * SAMPLES) as f64);

/// Greatest deviation of the map, over points of a triangle in texels of the domain.
fn deviation(sheet: &Sheet, map: &OffsetMap, wrap: Wrap, [apex, a, b]: Triangle) -> f64 {
    let size = DVec2::new(f64::from(map.size()[0]), f64::from(map.size()[1]));
    let first = DVec2::from(sheet.domain.first_texel.map(f64::from));
    let height = |p: DVec2| map.sample(wrap, (first + p + 0.5) / size).0;
    let [c, a, b] = [apex, a, b].map(|v| DVec2::from(v.map(f64::from)));
    let [hc, ha, hb] = [c, a, b].map(height);
    let (to_a, to_b) = (a - c, b - c);
    // Texels are among the points: they are whole or half steps along the legs.
    let count = to_a.abs().max_element() as i32 * SAMPLES;
    let mut greatest: f64 = 0.0;
    for i in 0..=count {
        for j in 0..=count - i {
            let (s, t) = (
                f64::from(i) / f64::from(count),
                f64::from(j) / f64::from(count),
            );
            let chord = hc + s * (ha - hc) + t * (hb - hc);
            greatest = greatest.max((height(c + to_a * s + to_b * t) - chord).abs());
        }
    }
    greatest
}

/// What is wrong with the errors of a sheet; how many were looked at. `planted` is done to them before.
fn faults(map: OffsetMap, wrap: Wrap, planted: impl Fn(&mut Sheet)) -> (Vec<String>, usize) {
    let map = Arc::new(map);
    let scene = cut_ball((*map).clone(), 0.9, 0.2, wrap);
    let model = Model::new(&scene);
    let view = model.prepared.view([32, 32]);
    let strategy = strategy("adaptive:1+mask");
    let mut session = session();
    let _ = session
        .draw(&model, &view, strategy)
        .expect("a frame")
        .outcome;
    let mut sheet = Sheet::of(&session, &strategy, 0);
    planted(&mut sheet);

    let [width, height] = sheet.texels();
    let [low, high] = map.range().map(f64::from);
    let range = high - low;
    let mut faults = Vec::new();
    let mut looked = 0;
    let mut look_at = |place: String, found: f32, least: f64, most: f64| {
        looked += 1;
        let found = f64::from(found);
        if found < least - 1e-6 * range || found > most + 1e-6 * range {
            faults.push(format!("{place}: {found}, should be {least} to {most}"));
        }
    };

    // Twists of cells, by the definition in f64.
    let [x0, y0] = sheet.domain.first_texel.map(i64::from);
    let texel = |x: i32, y: i32| map.texel(wrap, x0 + i64::from(x), y0 + i64::from(y));
    let twist = |x: i32, y: i32| {
        let is_in = (0..width).contains(&x) && (0..height).contains(&y);
        if !is_in {
            return 0.0;
        }
        (texel(x + 1, y + 1) - texel(x, y + 1) - texel(x + 1, y) + texel(x, y)).abs()
    };
    let cell = |x: i32, y: i32| {
        let mut greatest = 2.0 * range / 256.0;
        for dy in -3_i32..=3 {
            for dx in -3_i32..=3 {
                let away = dx.abs() + dy.abs();
                if away <= 3 {
                    greatest = f64::max(greatest, twist(x + dx, y + dy) / 4_f64.powi(away));
                }
            }
        }
        greatest
    };
    for y in 0..height {
        for x in 0..width {
            let right = cell(x, y);
            look_at(
                format!("cell {x}, {y}"),
                sheet.errors[sheet.cell_at([x, y])],
                right,
                right * 1.000_1,
            );
        }
    }

    // Middles of edges and squares, from the smallest on: own error and those that come of it, as two bounds.
    let mut bounds = vec![[0.0_f64; 2]; ((width + 1) * (height + 1)) as usize];
    let at = |x: i32, y: i32| (y * (width + 1) + x) as usize;
    let is_in = |[x, y]: [i32; 2]| (0..=width).contains(&x) && (0..=height).contains(&y);
    for bits in 0..sheet.domain.patch_bits {
        let r = 1_i32 << bits;
        for squares in [false, true] {
            for (y, x) in (0..=height)
                .step_by(r as usize)
                .flat_map(|y| (0..=width).step_by(r as usize).map(move |x| (y, x)))
            {
                let odd = [x, y].map(|c| c / r % 2 == 1);
                let mut triangles: Vec<Triangle> = Vec::new();
                let mut come_of_it: Vec<[f64; 2]> = Vec::new();
                if squares && odd == [true, true] {
                    let (l, b, t, rt) = (x - r, y - r, y + r, x + r);
                    let is_main = ((x - r) / (2 * r) + (y - r) / (2 * r)) % 2 == 0;
                    triangles.extend(if is_main {
                        [[[rt, b], [rt, t], [l, b]], [[l, t], [l, b], [rt, t]]]
                    } else {
                        [[[l, b], [rt, b], [l, t]], [[rt, t], [l, t], [rt, b]]]
                    });
                    come_of_it.extend(
                        [[r, 0], [-r, 0], [0, r], [0, -r]].map(|[i, j]| bounds[at(x + i, y + j)]),
                    );
                } else if !squares && odd[0] != odd[1] {
                    let (along, across) = if odd[0] {
                        ([r, 0], [0, r])
                    } else {
                        ([0, r], [r, 0])
                    };
                    let v = |f: i32, g: i32| {
                        [
                            x + f * along[0] + g * across[0],
                            y + f * along[1] + g * across[1],
                        ]
                    };
                    for side in [1, -1] {
                        if is_in(v(0, side)) {
                            triangles.push([v(0, side), v(-1, 0), v(1, 0)]);
                        }
                    }
                    for [i, j] in [[1, 1], [-1, 1], [1, -1], [-1, -1]] {
                        if bits == 0 {
                            let (i, j) = (x + (i - 1) / 2, y + (j - 1) / 2);
                            if (0..width).contains(&i) && (0..height).contains(&j) {
                                come_of_it.push([cell(i, j) / 4.0; 2]);
                            }
                        } else if is_in([x + i * r / 2, y + j * r / 2]) {
                            come_of_it.push(bounds[at(x + i * r / 2, y + j * r / 2)]);
                        }
                    }
                } else {
                    continue;
                }
                let own = triangles
                    .iter()
                    .map(|t| deviation(&sheet, &map, wrap, *t))
                    .fold(0.0, f64::max);
                let [least, most] = come_of_it
                    .into_iter()
                    .fold([own, own + MISSED * range], |[l, m], [n, o]| {
                        [l.max(n), m.max(o)]
                    });
                bounds[at(x, y)] = [least, most];
                look_at(
                    format!("{} {x}, {y}", if squares { "square" } else { "edge" }),
                    sheet.errors[sheet.vertex_at([x, y])],
                    least,
                    most,
                );
            }
        }
    }
    (faults, looked)
}

#[test]
fn errors_are_what_brute_force_finds() {
    for (i, wrap) in WRAPS.into_iter().enumerate() {
        for size in [[37, 23], [1, 64], [64, 1], [128, 100], [2, 2]] {
            let (faults, looked) = faults(noise(size, 7 + i as u64), wrap, |_| {});
            assert!(
                faults.is_empty(),
                "{size:?}, {wrap:?}: {} of {looked}: {:?}",
                faults.len(),
                &faults[..faults.len().min(5)]
            );
        }
    }
}

#[test]
fn an_error_that_is_too_small_is_noticed() {
    // That of one vertex, and all of them by a hundredth.
    let one = |sheet: &mut Sheet| {
        let at = sheet.vertex_at([3, 4]);
        sheet.errors[at] *= 0.9;
    };
    let (found, _) = faults(noise([37, 23], 7), Wrap::Repeat, one);
    assert!(!found.is_empty(), "one error");
    let all = |sheet: &mut Sheet| sheet.errors.iter_mut().for_each(|e| *e *= 0.99);
    let (found, looked) = faults(noise([37, 23], 7), Wrap::Repeat, all);
    assert!(found.len() * 2 > looked, "{} of {looked}", found.len());
}
