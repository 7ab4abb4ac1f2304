//! Along every ray the side at the end is the side at the start turned round at each crossing, against the tessellated surface in
//! f64: a missing crossing would show.

use cutaway::plan::Plan;
use cutaway::plan::pack::{Frame, Quad};
use cutaway::scene::{Camera, PreparedSurface, Scene};
use glam::{DVec2, DVec3};

use super::{ring, roomy, row, run};
use crate::common::{Question, scenes};

const SIZE: [u32; 2] = [160, 120];
/// A point nearer to the sheet than this, in scene units, may be on either side: vertices are moved to 256ths of a pixel.
const ON_THE_SHEET: f64 = 2e-4;

fn xyz(row: [f32; 4]) -> DVec3 {
    DVec3::new(f64::from(row[0]), f64::from(row[1]), f64::from(row[2]))
}

/// By how much a point is on the kept side of a grid.
fn kept_height(surface: &PreparedSurface, quad: &Quad, point: DVec3) -> f64 {
    let (corner, u, v) = (xyz(quad.corner), xyz(quad.step_u), xyz(quad.step_v));
    let map = surface.relief.as_ref().expect("a relief");
    let height = |at: DVec2| {
        let d = corner + u * at.x + v * at.y - surface.origin;
        let along = DVec2::new(d.dot(surface.frame.u_hat), d.dot(surface.frame.v_hat));
        let t = along * DVec2::from(surface.map_per_unit);
        map.sample(surface.wrap, t).0 * surface.height_scale
    };
    let d = point - corner;
    let at = DVec2::new(d.dot(u) / u.length_squared(), d.dot(v) / v.length_squared());
    let cell = at.floor();
    let l = at - cell;
    let (first, last) = (height(cell), height(cell + 1.0));
    let over = if l.x >= l.y {
        let third = height(cell + DVec2::X);
        first + l.x * (third - first) + l.y * (last - third)
    } else {
        let third = height(cell + DVec2::Y);
        first + l.y * (third - first) + l.x * (last - third)
    };
    (point - surface.origin).dot(surface.frame.normal) + over
}

/// The interval of a ray in the box of the cut parts, beyond the near plane.
fn interval(frame: &Frame, (origin, direction): (DVec3, DVec3)) -> Option<(f64, f64)> {
    let (low, high) = (xyz(frame.box_min), xyz(frame.box_max));
    let (a, b) = ((low - origin) / direction, (high - origin) / direction);
    let enter = a.min(b).max_element().max(f64::from(frame.near));
    let leave = a.max(b).min_element();
    (enter + 1e-4 < leave).then_some((enter, leave))
}

fn uploaded<T: bytemuck::AnyBitPattern + bytemuck::NoUninit>(plan: &Plan, name: &str) -> Vec<T> {
    let id = plan
        .resource_named(name)
        .unwrap_or_else(|| panic!("no {name}"));
    let contents = plan.resource(id).contents.as_ref();
    bytemuck::pod_collect_to_vec(&contents.expect("an upload").bytes())
}

/// Rays that are looked at, that cross a sheet, and whose list is at odds with the surface.
fn at_odds(question: &Question, plan: Plan, reliefs: &[usize]) -> [usize; 3] {
    let quads: Vec<Quad> = uploaded(&plan, "quads");
    let frame: Frame = uploaded(&plan, "frame")[0];
    let one_surface = quads.len() == 1;
    let buffers = ["crossing_heads", "crossing_surface"];
    let (_, words) = run(plan, SIZE, &buffers);
    let [heads, surfaces] = &words[..] else {
        panic!("two buffers");
    };
    let pixels = (SIZE[0] * SIZE[1]) as usize;
    let (mut asked, mut crossed, mut odd) = (0, 0, 0);
    for pixel in 0..pixels {
        let (x, y) = (pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]);
        let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let (origin, direction) = question.view.ray(at);
        let Some((enter, leave)) = interval(&frame, (origin, direction)) else {
            continue;
        };
        let count = (heads[2 * pixel] & 0xff) as usize;
        for s in reliefs {
            let surface = &question.model.prepared.surfaces[*s];
            let of = |depth: f64| kept_height(surface, &quads[*s], origin + direction * depth);
            let (start, end) = (of(enter), of(leave));
            if start.abs() < ON_THE_SHEET || end.abs() < ON_THE_SHEET {
                continue;
            }
            asked += 1;
            let crossings = (0..count)
                .filter(|i| one_surface || surfaces[i * pixels + pixel] as usize == *s)
                .count();
            crossed += usize::from(crossings > 0);
            let starts_removed = heads[2 * pixel + 1] >> s & 1 == 1;
            let ends_removed = starts_removed != (crossings % 2 == 1);
            let right = starts_removed == (start < 0.0) && ends_removed == (end < 0.0);
            odd += usize::from(!right || heads[2 * pixel] >> 31 == 1);
        }
    }
    [asked, crossed, odd]
}

fn corpus() -> Vec<(Scene, Vec<usize>)> {
    let seen = |mut scene: Scene, camera: Camera| {
        scene.camera = camera;
        scene
    };
    vec![
        (ring(), vec![0]),
        (seen(ring(), scenes::orbit(35.0, 3.0, false)), vec![0]),
        (seen(ring(), scenes::orbit(200.0, -10.0, true)), vec![0]),
        (row(), vec![0, 1]),
        (seen(row(), scenes::orbit(5.0, 1.0, false)), vec![0, 1]),
    ]
}

#[test]
fn sides_at_both_ends_follow_from_the_list() {
    let mut faults = Vec::new();
    for (scene, reliefs) in corpus() {
        let question = Question::new(&scene, SIZE);
        for cells in [1, 8, 64, 300] {
            let plan = roomy(&question, &format!("grid:{cells}+mask"));
            let [asked, crossed, odd] = at_odds(&question, plan, &reliefs);
            println!(
                "{}, {cells} cells: {odd} of {asked}, {crossed} cross",
                scene.name
            );
            assert!(crossed > 1000, "{crossed} rays of {asked} cross");
            if odd > 0 {
                faults.push(format!("{}, {cells} cells: {odd} of {asked}", scene.name));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_hole_in_a_sheet_is_seen() {
    let question = Question::new(&ring(), SIZE);
    let mut plan = roomy(&question, "grid:64+mask");
    for pass in &mut plan.passes {
        if let cutaway::plan::Work::Draw { draws, .. } = &mut pass.work
            && pass.name.starts_with("sheet")
        {
            // Half of the rows, to leave a border across the picture.
            draws[0].indices.end /= 2;
        }
    }
    let [asked, _, odd] = at_odds(&question, plan, &[0]);
    assert!(odd * 10 > asked, "{odd} of {asked} rays notice the hole");
}
