//! Different ways to the same frame: one sweep or two, one invocation or a workgroup to a triangle, triangles in another order,
//! one thread or two. All leave the same mask, and the same layers and picture to the bit.

use std::process::Command;

use cutaway::Model;
use cutaway::gpu::{ClockSet, Program};
use cutaway::plan::{Capacities, Plan, Work};
use cutaway::scene::{ClipSurface, Mesh, Scene, View};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use glam::DVec3;

use crate::common::numbers::Numbers;
use crate::common::{meshes, scenes, session};
use crate::exactness::rasteriser::agree::{self, lane_bits};

const SIZE: [u32; 2] = [160, 120];

/// Every word of a frame.
#[derive(PartialEq)]
pub(super) struct Frame {
    pub(super) mask: Vec<u32>,
    pub(super) layers: Vec<u32>,
    picture: Vec<u32>,
    /// The bits of a word of the mask that say whether a total is odd.
    totals: u32,
}

impl Frame {
    pub(super) fn odd_words(&self) -> usize {
        self.mask.iter().filter(|w| *w & self.totals != 0).count()
    }

    /// What two frames do not share, in words.
    pub(super) fn describe(&self, other: &Self) -> String {
        let differ = |a: &[u32], b: &[u32]| a.iter().zip(b).filter(|(a, b)| a != b).count();
        format!(
            "{} words of masks, {} of layers, {} pixels of pictures differ",
            differ(&self.mask, &other.mask),
            differ(&self.layers, &other.layers),
            differ(&self.picture, &other.picture)
        )
    }
}

/// A frame by the compute rasteriser, with one sweep or two, by a plan that may have been changed.
pub(super) fn frame(model: &Model, view: &View, wide: bool, change: impl Fn(&mut Plan)) -> Frame {
    let options = DrawOptions {
        rasteriser: Some(Rasteriser::Compute),
        wide_atomics: Some(wide),
        ..DrawOptions::default()
    };
    // More than any of these scenes needs.
    let capacities = Capacities {
        crossings: Some(15),
        ..Capacities::UNKNOWN
    };
    let strategy = Strategy::RAYCAST_MASK;
    let mut plan = strategies::plan(model, view, Method::new(strategy, options), &capacities)
        .unwrap_or_else(|e| panic!("{e}"));
    change(&mut plan);
    let bits = lane_bits(&plan);
    let session = session();
    let gpu = session.gpu();
    let mut program = Program::default();
    program.load(gpu, plan).unwrap_or_else(|e| panic!("{e}"));
    program
        .run(gpu, ClockSet::ALL)
        .unwrap_or_else(|e| panic!("{e}"));
    let words = |name: &str| program.words(gpu, name).unwrap_or_else(|e| panic!("{e}"));
    Frame {
        mask: words("mask"),
        layers: words("layers"),
        picture: words("picture"),
        totals: (1..=32 / bits).fold(0, |all, lane| all | 1 << (lane * bits - 1)),
    }
}

pub(super) fn as_recorded(_: &mut Plan) {}

/// Gives another value to what the passes over triangles call small.
fn small(px: f64) -> impl Fn(&mut Plan) {
    move |plan| {
        let constants = plan.passes.iter_mut().flat_map(|p| &mut p.constants);
        for (_, value) in constants.filter(|(name, _)| *name == "small_px") {
            *value = px;
        }
    }
}

fn without(what: &'static str) -> impl Fn(&mut Plan) {
    move |plan| plan.passes.retain(|p| !p.name.starts_with(what))
}

/// Lets the second sweep see 64 triangles only.
fn claiming_little(plan: &mut Plan) {
    for pass in plan.passes.iter_mut().filter(|p| p.name == "claim small") {
        pass.work = Work::Compute { groups: [1; 3] };
    }
}

/// Whether the adapter of the tests has atomics of 64 bits.
fn has_wide_atomics() -> bool {
    let has = session().gpu().limits().wide_atomics;
    if !has {
        println!("no atomics of 64 bits: one sweep is not compared with two");
    }
    has
}

#[test]
fn one_sweep_is_as_good_as_two() {
    if !has_wide_atomics() {
        return;
    }
    let mut noticed = 0;
    for (label, scene, camera) in agree::scenes_and_cameras() {
        let model = Model::new(&scene);
        let view = model.prepared.view_of(&camera, SIZE);
        let two = frame(&model, &view, false, as_recorded);
        let one = frame(&model, &view, true, as_recorded);
        assert!(one == two, "{label}: {}", one.describe(&two));
        // What is in front of a crossing has the parity of what is behind it, since all of it is even.
        assert_eq!(one.odd_words(), 0, "{label}: odd totals");
        noticed += usize::from(frame(&model, &view, false, claiming_little) != two);
    }
    assert!(
        noticed > 15,
        "the second sweep does nothing but in {noticed}"
    );
}

#[test]
fn a_workgroup_covers_what_an_invocation_covers() {
    for (label, scene, camera) in agree::scenes_and_cameras().step_by(4) {
        let model = Model::new(&scene);
        let view = model.prepared.view_of(&camera, SIZE);
        let by_size = frame(&model, &view, false, as_recorded);
        let by_groups = frame(&model, &view, false, small(0.0));
        assert!(
            by_groups == by_size,
            "{label}: {}",
            by_groups.describe(&by_size)
        );
        let lost = frame(&model, &view, false, |plan| {
            small(0.0)(plan);
            without("mark large")(plan);
        });
        assert!(lost.mask != by_size.mask, "{label}: no triangle was queued");
    }
}

