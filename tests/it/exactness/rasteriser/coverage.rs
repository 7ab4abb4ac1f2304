//! Which samples a triangle covers: all that an exact rasteriser says, on the coordinates that the device snapped.
//!
//! Triangles are parts of their own, so each has a lane in the mask, and the lane's top bit is its coverage: more than a count.

use cutaway::Model;
use cutaway::plan::Clock;
use cutaway::scene::{Camera, ClipSurface, Cut, Mesh, Part, Scene, Style};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use glam::DVec3;

use crate::common::numbers::Numbers;
use crate::common::{scenes, session};

const SEED: u64 = 0xc0_7e4;
const SIZE: [u32; 2] = [200, 150];
/// Bits of the borders that a vertex on a screen may be beyond; those of the sides of the picture follow.
pub(super) const BORDERS: u32 = 31;

/// What the device made of a scene whose parts are soups of triangles.
struct Device {
    /// By part, then by pixel: whether an odd number of its triangles cover the sample.
    odd: Vec<Vec<bool>>,
    /// By part: its triangles in steps of 1/256 px, and whether they are to be clipped.
    screen: Vec<Vec<([[i64; 2]; 3], bool)>>,
}

/// Draws parts of loose triangles, cut by the plane x = 0.01, which all of them must meet.
fn drawn(parts: &[Vec<[DVec3; 3]>], camera: &Camera) -> Device {
    let made = parts.iter().enumerate().map(|(i, soup)| {
        let mesh = Mesh {
            positions: soup.as_flattened().to_vec(),
            triangles: (0..soup.len() as u32)
                .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
                .collect(),
            ..Mesh::default()
        };
        Part::new(format!("part {i}"), mesh)
    });
    let plane = ClipSurface::plane(DVec3::X * 0.01, DVec3::X);
    let scene = Scene {
        name: "soup".to_owned(),
        parts: made.collect(),
        cuts: vec![Cut::new("cut", vec![plane])],
        camera: *camera,
        stage: None,
        outline: None,
        interference: None,
        style: Style::default(),
    };
    let model = Model::new(&scene);
    let view = model.prepared.view_of(camera, SIZE);
    let strategy = Strategy::RAYCAST_MASK;
    let mut session = session();
    let method = Method::new(strategy, DrawOptions::by(Rasteriser::Compute));
    let drawn = session
        .draw(&model, &view, method)
        .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(drawn.outcome, Outcome::Complete, "a frame to look at");
    let words = |name: &str| {
        session
            .words(method, name)
            .unwrap_or_else(|e| panic!("{e}"))
    };
    let (mask, screen, table) = (words("mask"), words("screen"), words("parts"));
    let plan = session.plan(method).expect("the plan of a drawn frame");
    assert!(
        plan.passes
            .iter()
            .any(|p| p.name == "mark large" && p.clock == Clock::Frame),
        "compute"
    );

    let rows: Vec<cutaway::plan::pack::Part> = bytemuck::pod_collect_to_vec(&table);
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    let indices: Vec<u32> = bytemuck::pod_collect_to_vec(&model.indices.bytes());
    let mut device = Device {
        odd: vec![Vec::new(); parts.len()],
        screen: vec![Vec::new(); parts.len()],
    };
    // Rows beyond the parts that are drawn are of none.
    for row in rows.iter().filter(|row| row.cuts != 0) {
        let top = row.lane_shift + 1;
        let first = row.lane_word as usize * pixels;
        device.odd[row.part as usize] = (0..pixels)
            .map(|p| mask[first + p] >> top & 1 == 1)
            .collect();
    }
    for (part, range) in model.prepared.parts.iter().zip(&model.ranges) {
        let own = &indices[range.indices.start as usize..range.indices.end as usize];
        for triangle in own.as_chunks::<3>().0 {
            let corners = triangle.map(|i| (i as i32 + range.base_vertex) as usize * 4);
            let at = corners.map(|c| [0, 1].map(|k| steps_of(screen[c + k])));
            let is_clipped = corners.iter().any(|c| screen[c + 3] & BORDERS != 0);
            device.screen[part.part].push((at, is_clipped));
        }
    }
    device
}

/// A coordinate that the device keeps, in pixels from the first sample, as steps of 1/256 px.
fn steps_of(word: u32) -> i64 {
    (f32::from_bits(word) * 256.0).round_ties_even() as i64 + 128
}

