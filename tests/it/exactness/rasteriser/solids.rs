//! Closed solids that are hard to rasterise leave no odd pixel: triangles far smaller than a pixel, and triangles with vertices at
//! the border of the guard band, beyond it, and next to the plane of the eye.

use cutaway::Model;
use cutaway::scene::{Camera, ClipSurface, Mesh};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use glam::{DVec2, DVec3};

use crate::common::numbers::Numbers;
use crate::common::{meshes, scenes, session};

const SIZE: [u32; 2] = [160, 120];

/// What a frame of one mesh leaves.
struct Left {
    odd_px: usize,
    /// Pixels with a bit in the mask.
    marked_px: usize,
    /// By pixel, how many triangles cover its sample by exact integers on the device's own coordinates, clipped ones left out.
    counts: Vec<u32>,
    clipped: usize,
}

fn left_by(mesh: Mesh, plane: ClipSurface, camera: &Camera) -> Left {
    let model = Model::new(&scenes::scene("solid", mesh, vec![plane]));
    let view = model.prepared.view_of(camera, SIZE);
    let strategy = Strategy::RAYCAST_MASK;
    let mut session = session();
    let method = Method::new(strategy, DrawOptions::by(Rasteriser::Compute));
    let drawn = session.draw(&model, &view, method);
    let outcome = drawn.unwrap_or_else(|e| panic!("{e}")).outcome;
    assert_eq!(outcome, Outcome::Complete, "a frame to look at");
    let words = |name: &str| {
        let words = session.words(method, name);
        words.unwrap_or_else(|e| panic!("{e}"))
    };
    let (mask, screen) = (words("mask"), words("screen"));
    // One part and one crossing: two bits a pixel, the upper one the total.
    let mut left = Left {
        odd_px: mask.iter().filter(|w| *w & 2 != 0).count(),
        marked_px: mask.iter().filter(|w| *w & 1 != 0).count(),
        counts: vec![0; mask.len()],
        clipped: 0,
    };
    let indices: Vec<u32> = bytemuck::pod_collect_to_vec(&model.indices.bytes());
    for triangle in indices.as_chunks::<3>().0 {
        let corners = triangle.map(|i| &screen[i as usize * 4..][..4]);
        if corners.iter().any(|c| c[3] & super::coverage::BORDERS != 0) {
            left.clipped += 1;
        } else {
            let steps = |word| (f32::from_bits(word) * 256.0).round_ties_even() as i64 + 128;
            count(
                corners.map(|c| [steps(c[0]), steps(c[1])]),
                &mut left.counts,
            );
        }
    }
    left
}

