//! The pyramid over an offset map: the list of crossings over its nodes is that of the walk over all cells, bit for bit.

use std::sync::Arc;

use cutaway::Model;
use cutaway::generate::shapes;
use cutaway::gpu::{ClockSet, Program};
use cutaway::plan::{Capacities, Contents, Plan};
use cutaway::scene::{Camera, ClipSurface, Cut, OffsetMap, Scene, Wrap};
use cutaway::strategies::{self, DrawOptions, Method, ReliefWalk, Strategy};
use glam::{DMat3, DVec3};

use crate::common::scenes::orbit;
use crate::plans::words::{GPU, Random};

const SEED: u64 = 0x9_7a3d;
const SIZE: [u32; 2] = [96, 64];

/// A relief over a plane aslant, so that no ray runs along it by chance; one repeat of the map is `period` long.
fn relief(map: &Arc<OffsetMap>, wrap: Wrap, period: f64, amplitude: f64) -> ClipSurface {
    let turn = DMat3::from_rotation_z(0.4);
    let longest = f64::from(map.size()[0].max(map.size()[1]));
    let [u, v] = map.size().map(|s| f64::from(s) / longest * period);
    ClipSurface {
        u: turn * DVec3::X * u,
        v: turn * DVec3::Y * v,
        relief: Some(Arc::clone(map)),
        wrap,
        scale: DVec3::new(1.0, 1.0, amplitude),
        ..ClipSurface::plane(DVec3::new(0.07, 0.11, 0.03), DVec3::Z)
    }
}

fn scene(surfaces: Vec<ClipSurface>) -> Scene {
    let cuts = surfaces.into_iter().enumerate();
    Scene {
        parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
        cuts: cuts
            .map(|(i, s)| Cut::new(format!("cut {i}"), vec![s]))
            .collect(),
        ..Scene::default()
    }
}

/// Along the normal, aslant, grazing from either side, along the rows and the columns of the map.
fn cameras() -> [Camera; 8] {
    let turn_deg = 0.4_f64.to_degrees();
    [
        orbit(2.0, 1.0, false),
        orbit(35.0, 25.0, false),
        orbit(80.0, 3.0, false),
        orbit(87.0, 60.0, true),
        orbit(-93.0, 8.0, true),
        orbit(215.0, -25.0, false),
        orbit(88.0, turn_deg, true),
        orbit(88.0, turn_deg - 90.0, true),
    ]
}

fn plan(model: &Model, camera: &Camera, walk: ReliefWalk) -> Plan {
    let view = model.prepared.view_of(camera, SIZE);
    let capacities = Capacities {
        crossings: Some(Capacities::MOST_CROSSINGS),
        ..Capacities::UNKNOWN
    };
    let options = DrawOptions {
        relief_walk: Some(walk),
        ..DrawOptions::default()
    };
    strategies::plan(
        model,
        &view,
        Method::new(Strategy::RAYCAST_MASK, options),
        &capacities,
    )
    .unwrap_or_else(|e| panic!("{e}"))
}

/// The lists of crossings of a plan, and the pyramids where there are some.
fn lists(program: &mut Program, plan: Plan) -> [Vec<u32>; 4] {
    let has_pyramids = plan.resource_named("pyramids").is_some();
    program.load(&GPU, plan).unwrap_or_else(|e| panic!("{e}"));
    program
        .run(&GPU, ClockSet::ALL)
        .unwrap_or_else(|e| panic!("{e}"));
    let words = |name: &str| program.words(&GPU, name).unwrap_or_else(|e| panic!("{e}"));
    let pyramids = if has_pyramids {
        words("pyramids")
    } else {
        Vec::new()
    };
    [
        words("crossing_heads"),
        words("crossing_z"),
        words("crossing_surface"),
        pyramids,
    ]
}

