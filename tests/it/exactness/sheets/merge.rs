//! What the pass that merges makes of fragments written by hand: sides, order, ties, doubts.

use cutaway::gpu::{ClockSet, Program};
use cutaway::plan::pack::{self, CutTable, NO_RELIEF, Quad, SheetPool};
use cutaway::plan::{
    Binding, BufferRole, Clock, Contents, Pass, Piece, Plan, Resource, Work, groups_over,
};
use cutaway::scene::{Bounds, Precision, View};
use cutaway::shader::Shader;
use glam::{DVec2, DVec3};

use crate::common::numbers::Numbers;
use crate::common::session;

const NEAR: f64 = 0.0;
const FAR: f64 = 4.0;
/// Depths between which the box of the cut solids lies.
const BOX: [f64; 2] = [1.0, 3.0];
const CAPACITY: u32 = 12;
const FACING: u32 = 0;
const PARITY: u32 = 1;

/// A fragment of a sheet, by its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fragment {
    depth: f64,
    surface: u32,
    front: bool,
}

/// A list that was merged.
#[derive(Clone, Debug, PartialEq)]
struct Merged {
    /// Depths and clip-surfaces, as stored in the low bits of their words.
    crossings: Vec<(f64, u32)>,
    sides: u32,
    doubted: bool,
}

fn front(depth: f64) -> Fragment {
    Fragment {
        depth,
        surface: FACING,
        front: true,
    }
}

fn back(depth: f64) -> Fragment {
    Fragment {
        front: false,
        ..front(depth)
    }
}

fn of_solid(depth: f64) -> Fragment {
    Fragment {
        depth,
        surface: PARITY,
        front: false,
    }
}

/// Parallel rays along z from z = 0, so that the depth of a point is its z.
fn view(pixels: u32) -> View {
    View {
        size_px: [pixels, 1],
        centre_px: DVec2::new(0.5 * f64::from(pixels), 0.5),
        eye: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
        forward: DVec3::Z,
        half_height: 0.5 / f64::from(pixels),
        orthographic: true,
        near: NEAR,
        far: FAR,
        near_cap: true,
        band: [0, 1],
        halo_rows: [0; 2],
        fineness: 1,
        precision: Precision::USUAL,
    }
}

