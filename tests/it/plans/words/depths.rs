//! Depths: what the buffer holds and what it means, and where a ray meets the box.

use cutaway::plan::pack;
use cutaway::scene::{Bounds, Camera, Projection, View};
use glam::DVec3;

use crate::plans::words::{Random, U, answers, words_of};

const SEED: u64 = 0xd0_0f;

fn views() -> [View; 2] {
    let bounds = Bounds {
        min: DVec3::new(-0.5, -0.3, -0.6),
        max: DVec3::new(0.5, 0.4, 0.7),
    };
    [
        Projection::Perspective { fov_y_deg: 40.0 },
        Projection::Orthographic { height: None },
    ]
    .map(|projection| {
        Camera {
            projection,
            ..Camera::default()
        }
        .view(|p| p, 1.0, bounds, [320, 200])
    })
}

fn frame_of(view: &View, cut_box: &Bounds) -> Vec<u32> {
    words_of(&[pack::frame(view, cut_box)])
}

const BOX: Bounds = Bounds {
    min: DVec3::new(-0.5, -0.25, -0.125),
    max: DVec3::new(0.25, 0.5, 0.75),
};

const ROUND_TRIP: &str = "
@group(1) @binding(0) var<storage, read> depths: array<f32>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&depths) { return; }
    let z = buffer_from_depth(depths[id.x]);
    words[2u * id.x] = bitcast<u32>(z);
    words[2u * id.x + 1u] = bitcast<u32>(depth_from_buffer(z));
}";

/// Depths of which the buffer, or the way back, is off by more than rounding.
///
/// Bounds. In perspective each way is one quotient of 2.5 units in the last place (WGSL) of rounded numbers: 8 u relative.
/// In parallel views each way is a difference, a quotient and a product of numbers up to `far`: 8 u of `far`.
fn wrong_depths(view: &View, depths: &[f32], given: &[Vec<u32>]) -> usize {
    let span = view.far - view.near;
    depths
        .iter()
        .zip(given)
        .filter(|(depth, words)| {
            let depth = f64::from(**depth);
            let [z, back] = [words[0], words[1]].map(|w| f64::from(f32::from_bits(w)));
            let expected = view.buffer_from_depth(depth);
            let (z_bound, back_bound) = if view.orthographic {
                (8.0 * U * view.far / span, 8.0 * U * view.far)
            } else {
                (8.0 * U * expected, 8.0 * U * depth)
            };
            (z - expected).abs() > z_bound || (back - depth).abs() > back_bound
        })
        .count()
}

#[test]
fn depth_survives_the_buffer() {
    let random = &mut Random(SEED);
    for view in views() {
        let span = (view.far - view.near) as f32;
        let mut depths: Vec<f32> = (0..4000)
            .map(|_| view.near as f32 + random.signed().abs() * span)
            .collect();
        depths.push(view.near as f32);
        let inputs = [
            ("frame", frame_of(&view, &BOX)),
            ("depths", words_of(&depths)),
        ];
        let import = "#import cutaway::frame::{buffer_from_depth, depth_from_buffer}";
        let given = answers(&format!("{import}{ROUND_TRIP}"), &inputs, depths.len(), 2);
        assert_eq!(
            wrong_depths(&view, &depths, &given),
            0,
            "orthographic: {}",
            view.orthographic
        );
        // A buffer with near at 0 instead of at 1 is noticed at every depth.
        let forward = "#import cutaway::frame::frame
            fn buffer_from_depth(depth: f32) -> f32 { return (depth - frame.near) / (frame.far - frame.near); }
            fn depth_from_buffer(z: f32) -> f32 { return frame.near + z * (frame.far - frame.near); }";
        let given = answers(&format!("{forward}{ROUND_TRIP}"), &inputs, depths.len(), 2);
        assert!(
            wrong_depths(&view, &depths, &given) > depths.len() * 9 / 10,
            "planted forward depth"
        );
    }
}

#[test]
fn what_was_cleared_is_infinitely_far_in_perspective() {
    let [view, _] = views();
    let shader = "#import cutaway::frame::depth_from_buffer
@group(1) @binding(0) var<storage, read> depths: array<f32>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&depths) { return; }
    words[id.x] = bitcast<u32>(depth_from_buffer(depths[id.x]));
}";
    let inputs = [("frame", frame_of(&view, &BOX)), ("depths", vec![0])];
    let given = answers(shader, &inputs, 1, 1);
    let depth = f32::from_bits(given[0][0]);
    assert!(depth > 1e30, "the cleared buffer is at depth {depth}");
}

struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
}