/// Counts the samples of a triangle, in 64 bits and by the top-left rule.
fn count(mut t: [[i64; 2]; 3], counts: &mut [u32]) {
    let cross = |o: [i64; 2], a: [i64; 2], b: [i64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let area = cross(t[0], t[1], t[2]);
    if area < 0 {
        t.swap(1, 2);
    }
    let range = |axis: usize| {
        let all = t.map(|p| p[axis]);
        let (low, high) = (
            all.iter().min().unwrap_or(&0),
            all.iter().max().unwrap_or(&0),
        );
        ((low + 127) >> 8).max(0)..=((high - 128) >> 8).min(i64::from(SIZE[axis]) - 1)
    };
    for y in range(1) {
        for x in range(0) {
            let sample = [x * 256 + 128, y * 256 + 128];
            let is_in = |i: usize| {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                let edge = [b[0] - a[0], b[1] - a[1]];
                let owns = edge[1] < 0 || (edge[1] == 0 && edge[0] > 0);
                cross(a, b, sample) >= i64::from(!owns)
            };
            if area != 0 && (0..3).all(is_in) {
                counts[(y * i64::from(SIZE[0]) + x) as usize] += 1;
            }
        }
    }
}

#[test]
fn triangles_far_smaller_than_a_pixel_leave_no_odd_one() {
    // Twenty triangles to a covered pixel.
    let mesh = || meshes::shape("torus?segments=280&sides=140");
    let plane = || ClipSurface::plane(DVec3::ZERO, DVec3::new(0.1, 1.0, 0.2));
    for camera in [
        scenes::orbit(30.0, 40.0, false),
        scenes::orbit(30.0, 40.0, true),
    ] {
        let left = left_by(mesh(), plane(), &camera);
        assert_eq!(left.odd_px, 0, "odd pixels");
        assert!(
            left.marked_px > 500,
            "only {} pixels of cap",
            left.marked_px
        );
        let odd = left.counts.iter().filter(|c| **c % 2 == 1).count();
        assert_eq!(odd, 0, "the definition has no odd pixel either");
        let covered = left.counts.iter().filter(|c| **c > 0).count();
        assert!(covered > 3000, "only {covered} pixels are covered");
        // The control: of so many triangles one is missing that covers a sample.
        let whole = mesh();
        let open = (0..whole.triangles.len())
            .step_by(37)
            .any(|i| left_by(meshes::without(&whole, i), plane(), &camera).odd_px > 0);
        assert!(open, "a missing triangle is not noticed");
    }
}

/// Two cones over a rim of so many corners.
fn cones(rim: &[DVec2], tips: [DVec3; 2]) -> Mesh {
    let positions = (tips.into_iter())
        .chain(rim.iter().map(|p| p.extend(0.0)))
        .collect();
    let count = rim.len() as u32;
    let around = |i: u32| [2 + i, 2 + (i + 1) % count];
    let triangles = (0..count).flat_map(|i| {
        let [a, b] = around(i);
        [[0, a, b], [1, b, a]]
    });
    Mesh {
        positions,
        triangles: triangles.collect(),
        ..Mesh::default()
    }
}

#[test]
fn vertices_at_the_guard_band_and_beyond_leave_no_crack() {
    // One unit is one pixel, and the guard band ends 16,000 of them from the upper left corner of the picture.
    let camera = scenes::parallel(DVec3::Z * 2e6, DVec3::ZERO, f64::from(SIZE[1]));
    let limit = 16_000.0;
    let mut n = Numbers(0x6_a2d);
    for (what, low, high) in [
        ("inside", 0.9, 0.99),
        ("at the border", 0.9999, 1.0001),
        ("on both sides of it", 0.5, 2.0),
        ("far beyond", 10.0, 100.0),
    ] {
        let (mut clipped, mut whole) = (0, 0);
        for _ in 0..12 {
            let rim: Vec<DVec2> = (0..9)
                .map(|i| {
                    let angle = std::f64::consts::TAU * (f64::from(i) + n.between(-0.4, 0.4)) / 9.0;
                    DVec2::from_angle(angle) * limit * n.between(low, high)
                })
                .collect();
            let mut tip = |z: f64| DVec3::new(n.between(-70.0, 70.0), n.between(-50.0, 50.0), z);
            let mesh = cones(&rim, [tip(900.0), tip(-900.0)]);
            let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(0.2, 0.1, 1.0));
            let left = left_by(mesh.clone(), plane.clone(), &camera);
            assert_eq!(left.odd_px, 0, "{what}: odd pixels");
            clipped += left.clipped;
            whole += left.counts.iter().filter(|c| **c > 0).count();
            let open = left_by(meshes::without(&mesh, 0), plane, &camera);
            assert!(open.odd_px > 0, "{what}: a crack is not noticed");
        }
        assert_eq!(clipped > 0, high > 1.0, "{what}: {clipped} are clipped");
        assert!(whole > 0 || low > 1.0, "{what}: no triangle is whole");
    }
}

#[test]
fn vertices_next_to_the_plane_of_the_eye_leave_no_crack() {
    let mut n = Numbers(0xe_9e0);
    let mut camera = scenes::looking(DVec3::ZERO, DVec3::NEG_Z, 70.0);
    camera.near = Some(1e-4);
    let (mut clipped, mut noticed) = (0, 0);
    for turn in 0..24 {
        // Around the eye, but for a side: rim corners ahead, behind, and as near to the plane of the eye as f32 tells.
        let rim: Vec<DVec2> = (0..8)
            .map(|i| {
                DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / 8.0) * n.between(0.5, 4.0)
            })
            .collect();
        let near_plane = |p: DVec3, n: &mut Numbers| match n.below(4) {
            0 => DVec3::new(p.x, p.y, -10_f64.powf(n.between(-7.0, -3.0))),
            1 => DVec3::new(p.x, p.y, 0.0),
            _ => DVec3::new(p.x, p.y, n.between(-3.0, 1.0)),
        };
        let mut mesh = cones(
            &rim,
            [DVec3::new(0.3, 0.2, -6.0), DVec3::new(-0.2, 0.1, -3.0)],
        );
        for p in &mut mesh.positions[2..] {
            *p = near_plane(*p, &mut n);
        }
        let plane = || ClipSurface::plane(DVec3::new(0.0, 0.0, -2.0), DVec3::new(0.3, 0.2, -1.0));
        // The eye itself may be inside: then every pixel is odd, and none if it is not; a crack is what differs.
        let pixels = (SIZE[0] * SIZE[1]) as usize;
        let odd = left_by(mesh.clone(), plane(), &camera);
        clipped += odd.clipped;
        assert!(
            odd.odd_px == 0 || odd.odd_px == pixels,
            "{turn}: {} odd pixels",
            odd.odd_px
        );
        let open = left_by(meshes::without(&mesh, 0), plane(), &camera).odd_px;
        noticed += usize::from(open != 0 && open != pixels);
    }
    assert!(clipped > 60, "only {clipped} triangles are clipped");
    assert!(
        noticed > 12,
        "a missing triangle is noticed in {noticed} of 24 pictures"
    );
}