/// Merges lists of fragments, one for each pixel; of the sheet with facing, points beyond `plane` are kept, as far as they are
/// not as near to it as `beside`.
fn merge(pixels: &[Vec<Fragment>], (plane, beside): (f64, f64), room: u32) -> Vec<Merged> {
    let count = pixels.len() as u32;
    let view = view(count);
    let bounds = Bounds {
        min: DVec3::new(-1.0, -1.0, BOX[0]),
        max: DVec3::new(1.0, 1.0, BOX[1]),
    };
    let mut table: CutTable = bytemuck::Zeroable::zeroed();
    table.surface_count = 2;
    for surface in &mut table.surfaces {
        surface.first_texel = NO_RELIEF;
        surface.height_row = [0.0, 0.0, 1.0, -plane as f32];
    }
    let quad = Quad {
        corner: [-1.0, -1.0, 0.0, 0.0],
        step_u: [2.0, 0.0, 0.0, 0.0],
        step_v: [0.0, 2.0, 0.0, 0.0],
        cells: [1, 0, 0, 0],
    };
    // Each list leads from its last fragment to its first; what found no room ends it.
    let z = |f: &Fragment| (view.buffer_from_depth(f.depth) as f32).to_bits();
    let (mut lasts, mut kept, mut came) = (Vec::new(), Vec::new(), 0);
    for list in pixels {
        let mut last = u32::MAX;
        for fragment in list {
            if came < room {
                let word = fragment.surface | u32::from(fragment.front) << 5;
                kept.extend([z(fragment), word, last]);
                last = came;
            } else {
                last = u32::MAX - 1;
            }
            came += 1;
        }
        lasts.push(last);
    }
    kept.resize(3 * room as usize, 0);
    let sheets: Vec<u32> = lasts.into_iter().chain([came]).chain(kept).collect();

    let mut plan = Plan::default();
    let mut upload = |name: &str, role, words: &[u32]| {
        let piece = Piece::from_values(0, words);
        let contents = Contents::in_pieces(4 * words.len() as u64, vec![piece], true);
        plan.add_resource(Resource::upload(name, role, contents, Clock::Frame))
    };
    let of = |bytes: &[u8]| bytemuck::pod_collect_to_vec::<u8, u32>(bytes);
    let pool = SheetPool {
        lists: count,
        capacity: room,
        padding: [0; 2],
    };
    let frame = pack::frame(&view, &bounds);
    let frame = upload(
        "frame",
        BufferRole::Uniform,
        &of(bytemuck::bytes_of(&frame)),
    );
    let table = upload(
        "cut_table",
        BufferRole::Uniform,
        &of(bytemuck::bytes_of(&table)),
    );
    let pool = upload(
        "sheet_pool",
        BufferRole::Uniform,
        &of(bytemuck::bytes_of(&pool)),
    );
    let sheets = upload("sheets", BufferRole::Storage, &sheets);
    let heights = upload("heights", BufferRole::Storage, &[0]);
    let quads = of(bytemuck::cast_slice(&[quad, quad]));
    let quads = upload("quads", BufferRole::Storage, &quads);
    let heads = upload("heads", BufferRole::Storage, &vec![0; 2 * count as usize]);
    let blank = vec![0; (count * CAPACITY) as usize];
    let z = upload("z", BufferRole::Storage, &blank);
    let surfaces = upload("surfaces", BufferRole::Storage, &blank);
    let need = upload("need", BufferRole::Storage, &[0; 8]);
    plan.need = Some(need);
    plan.add_pass(Pass {
        name: "merge".to_owned(),
        clock: Clock::Frame,
        reason: "the pass that is tested".to_owned(),
        shader: Shader::from("passes/sheet/merge.wgsl")
            .with("lib/share/picture.wgsl")
            .with("lib/sheet_side/grid.wgsl")
            .with("lib/height_filter/exact.wgsl")
            .with("lib/surfaces/any.wgsl"),
        bindings: vec![
            Binding::read("frame", frame),
            Binding::read("cut_table", table),
            Binding::read("heights", heights),
            Binding::read("quads", quads),
            Binding::read("sheet_pool", pool),
            Binding::read("sheets", sheets),
            Binding::update("crossing_heads", heads),
            Binding::update("crossing_z", z),
            Binding::update("crossing_surface", surfaces),
            Binding::update("need", need),
        ],
        constants: vec![
            ("capacity", f64::from(CAPACITY)),
            ("by_facing", f64::from(1 << FACING)),
            ("by_parity", f64::from(1 << PARITY)),
            ("beside", beside),
        ],
        work: Work::Compute {
            groups: groups_over([count, 1]),
        },
    });
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    (program.run(gpu, ClockSet::ALL)).unwrap_or_else(|e| panic!("{e}"));
    let words = |name: &str| program.words(gpu, name).unwrap_or_else(|e| panic!("{e}"));
    let (heads, z, surfaces) = (words("heads"), words("z"), words("surfaces"));
    let list = |pixel: u32| {
        let head = heads[2 * pixel as usize];
        let crossing = |i| {
            let at = (i * count + pixel) as usize;
            let z = f64::from(f32::from_bits(z[at]));
            (view.depth_from_buffer(z), surfaces[at] & 31)
        };
        Merged {
            crossings: (0..head & 0xff).map(crossing).collect(),
            sides: heads[2 * pixel as usize + 1],
            doubted: head >> 31 == 1,
        }
    };
    (0..count).map(list).collect()
}

/// Every end of a ray is too near to the sheet to be told by its height.
const BY_FACING: (f64, f64) = (1.8, 100.0);
/// Rays begin removed and end kept: by the end, which is farther.
const ENDS_KEPT: (f64, f64) = (1.8, 1e-4);
/// Rays begin and end removed.
const REMOVED: (f64, f64) = (5.0, 1e-4);
/// Rays begin and end kept.
const KEPT: (f64, f64) = (-1.0, 1e-4);

/// How far rounding may move a crossing.
const MOVED: f64 = 1e-5;

fn shuffled<T>(random: &mut Numbers, mut items: Vec<T>) -> Vec<T> {
    for i in (1..items.len()).rev() {
        items.swap(i, random.below(i as u64 + 1) as usize);
    }
    items
}