/// Rays at random, along the axes and in the planes of two, from inside the box and from outside. None runs in a face.
fn rays() -> Vec<Ray> {
    let random = &mut Random(SEED);
    (0..6000)
        .map(|i| {
            let origin = [(); 3].map(|()| random.signed() * if i % 2 == 0 { 2.0 } else { 0.7 });
            let mut direction = [(); 3].map(|()| random.signed());
            // The eight patterns of zeros, and zeros of both signs.
            for (axis, d) in direction.iter_mut().enumerate() {
                if i >> axis & 1 == 1 {
                    *d = if random.bit() { 0.0 } else { -0.0 };
                }
            }
            if direction == [0.0; 3] {
                direction[i % 3] = 1.0;
            }
            Ray { origin, direction }
        })
        .collect()
}

fn ask_interval(view: &View, rays: &[Ray], box_interval: &str) -> Vec<Vec<u32>> {
    let shader = format!(
        "{box_interval}
@group(1) @binding(0) var<storage, read> rays: array<array<f32, 6>>;
@group(1) @binding(1) var<storage, read_write> words: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    if id.x >= arrayLength(&rays) {{ return; }}
    let r = rays[id.x];
    let interval = box_interval(Ray(vec3<f32>(r[0], r[1], r[2]), vec3<f32>(r[3], r[4], r[5])));
    words[2u * id.x] = bitcast<u32>(interval.x);
    words[2u * id.x + 1u] = bitcast<u32>(interval.y);
}}"
    );
    let rows: Vec<[[f32; 3]; 2]> = rays.iter().map(|r| [r.origin, r.direction]).collect();
    let inputs = [("frame", frame_of(view, &BOX)), ("rays", words_of(&rows))];
    answers(&shader, &inputs, rays.len(), 2)
}

/// Rays whose interval is off. Each border is a difference, a reciprocal (2.5 units in the last place) and a product: 10 u.
fn wrong_intervals(view: &View, rays: &[Ray], given: &[Vec<u32>]) -> Vec<String> {
    let frame = pack::frame(view, &BOX);
    let (mut faults, mut met) = (Vec::new(), 0);
    for (ray, words) in rays.iter().zip(given) {
        let (mut enter, mut leave) = (f64::from(frame.near), f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (f64::from(ray.origin[axis]), f64::from(ray.direction[axis]));
            let [low, high] = [frame.box_min[axis], frame.box_max[axis]].map(f64::from);
            if d == 0.0 {
                if !(low..=high).contains(&o) {
                    leave = f64::NEG_INFINITY;
                }
                continue;
            }
            let (a, b) = ((low - o) / d, (high - o) / d);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        let [x, y] = [words[0], words[1]].map(|w| f64::from(f32::from_bits(w)));
        let is_close = |a: f64, b: f64| (a - b).abs() <= 10.0 * U * b.abs();
        let is_empty = enter >= leave;
        // Within rounding of empty, either answer will do.
        let is_doubtful = (enter - leave).abs() <= 20.0 * U * (enter.abs() + leave.abs());
        met += usize::from(!is_empty);
        if is_doubtful {
            continue;
        }
        let is_right = is_close(x, enter) && is_close(y, leave);
        if (x < y) == is_empty || !(is_empty || is_right) {
            faults.push(format!(
                "{:?} + t {:?}: [{x}, {y}] should be [{enter}, {leave}]",
                ray.origin, ray.direction
            ));
        }
    }
    assert!(met > 500, "only {met} rays meet the box");
    faults
}

#[test]
fn the_box_is_entered_and_left_where_it_is() {
    let [mut view, _] = views();
    // Close enough that most rays reach the box beyond it, and some begin inside.
    view.near = 0.05;
    let rays = rays();
    let given = ask_interval(&view, &rays, "#import cutaway::frame::{Ray, box_interval}");
    let faults = wrong_intervals(&view, &rays, &given);
    assert!(
        faults.is_empty(),
        "{} of {}: {:#?}",
        faults.len(),
        rays.len(),
        &faults[..faults.len().min(8)]
    );
    // Without the near plane, what lies behind the eye counts.
    let planted = "#import cutaway::frame::{Ray, frame}
fn box_interval(ray: Ray) -> vec2<f32> {
    let a = (frame.box_min.xyz - ray.origin) / ray.direction;
    let b = (frame.box_max.xyz - ray.origin) / ray.direction;
    let low = min(a, b);
    let high = max(a, b);
    return vec2<f32>(max(low.x, max(low.y, low.z)), min(high.x, min(high.y, high.z)));
}";
    let given = ask_interval(&view, &rays, planted);
    assert!(
        wrong_intervals(&view, &rays, &given).len() > 500,
        "an interval that begins behind the eye is noticed"
    );
}