/// A bias for samples on an edge: 0 where it is a top or left one of a triangle that runs clockwise on screen.
type Bias = fn([i64; 2]) -> i64;

fn top_left(edge: [i64; 2]) -> i64 {
    -i64::from(!(edge[1] < 0 || (edge[1] == 0 && edge[0] > 0)))
}

/// Coverage by the definition, in 64 bits: differences take 23 bits each, products 46.
fn covers(mut t: [[i64; 2]; 3], sample: [i64; 2], bias: Bias) -> bool {
    let cross = |o: [i64; 2], a: [i64; 2], b: [i64; 2]| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let area = cross(t[0], t[1], t[2]);
    if area < 0 {
        t.swap(1, 2);
    }
    area != 0
        && (0..3).all(|i| {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            cross(a, b, sample) + bias([b[0] - a[0], b[1] - a[1]]) >= 0
        })
}

fn sample_of(pixel: usize) -> [i64; 2] {
    let width = SIZE[0] as usize;
    [pixel % width, pixel / width].map(|c| c as i64 * 256 + 128)
}

/// Samples of which the device and the definition say different things, and how many are covered.
fn wrong_samples(device: &Device, bias: Bias) -> (usize, usize) {
    let (mut wrong, mut covered) = (0, 0);
    for (odd, triangles) in device.odd.iter().zip(&device.screen) {
        for (pixel, is_odd) in odd.iter().enumerate() {
            let sample = sample_of(pixel);
            let count = triangles
                .iter()
                .filter(|(t, _)| covers(*t, sample, bias))
                .count();
            covered += usize::from(count > 0);
            wrong += usize::from((count % 2 == 1) != *is_odd);
        }
    }
    (wrong, covered)
}

fn front() -> Camera {
    scenes::parallel(DVec3::Z * 5.0, DVec3::ZERO, 1.5)
}

/// A triangle that meets the plane: its first corner is on the one side, its second on the other.
fn triangle(n: &mut Numbers, reach: f64, width: f64) -> [DVec3; 3] {
    let mut point = |x: f64| DVec3::new(x, n.between(-reach, reach) * 0.75, n.between(-0.4, 0.4));
    let (a, b) = (point(-reach), point(reach));
    let share = n.unit();
    let aside = DVec3::new(n.between(-width, width), n.between(-width, width), 0.0);
    [a * n.unit(), b * n.unit(), a.lerp(b, share) + aside]
}

#[test]
fn random_triangles_cover_what_they_must() {
    let mut n = Numbers(SEED);
    for (what, reach, width) in [
        ("small", 0.06, 0.05),
        ("of the picture", 0.9, 0.8),
        ("slivers", 0.9, 2e-3),
        ("needles", 0.9, 1e-5),
        ("larger than the picture", 20.0, 20.0),
        ("as large as the guard band", 75.0, 75.0),
    ] {
        let parts: Vec<Vec<[DVec3; 3]>> = (0..120)
            .map(|_| vec![triangle(&mut n, reach, width)])
            .collect();
        let device = drawn(&parts, &front());
        assert!(
            device.screen.iter().flatten().all(|(_, clipped)| !clipped),
            "{what}: none is clipped"
        );
        let (wrong, covered) = wrong_samples(&device, top_left);
        assert_eq!(wrong, 0, "{what}: of {covered} covered samples");
        assert!(covered > 300, "{what}: only {covered} samples are covered");
    }
}

/// Fans and grids whose corners are at pixel centres: samples on edges and corners are the rule.
fn at_pixel_centres() -> Vec<Vec<[DVec3; 3]>> {
    // 1.5 units are 150 pixels, and the middle of the picture is between pixels.
    let at = |x: i32, y: i32| {
        DVec3::new(
            (f64::from(x) + 0.5) * 0.01,
            (f64::from(y) + 0.5) * 0.01,
            0.0,
        )
    };
    let rim: Vec<DVec3> = (-30..30)
        .map(|i| at(i, -30))
        .chain((-30..30).map(|i| at(30, i)))
        .chain((-30..30).map(|i| at(-i, 30)))
        .chain((-30..30).map(|i| at(-30, -i)))
        .collect();
    // Neighbours in different parts: alternate triangles of the fan.
    let mut parts = vec![Vec::new(), Vec::new()];
    for i in 0..rim.len() {
        parts[i % 2].push([at(3, 7), rim[i], rim[(i + 1) % rim.len()]]);
    }
    parts
}

