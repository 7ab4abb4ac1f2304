//! Heights of reliefs: `wrapped`, `height_at`, `kept_height` and `cap_normal` against the offset map in f64.

use std::sync::Arc;

use cutaway::generate::shapes;
use cutaway::plan::pack::{self, CutTable, NO_RELIEF};
use cutaway::scene::{ClipSurface, Cut, OffsetMap, Prepared, PreparedSurface, Scene, Wrap};
use glam::{DVec2, DVec3, Vec2Swizzles as _};

use crate::plans::words::{Random, U, answers, answers_with, words_of};

const SEED: u64 = 0x5eaf;
const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

const WRAPPED: &str = "
@group(1) @binding(0) var<storage, read> cases: array<vec3<i32>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&cases) { return; }
    let x = cases[id.x];
    words[id.x] = wrapped(x.x, u32(x.y), u32(x.z));
}";

/// How many addresses are read from the wrong texel.
fn wrongly_wrapped(wrapped: &str) -> (usize, usize) {
    let mut cases = Vec::new();
    for wrap in WRAPS {
        for size in [1, 2, 3, 4, 5, 7, 8, 64, 255, 4096] {
            let near = (-3 * size.min(20)..=3 * size.min(20)).map(|a| a - size);
            // Beyond 2^24 a texel coordinate in f32 names no texel any more.
            let far = [-16_777_213, -65_537, -4097, 4096, 65_536, 16_777_213];
            cases.extend(near.chain(far).map(|a| (wrap, a, size)));
        }
    }
    // A vec3 in an array takes 16 bytes.
    let rows: Vec<[i32; 4]> = cases
        .iter()
        .map(|(wrap, address, size)| [*address, *size, wrap.code() as i32, 0])
        .collect();
    let given = answers(
        &format!("{wrapped}{WRAPPED}"),
        &[("cases", words_of(&rows))],
        cases.len(),
        1,
    );
    let wrong = cases
        .iter()
        .zip(given)
        .filter(|((wrap, address, size), words)| {
            words[0] != wrap.texel(i64::from(*address), *size as u32)
        })
        .count();
    (wrong, cases.len())
}

#[test]
fn addresses_wrap_as_they_do_in_the_scene() {
    let (wrong, of) = wrongly_wrapped("#import cutaway::relief::wrapped");
    assert_eq!(wrong, 0, "of {of}");
    // The remainder of a negative address is negative.
    let planted = "fn wrapped(address: i32, size: u32, wrap: u32) -> u32 {
    let n = i32(size);
    if wrap == 0u { return u32(abs(address % n)); }
    if wrap == 1u { let m = abs(address) % (2 * n); return u32(select(m, 2 * n - 1 - m, m >= n)); }
    return u32(clamp(address, 0, n - 1));
}";
    let (wrong, of) = wrongly_wrapped(planted);
    assert!(wrong * 5 > of, "only {wrong} of {of} addresses show it");
}

/// A scene with one clip-surface, whose map has the given size.
fn surface(wrap: Wrap, size: [u32; 2], scale: DVec3) -> PreparedSurface {
    let random = &mut Random(SEED);
    let heights = (0..size[0] * size[1]).map(|_| random.signed()).collect();
    let map = OffsetMap::new(size, heights).expect("finite heights");
    let surface = ClipSurface {
        origin: DVec3::new(0.1, -0.05, 0.2),
        u: DVec3::new(1.0, 2.0, -0.5),
        v: DVec3::new(2.0, -1.0, 0.0) * 0.3,
        scale,
        relief: Some(Arc::new(map)),
        wrap,
    };
    let scene = Scene {
        parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
        cuts: vec![Cut::new("c", vec![surface])],
        ..Scene::default()
    };
    Prepared::new(&scene).surfaces.remove(0)
}

fn surfaces() -> Vec<PreparedSurface> {
    let mut all = Vec::new();
    for wrap in WRAPS {
        for (size, scale) in [
            ([8, 8], DVec3::new(1.3, -0.7, 0.2)),
            ([2, 2], DVec3::new(5.0, 5.0, -0.1)),
            ([1, 16], DVec3::new(0.5, 0.5, 0.3)),
            ([5, 3], DVec3::new(-2.0, 1.0, 1.0)),
        ] {
            all.push(surface(wrap, size, scale));
        }
    }
    all
}

/// The tables of one surface, as a relief or as the plane below it.
fn tables(surface: &PreparedSurface, is_relief: bool) -> (CutTable, Vec<f32>) {
    let mut table: CutTable = bytemuck::Zeroable::zeroed();
    table.surface_count = 1;
    table.cut_count = 1;
    // Other texels come first, so that a forgotten offset shows.
    let first = 7;
    let number = if is_relief { first } else { NO_RELIEF };
    table.surfaces[0] = pack::clip_surface(surface, 0, number, 2.0);
    let mut heights = vec![1e6; first as usize];
    heights.extend(surface.relief.iter().flat_map(|m| m.texels()));
    (table, heights)
}