/// Depths inside the box, in order, apart by more than ties.
fn depths(random: &mut Numbers, count: usize) -> Vec<f64> {
    let slot = 1.9 / count.max(1) as f64;
    let of = |i: usize, r: f64| BOX[0] + 0.05 + slot * (i as f64 + 0.1 + 0.7 * r);
    (0..count).map(|i| of(i, random.unit())).collect()
}

#[test]
fn fragments_at_one_depth_all_count_in_whatever_order_they_came() {
    // Two solids that touch: out of the first, into the second.
    let depths = [1.5, 2.0, 2.0, 2.5];
    let orders = (0..24).map(|n| {
        let (mut left, mut n) = (depths.to_vec(), n);
        (1..=4)
            .rev()
            .map(|k| {
                let taken = left.remove(n % k);
                n /= k;
                of_solid(taken)
            })
            .collect::<Vec<Fragment>>()
    });
    let pixels: Vec<Vec<Fragment>> = orders.collect();
    for (pixel, merged) in pixels.iter().zip(merge(&pixels, REMOVED, 1000)) {
        let found: Vec<f64> = merged.crossings.iter().map(|c| c.0).collect();
        let is_close = found.iter().zip(depths).all(|(a, b)| (a - b).abs() < MOVED);
        assert!(found.len() == 4 && is_close, "{pixel:?}: {found:?}");
    }
}

#[test]
fn crossings_are_sorted_and_the_first_says_where_the_ray_begins() {
    let random = &mut Numbers(0x5ee7);
    let (mut pixels, mut expected) = (Vec::new(), Vec::new());
    for case in 0..400 {
        let begins_kept = random.below(2) == 0;
        let inside = depths(random, 1 + case % 9);
        let mut fragments: Vec<Fragment> = (inside.iter().enumerate())
            .map(|(i, d)| {
                if (i % 2 == 0) == begins_kept {
                    front(*d)
                } else {
                    back(*d)
                }
            })
            .collect();
        // Before and behind the box anything may be.
        for _ in 0..random.below(4) {
            let before = random.below(2) == 0;
            let depth = 0.9 * random.unit() + if before { 0.05 } else { 3.05 };
            fragments.push(if random.below(2) == 0 {
                front(depth)
            } else {
                back(depth)
            });
        }
        pixels.push(shuffled(random, fragments));
        expected.push((inside, begins_kept));
    }
    let merged = merge(&pixels, BY_FACING, 8192);
    for (merged, (inside, begins_kept)) in merged.iter().zip(expected) {
        assert_eq!(merged.crossings.len(), inside.len(), "{merged:?}");
        for ((depth, surface), at) in merged.crossings.iter().zip(&inside) {
            assert!(
                (depth - at).abs() < MOVED && *surface == FACING,
                "{merged:?}"
            );
        }
        assert_eq!(merged.sides, u32::from(!begins_kept), "{merged:?}");
        assert!(!merged.doubted, "{merged:?}");
    }
}

#[test]
fn an_odd_number_says_it_by_all_of_them_together() {
    // As close as rounding brings them: it may have exchanged any two.
    let close = 1e-6;
    for (fragments, begins_kept) in [
        (vec![back(1.5), front(1.5 + close), front(2.0)], true),
        (vec![front(1.5), back(1.5 + close), back(2.0)], false),
        (vec![back(1.5), back(2.0), front(2.0 + close)], false),
        (vec![front(1.5), front(2.0), back(2.0 + close)], true),
    ] {
        let merged = &merge(std::slice::from_ref(&fragments), BY_FACING, 64)[0];
        assert_eq!(merged.crossings.len(), 3, "{fragments:?}: {merged:?}");
        let begins_removed = u32::from(!begins_kept);
        assert_eq!(merged.sides, begins_removed, "{fragments:?}: {merged:?}");
    }
}