/// Pixels of which the lists differ, and how many crossings there are.
fn differing([heads, z, surfaces, _]: &[Vec<u32>; 4], other: &[Vec<u32>; 4]) -> (usize, usize) {
    let pixels = heads.len() / 2;
    let mut crossings = 0;
    let is_stored = surfaces.len() == z.len();
    let differs = |pixel: usize, crossings: &mut usize| {
        let head = [heads[2 * pixel], heads[2 * pixel + 1]];
        assert_eq!(head[0] >> 31, 0, "a list that overflows says little");
        let count = (head[0] & 0xffff) as usize;
        *crossings += count;
        let mut places = (0..count).map(|i| i * pixels + pixel);
        head != [other[0][2 * pixel], other[0][2 * pixel + 1]]
            || places.any(|at| z[at] != other[1][at] || (is_stored && surfaces[at] != other[2][at]))
    };
    let count = (0..pixels).filter(|p| differs(*p, &mut crossings)).count();
    (count, crossings)
}

/// Heights by number of texel and place.
type Heights = fn(&mut Random, u32, u32) -> f32;

const KINDS: [(&str, Heights); 4] = [
    ("noise", |random, _, _| random.signed()),
    // Plateaus with steps of one texel.
    ("checkers", |_, x, y| ((x / 3 + y / 3) % 2) as f32),
    ("hills", |random, x, y| {
        (x as f32 * 0.21).sin() * (y as f32 * 0.17).cos() + 0.02 * random.signed()
    }),
    // Flat but for a spike here and there.
    ("spikes", |random, _, _| {
        f32::from(u8::from(random.below(90) == 0))
    }),
];

fn map(random: &mut Random, size: [u32; 2], heights: Heights) -> Arc<OffsetMap> {
    let mut texels: Vec<f32> = (0..size[0] * size[1])
        .map(|i| heights(random, i % size[0], i / size[0]))
        .collect();
    // No map is flat by chance, which would make it a plane.
    texels[0] = 1.25;
    Arc::new(OffsetMap::new(size, texels).expect("finite heights"))
}

/// Holds both ways against each other through all cameras; how many crossings there were.
fn hold(programs: &mut [Program; 2], what: &str, scene: &Scene) -> usize {
    let model = Model::new(scene);
    let mut met = 0;
    for camera in cameras() {
        let walked = lists(&mut programs[0], plan(&model, &camera, ReliefWalk::Cells));
        let passed = lists(&mut programs[1], plan(&model, &camera, ReliefWalk::Pyramid));
        assert!(walked[3].is_empty() && !passed[3].is_empty(), "two ways");
        let (differ, crossings) = differing(&walked, &passed);
        assert_eq!(differ, 0, "{what}, {:?}: pixels differ", camera.viewpoint);
        met += crossings;
    }
    met
}

#[test]
fn nodes_and_cells_find_the_same_crossings() {
    let random = &mut Random(SEED);
    let mut programs = [Program::default(), Program::default()];
    let (mut met, mut skipped) = (0, 0);
    for size in [[64, 64], [61, 45], [5, 7], [1, 40], [40, 1], [130, 3]] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for (kind, heights) in KINDS.into_iter().skip(skipped).step_by(2) {
                let map = map(random, size, heights);
                let amplitude = if random.bit() { 0.12 } else { -0.2 };
                let surface = relief(
                    &map,
                    wrap,
                    0.3 + 0.5 * f64::from(random.below(3)),
                    amplitude,
                );
                let what = format!("{kind} of {size:?}, {wrap:?}");
                met += hold(&mut programs, &what, &scene(vec![surface]));
            }
            skipped = 1 - skipped;
        }
    }
    assert!(met > 500_000, "only {met} crossings");
}