const HEIGHT_AT: &str = "
@group(1) @binding(0) var<storage, read> texels: array<vec2<f32>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&texels) { return; }
    words[id.x] = bitcast<u32>(height_at(0u, texels[id.x]));
}";

/// Texel coordinates at which the height is off. From given coordinates the weights are exact, so four products of heights up
/// to 1 with weights up to 1 and their sum are left: the twist is a sum of four heights, in all 16 u.
fn wrong_heights(height_at: &str, surface: &PreparedSurface) -> (usize, usize) {
    let random = &mut Random(SEED);
    let mut texels: Vec<[f32; 2]> = (0..3000)
        .map(|_| [random.signed() * 40.0, random.signed() * 40.0])
        .collect();
    for x in -9..9 {
        for y in -9..9 {
            texels.push([x as f32, y as f32]);
            texels.push([x as f32 + 0.5, y as f32]);
        }
    }
    let (table, heights) = tables(surface, true);
    let given = answers(
        &format!("{height_at}{HEIGHT_AT}"),
        &[
            ("cut_table", words_of(&[table])),
            ("heights", words_of(&heights)),
            ("texels", words_of(&texels)),
        ],
        texels.len(),
        1,
    );
    let map = surface.relief.as_ref().expect("a relief");
    let size = DVec2::from(map.size().map(f64::from));
    let wrong = texels
        .iter()
        .zip(given)
        .filter(|(texel, words)| {
            let at = (DVec2::from(texel.map(f64::from)) + 0.5) / size;
            let expected = map.sample(surface.wrap, at).0;
            (f64::from(f32::from_bits(words[0])) - expected).abs() > 16.0 * U
        })
        .count();
    (wrong, texels.len())
}

#[test]
fn heights_are_bilinear_between_texel_centres() {
    for surface in surfaces() {
        let (wrong, of) = wrong_heights("#import cutaway::relief::height_at", &surface);
        assert_eq!(wrong, 0, "of {of} with {:?}", surface.wrap);
    }
    // Weights of 8 bits, as a hardware sampler keeps them.
    let planted = "#import cutaway::relief::{cell_at, height_in}
fn height_at(surface: u32, texel: vec2<f32>) -> f32 {
    let corner = floor(texel);
    let weight = round((texel - corner) * 256.0) / 256.0;
    return height_in(cell_at(surface, vec2<i32>(corner)), weight);
}";
    let (wrong, of) = wrong_heights(planted, &surfaces()[0]);
    assert!(wrong * 2 > of, "only {wrong} of {of} heights show 8 bits");
}

const AT_POINTS: &str = "
@group(1) @binding(0) var<storage, read> points: array<array<f32, 3>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&points) { return; }
    let point = vec3<f32>(points[id.x][0], points[id.x][1], points[id.x][2]);
    words[4u * id.x] = bitcast<u32>(kept_height(0u, point));
    let normal = cap_normal(0u, point);
    words[4u * id.x + 1u] = bitcast<u32>(normal.x);
    words[4u * id.x + 2u] = bitcast<u32>(normal.y);
    words[4u * id.x + 3u] = bitcast<u32>(normal.z);
}";

/// How far f32 may be off at a point, for a surface of which the rows are rounded to f32 and summed in f32.
struct Doubt {
    /// Of a texel coordinate, per axis: 6 u of what it is a sum of.
    texel: DVec2,
    /// Of the height over the plane.
    over_plane: f64,
}

fn doubt(table: &CutTable, point: DVec3) -> Doubt {
    let s = &table.surfaces[0];
    let of_row = |row: &[f32; 4]| {
        let p = point.extend(1.0).to_array();
        let size: f64 = row
            .iter()
            .zip(p)
            .map(|(r, p)| (f64::from(*r) * p).abs())
            .sum();
        6.0 * U * size
    };
    Doubt {
        texel: DVec2::new(of_row(&s.texel_x_row), of_row(&s.texel_y_row)),
        over_plane: of_row(&s.height_row),
    }
}