#[test]
fn a_sample_on_an_edge_belongs_to_one_triangle() {
    let device = drawn(&at_pixel_centres(), &front());
    let on_centres = device
        .screen
        .iter()
        .flatten()
        .filter(|(t, _)| t.as_flattened().iter().all(|c| c & 255 == 128));
    assert_eq!(on_centres.count(), 240, "corners are at pixel centres");
    let (wrong, covered) = wrong_samples(&device, top_left);
    assert_eq!(wrong, 0, "of {covered}");
    let both: usize = device.odd[0]
        .iter()
        .zip(&device.odd[1])
        .filter(|(a, b)| **a && **b)
        .count();
    let either: usize = device.odd[0]
        .iter()
        .zip(&device.odd[1])
        .filter(|(a, b)| **a || **b)
        .count();
    assert_eq!((both, either), (0, 3600), "60 x 60 samples, each once");
    // The control: without the rule, and with that of the other corner.
    let (closed, _) = wrong_samples(&device, |_| 0);
    let (opposite, _) = wrong_samples(&device, |e| -1 - top_left(e));
    assert!(
        closed > 100 && opposite > 100,
        "other rules: {closed}, {opposite} samples differ"
    );
}

#[test]
fn triangles_across_the_near_plane_leave_no_crack() {
    // A floor that reaches from behind the eye to far ahead, and far to both sides: its triangles are clipped by the near
    // plane and by the guard band. Neighbours are in different parts.
    let mut parts = vec![Vec::new(), Vec::new()];
    let mut n = Numbers(SEED);
    let cells = 12;
    let mut points = vec![DVec3::ZERO; (cells + 1) * (cells + 1)];
    for (i, p) in points.iter_mut().enumerate() {
        let (x, z) = ((i % (cells + 1)) as f64, (i / (cells + 1)) as f64);
        let shift = DVec3::new(n.between(-0.3, 0.3), 0.0, n.between(-0.3, 0.3));
        *p = DVec3::new(x - 6.0, -0.02, z - 6.0) + shift;
    }
    for cell in 0..cells * cells {
        let a = cell / cells * (cells + 1) + cell % cells;
        let corner = [a, a + 1, a + cells + 2, a + cells + 1].map(|i| points[i]);
        parts[0].push([corner[0], corner[1], corner[2]]);
        parts[1].push([corner[0], corner[2], corner[3]]);
    }
    let mut camera = scenes::looking(
        DVec3::new(0.03, 0.0, 0.05),
        DVec3::new(0.4, -0.1, -5.0),
        80.0,
    );
    camera.near = Some(1e-3);
    let device = drawn(&parts, &camera);
    let clipped = device.screen.iter().flatten().filter(|(_, c)| *c).count();
    assert!(clipped > 20, "only {clipped} triangles are clipped");
    let [first, second] = &device.odd[..] else {
        panic!("two parts")
    };
    let both = first.iter().zip(second).filter(|(a, b)| **a && **b).count();
    assert_eq!(both, 0, "samples in two triangles");
    // The floor fills the lower part of the picture without a hole: below the first covered sample of a column all are.
    let width = SIZE[0] as usize;
    let mut filled = 0;
    for x in 0..width {
        let column: Vec<bool> = (0..SIZE[1] as usize)
            .map(|y| first[y * width + x] || second[y * width + x])
            .collect();
        let top = column
            .iter()
            .position(|c| *c)
            .expect("the floor is in every column");
        let holes = column[top..].iter().filter(|c| !**c).count();
        assert_eq!(holes, 0, "holes in column {x}");
        filled += column.len() - top;
    }
    assert!(filled > 8_000, "only {filled} samples are of the floor");
    // The control: without the clipped triangles the floor has holes below its first row.
    let kept = Device {
        screen: device
            .screen
            .iter()
            .map(|s| s.iter().copied().filter(|(_, c)| !c).collect())
            .collect(),
        odd: device.odd,
    };
    let (missing, _) = wrong_samples(&kept, top_left);
    assert!(
        missing > 1000,
        "clipped triangles cover only {missing} samples"
    );
}