#[test]
fn the_end_that_is_farther_from_the_sheet_says_where_the_ray_begins() {
    let random = &mut Numbers(0xfa7);
    for (place, begins_kept, odd) in [
        (ENDS_KEPT, false, true),
        (REMOVED, false, false),
        (KEPT, true, false),
    ] {
        for count in 0..8 {
            // What they show does not matter.
            let fragment = |d: f64| {
                if d.to_bits().is_multiple_of(2) {
                    front(d)
                } else {
                    back(d)
                }
            };
            let fragments: Vec<Fragment> =
                depths(random, count).into_iter().map(fragment).collect();
            let merged = &merge(&[fragments], place, 64)[0];
            assert_eq!(merged.crossings.len(), count, "{place:?}: {merged:?}");
            let is_whole = (count % 2 == 1) == odd;
            assert_eq!(merged.doubted, !is_whole, "{place:?}, {count}: a hole");
            if is_whole {
                let begins_removed = u32::from(!begins_kept);
                assert_eq!(merged.sides, begins_removed, "{place:?}, {count}");
            }
        }
    }
}

#[test]
fn where_nothing_crosses_the_height_is_asked_however_near() {
    // At 1.8 the far end is farther from the sheet, at 2.2 the near one.
    for (plane, begins_kept) in [(1.8, true), (2.2, false)] {
        for fragments in [vec![], vec![front(0.5), back(3.5)]] {
            let merged = &merge(&[fragments], (plane, 100.0), 64)[0];
            let expected = Merged {
                crossings: Vec::new(),
                sides: u32::from(!begins_kept),
                doubted: false,
            };
            assert_eq!(*merged, expected, "a sheet at {plane}");
        }
    }
}

#[test]
fn a_sheet_around_a_solid_is_told_by_counting() {
    let random = &mut Numbers(0x501d);
    let (mut pixels, mut expected) = (Vec::new(), Vec::new());
    for case in 0..400 {
        let inside = depths(random, case % 7);
        let behind = random.below(4) as usize;
        let mut all: Vec<f64> = inside.clone();
        all.extend((0..behind).map(|_| 3.05 + 0.9 * random.unit()));
        let before = random.below(3);
        all.extend((0..before).map(|_| 0.05 + 0.9 * random.unit()));
        let begins_removed = (inside.len() + behind) % 2 == 1;
        // The sheet with facing is there as well, and neither minds the other.
        let mut fragments: Vec<Fragment> = all.into_iter().map(of_solid).collect();
        fragments.push(front(2.96));
        pixels.push(shuffled(random, fragments));
        expected.push((inside, begins_removed));
    }
    for (merged, (inside, begins_removed)) in merge(&pixels, BY_FACING, 8192).iter().zip(expected) {
        let of_solid: Vec<f64> = (merged.crossings.iter())
            .filter(|c| c.1 == PARITY)
            .map(|c| c.0)
            .collect();
        assert_eq!(of_solid.len(), inside.len(), "{merged:?}");
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < MOVED;
        assert!(of_solid.iter().zip(&inside).all(near), "{merged:?}");
        assert_eq!(merged.crossings.len(), inside.len() + 1, "{merged:?}");
        assert_eq!(
            merged.sides,
            u32::from(begins_removed) << PARITY,
            "{merged:?}"
        );
        assert!(!merged.doubted, "{merged:?}");
    }
}

#[test]
fn what_did_not_fit_is_doubted() {
    let list = vec![front(1.5), back(2.0), front(2.5)];
    let pixels = vec![list.clone(), list.clone(), list];
    let doubts = |room| {
        let merged = merge(&pixels, BY_FACING, room);
        merged.iter().map(|m| m.doubted).collect::<Vec<bool>>()
    };
    assert_eq!(doubts(9), [false, false, false], "room for all");
    assert_eq!(doubts(8), [false, false, true], "one too many");
    assert_eq!(doubts(4), [false, true, true], "five too many");
    // More crossings than the list of a pixel holds.
    let random = &mut Numbers(0xc0);
    let many = |random: &mut Numbers, count| {
        let fragment = |(i, d): (usize, f64)| if i % 2 == 0 { front(d) } else { back(d) };
        depths(random, count)
            .into_iter()
            .enumerate()
            .map(fragment)
            .collect()
    };
    let pixels = vec![
        many(random, CAPACITY as usize),
        many(random, CAPACITY as usize + 1),
    ];
    let doubted: Vec<bool> = (merge(&pixels, BY_FACING, 64).iter())
        .map(|m| m.doubted)
        .collect();
    assert_eq!(doubted, [false, true], "longer than the list");
}