/// A rectangle of 8000 x 400 units in the plane z = 0, of so many squares along each side.
fn rectangle(cells: [usize; 2]) -> Mesh {
    let row = cells[0] + 1;
    let at = |i: usize| {
        let x = (i % row) as f64 / cells[0] as f64;
        let y = (i / row) as f64 / cells[1] as f64;
        DVec3::new(8000.0 * x - 4000.25, 400.0 * y - 200.25, 0.0)
    };
    let corner = |i: usize| i / cells[0] * row + i % cells[0];
    let square = |i: usize| {
        let [a, b, c, d] = [0, 1, row + 1, row].map(|o| (corner(i) + o) as u32);
        [[a, b, c], [a, c, d]]
    };
    Mesh {
        positions: (0..row * (cells[1] + 1)).map(at).collect(),
        triangles: (0..cells[0] * cells[1]).flat_map(square).collect(),
        ..Mesh::default()
    }
}

#[test]
fn two_triangles_of_8192_px_cover_what_many_small_ones_do() {
    let size = [8192, 512];
    let plane = || vec![ClipSurface::plane(DVec3::X * 17.0, DVec3::X)];
    let camera = scenes::parallel(DVec3::Z * 5000.0, DVec3::ZERO, 512.0);
    let of = |cells| {
        let model = Model::new(&scenes::scene("rectangle", rectangle(cells), plane()));
        let view = model.prepared.view_of(&camera, size);
        frame(&model, &view, false, as_recorded)
    };
    let whole = of([1, 1]);
    let pieces = of([250, 25]);
    assert!(whole.mask == pieces.mask, "{}", whole.describe(&pieces));
    let covered = whole.odd_words();
    assert_eq!(covered, 8000 * 400, "samples of a rectangle of that size");
    // The control: a rectangle that ends one pixel earlier.
    let mut cut_short = rectangle([250, 25]);
    cut_short
        .positions
        .iter_mut()
        .for_each(|p| p.y = p.y.min(198.6));
    let model = Model::new(&scenes::scene("short", cut_short, plane()));
    let short = frame(
        &model,
        &model.prepared.view_of(&camera, size),
        false,
        as_recorded,
    );
    assert!(short.mask != whole.mask, "a missing row is not noticed");
}

#[test]
fn the_order_of_triangles_does_not_matter() {
    let section = "-1,-0.3,-0.6@50%,45%,60%";
    let mut scene = scenes::sectioned("torus?segments=60&sides=30", &[section]);
    let camera = scenes::orbit(40.0, 30.0, false);
    let draw = |scene: &Scene| {
        let model = Model::new(scene);
        let view = model.prepared.view_of(&camera, SIZE);
        frame(&model, &view, has_wide_atomics(), as_recorded)
    };
    let first = draw(&scene);
    let mut n = Numbers(0x5_f1e);
    for turn in 0..4 {
        let triangles = &mut std::sync::Arc::make_mut(&mut scene.parts[0].mesh).triangles;
        for i in (1..triangles.len()).rev() {
            triangles.swap(i, n.below(i as u64 + 1) as usize);
        }
        let shuffled = draw(&scene);
        assert!(
            shuffled.mask == first.mask,
            "{turn}: {}",
            shuffled.describe(&first)
        );
        // Vertices are welded and normals summed in another order: only what normals say may differ, in its last bits.
        let kinds_and_depths = |f: &Frame| -> Vec<[u32; 2]> {
            (f.layers.as_chunks::<3>().0.iter())
                .map(|[word, _, depth]| [*word, *depth])
                .collect()
        };
        assert!(
            kinds_and_depths(&shuffled) == kinds_and_depths(&first),
            "{turn}: {}",
            shuffled.describe(&first)
        );
    }
    // The control: a mesh without its first triangle, whichever that has become.
    scene.parts[0].mesh = std::sync::Arc::new(meshes::without(&scene.parts[0].mesh, 0));
    let open = draw(&scene);
    assert!(open.mask != first.mask, "a missing triangle is not noticed");
}

#[test]
fn threads_do_not_matter() {
    let folder = std::env::temp_dir().join(format!("cutaway-threads-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder to write to");
    let render = |threads: &str, section: &str| {
        let file = folder.join(format!("{threads}{section}.png").replace(['%', '='], ""));
        let ran = Command::new(env!("CARGO_BIN_EXE_cutaway-tested"))
            .args([
                "render",
                "shape:crank?throws=2&detail=16",
                "--rasteriser",
                "compute",
            ])
            .args(["--resolution", "320x240", section, "-o"])
            .arg(&file)
            .env("LP_NUM_THREADS", threads)
            .output()
            .expect("the program runs");
        assert!(
            ran.status.success(),
            "{}",
            String::from_utf8_lossy(&ran.stderr)
        );
        std::fs::read(&file).expect("a picture")
    };
    let (one, two) = (
        render("1", "--section=-z=50%"),
        render("2", "--section=-z=50%"),
    );
    assert!(one == two, "pictures by one thread and by two");
    assert!(
        render("1", "--section=-z=51%") != one,
        "another cut is not noticed"
    );
    std::fs::remove_dir_all(&folder).expect("a folder of our own");
}