#[test]
fn reliefs_that_share_a_map_share_its_pyramid() {
    let random = &mut Random(SEED);
    let mut programs = [Program::default(), Program::default()];
    let [noise, hills] = [KINDS[0].1, KINDS[2].1].map(|kind| map(random, [37, 22], kind));
    let lifted = |surface: ClipSurface, z: f64| ClipSurface {
        origin: surface.origin + DVec3::Z * z,
        ..surface
    };
    let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(0.2, 0.1, 1.0));
    let surfaces = vec![
        relief(&noise, Wrap::Repeat, 0.9, 0.1),
        plane,
        lifted(relief(&hills, Wrap::Mirror, 0.7, 0.1), -0.3),
        lifted(relief(&noise, Wrap::Repeat, 0.4, -0.15), 0.2),
        lifted(relief(&noise, Wrap::Clamp, 0.5, 0.05), 0.3),
    ];
    let scene = scene(surfaces);
    let met = hold(&mut programs, "five clip-surfaces", &scene);
    assert!(met > 50_000, "only {met} crossings");
    let bytes = |scene: &Scene| {
        let plan = plan(&Model::new(scene), &cameras()[0], ReliefWalk::Pyramid);
        let id = plan.resource_named("pyramids").expect("pyramids");
        plan.resource(id).shape.bytes()
    };
    let mut one = scene.clone();
    one.cuts.truncate(1);
    assert_eq!(
        bytes(&scene),
        3 * bytes(&one),
        "one for two that repeat a map"
    );
}

#[test]
fn a_wrong_node_is_noticed() {
    let random = &mut Random(SEED);
    // In the middle of the slab: where the slab ends the side is known, and no node is believed that says otherwise.
    let plain = map(random, [64, 64], |_, x, y| {
        if [x, y] == [33, 35] { -1.25 } else { 0.0 }
    });
    let scene = scene(vec![relief(&plain, Wrap::Repeat, 1.0, 0.2)]);
    let model = Model::new(&scene);
    // Low over a plain with one peak and one pit, where rays come a long way through the slab and climb to the largest blocks.
    let camera = orbit(84.0, 4.0, false);
    let mut program = Program::default();
    let right = lists(&mut program, plan(&model, &camera, ReliefWalk::Pyramid));
    let mut given = Program::default();
    let mut with = |pyramids: &[u32]| {
        let mut plan = plan(&model, &camera, ReliefWalk::Pyramid);
        let id = plan.resource_named("pyramids").expect("pyramids");
        plan.passes.retain(|p| !p.name.starts_with("pyramid"));
        plan.resources[id.0].contents = Some(Contents::from_values(pyramids));
        lists(&mut given, plan)
    };
    assert_eq!(differing(&right, &with(&right[3])).0, 0, "as it was built");
    // Level 2 has 16 x 16 nodes, level 3 the next 64 and so on. One is said to lie far below all rays, not all of
    // which come to it.
    for (level, first, count) in [(2, 0, 256), (3, 256, 64), (4, 320, 16)] {
        let is_noticed = |i: usize| {
            let mut pyramids = right[3].clone();
            // An odd step, so that samples are in all columns.
            let node = first + (37 * i + 5) % count;
            let far = [100.0_f32; 2].map(f32::to_bits);
            pyramids[2 * node..2 * node + 2].copy_from_slice(&far);
            differing(&right, &with(&pyramids)).0 > 0
        };
        let noticed = (0..16).map(is_noticed).filter(|is| *is).count();
        assert!(
            noticed > 0,
            "level {level}: {noticed} of 16 wrong nodes are noticed"
        );
    }
    // A pyramid that knows nothing of the far border of a map that repeats.
    let mut torn = plan(&model, &camera, ReliefWalk::Pyramid);
    let id = torn.resource_named("pyramid_table").expect("a table");
    let mut table = vec![bytemuck::Zeroable::zeroed(); 32];
    table[0] = cutaway::plan::pack::Pyramid {
        repeats: 0,
        ..table_of(&torn)
    };
    torn.resources[id.0].contents = Some(Contents::from_values(&table));
    let torn = lists(&mut Program::default(), torn);
    assert!(
        differing(&right, &torn).0 > 0,
        "a torn border goes unnoticed"
    );
}

/// The first row of the table of pyramids of a plan.
fn table_of(plan: &Plan) -> cutaway::plan::pack::Pyramid {
    let id = plan.resource_named("pyramid_table").expect("a table");
    let contents = plan.resource(id).contents.as_ref().expect("contents");
    let bytes = contents.bytes();
    bytemuck::pod_read_unaligned(&bytes[..size_of::<cutaway::plan::pack::Pyramid>()])
}