/// What the device says of some points of scene space, and what is wrong with it.
fn faults_at_points(functions: &str, surface: &PreparedSurface, is_relief: bool) -> Vec<String> {
    let random = &mut Random(SEED);
    let points: Vec<[f32; 3]> = (0..3000)
        .map(|_| [random.signed(), random.signed(), random.signed()])
        .collect();
    let (table, heights) = tables(surface, is_relief);
    let filter: &[&str] = if functions.contains("cutaway::sides") {
        &["lib/height_filter/exact.wgsl"]
    } else {
        &[]
    };
    let given = answers_with(
        &format!("{functions}{AT_POINTS}"),
        filter,
        &[
            ("cut_table", words_of(&[table])),
            ("heights", words_of(&heights)),
            ("points", words_of(&points)),
        ],
        points.len(),
        4,
    );
    let frame = surface.frame;
    let map = surface.relief.as_ref().expect("a relief");
    let size = DVec2::from(map.size().map(f64::from));
    let per_unit = DVec2::from(surface.map_per_unit);
    // Neighbouring texels differ by at most 2, their differences by at most 4.
    let rise = 2.0 * surface.height_scale.abs();
    let (mut faults, mut beside_edges) = (Vec::new(), 0);
    for (point, words) in points.iter().zip(given) {
        let p = DVec3::from(point.map(f64::from));
        let d = p - surface.origin;
        let t = DVec2::new(d.dot(frame.u_hat), d.dot(frame.v_hat)) * per_unit;
        let (height, by_t) = if is_relief {
            map.sample(surface.wrap, t)
        } else {
            (0.0, DVec2::ZERO)
        };
        let doubt = doubt(&table, p);

        let kept = f64::from(f32::from_bits(words[0]));
        let expected = d.dot(frame.normal) + height * surface.height_scale;
        let bound = doubt.over_plane
            + rise * (doubt.texel.x + doubt.texel.y + 16.0 * U)
            + 2.0 * U * expected.abs();
        if (kept - expected).abs() > bound {
            faults.push(format!("{p}: kept height {kept} should be {expected}"));
        }

        // On the edge between two cells the normal jumps, and either is right.
        let texel = t * size - 0.5;
        let to_edge = (texel - texel.round()).abs();
        if is_relief && to_edge.cmple(doubt.texel).any() {
            beside_edges += 1;
            continue;
        }
        let [x, y, z] = [words[1], words[2], words[3]].map(|w| f64::from(f32::from_bits(w)));
        let normal = DVec3::new(x, y, z);
        let slope = by_t * per_unit * surface.height_scale;
        let expected = -(frame.normal + slope.x * frame.u_hat + slope.y * frame.v_hat).normalize();
        // The slope errs by the twist times the texel's doubt and by rounding; the angle by no more than the slope.
        let per_texel = (per_unit * size).abs();
        let bound = 2.0 * rise * per_texel.dot(doubt.texel.yx()) * 2.0
            + 16.0 * U * (1.0 + rise * (per_texel.x + per_texel.y));
        let off = normal.cross(expected).length().atan2(normal.dot(expected));
        if off > bound || (normal.length() - 1.0).abs() > 8.0 * U {
            faults.push(format!(
                "{p}: cap normal {normal} should be {expected}, is {off} rad off, {bound} allowed"
            ));
        }
    }
    assert!(beside_edges < 30, "{beside_edges} points beside edges");
    faults
}

const LIBRARY: &str = "#import cutaway::relief::cap_normal
#import cutaway::sides::kept_height";

#[test]
fn the_clip_surface_is_where_its_definition_says() {
    for surface in surfaces() {
        for is_relief in [true, false] {
            let faults = faults_at_points(LIBRARY, &surface, is_relief);
            assert!(
                faults.is_empty(),
                "relief {is_relief}, {:?}: {} faults: {:#?}",
                surface.wrap,
                faults.len(),
                &faults[..faults.len().min(5)]
            );
        }
    }
}

#[test]
fn a_relief_of_the_wrong_sign_is_noticed() {
    // The surface lies at -f Sz: a displacement to the other side.
    let planted = "#import cutaway::cuts::cut_table
#import cutaway::relief::{cap_normal, height_at}
fn kept_height(surface: u32, point: vec3<f32>) -> f32 {
    let p = vec4<f32>(point, 1.0);
    let texel = vec2<f32>(dot(cut_table.surfaces[surface].texel_x_row, p), dot(cut_table.surfaces[surface].texel_y_row, p));
    return dot(cut_table.surfaces[surface].height_row, p) - height_at(surface, texel) * cut_table.surfaces[surface].scale.z;
}";
    let wrong = faults_at_points(planted, &surfaces()[0], true)
        .iter()
        .filter(|f| f.contains("kept height"))
        .count();
    assert!(wrong > 2800, "only {wrong} of 3000 points show it");

    // A normal that leaves out the twist of the cell.
    let planted = "#import cutaway::cuts::cut_table
#import cutaway::relief::cell_at
#import cutaway::sides::kept_height
fn cap_normal(surface: u32, point: vec3<f32>) -> vec3<f32> {
    let p = vec4<f32>(point, 1.0);
    let texel = vec2<f32>(dot(cut_table.surfaces[surface].texel_x_row, p), dot(cut_table.surfaces[surface].texel_y_row, p));
    let cell = cell_at(surface, vec2<i32>(floor(texel)));
    let scale = cut_table.surfaces[surface].scale;
    let slope = cell.along * scale.xy * scale.z;
    return -normalize(cut_table.surfaces[surface].normal.xyz + slope.x * cut_table.surfaces[surface].u_hat.xyz + slope.y * cut_table.surfaces[surface].v_hat.xyz);
}";
    let wrong = faults_at_points(planted, &surfaces()[0], true)
        .iter()
        .filter(|f| f.contains("cap normal"))
        .count();
    assert!(wrong > 2000, "only {wrong} of 3000 points show it");
}
