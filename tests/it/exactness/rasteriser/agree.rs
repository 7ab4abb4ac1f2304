//! Frames of the compute rasteriser against exact and against those of the GPU's own.

use cutaway::layers::Layer;
use cutaway::plan::Plan;
use cutaway::scene::{Camera, ClipSurface, Cut, Scene};
use cutaway::session::Outcome;
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};

use crate::common::meshes;
use crate::common::{Judged, Question, class_of, coarseness, scenes, session};

const SIZE: [u32; 2] = [160, 120];

/// With all crossings in the lists, so that masks are the same word by word.
const COMPUTE: DrawOptions = DrawOptions {
    list: Some(true),
    ..DrawOptions::by(Rasteriser::Compute)
};

const SHAPES: [&str; 9] = [
    "cube",
    "sphere?subdivisions=3",
    "torus?segments=40&sides=20",
    "comb?teeth=8",
    "sponge?level=2",
    "earth?subdivisions=3",
    "gears?flank=2",
    "conduit?segments=16&sides=24",
    "crank?throws=2&detail=16",
];

/// Gives a scene its cuts.
type Cutting = fn(&mut Scene);

const CUTS: [(&str, Cutting); 3] = [
    ("plane", |s| {
        s.cuts = vec![Cut::new("cut", vec![section(s, "-1,-2,-1.5@50%,45%,60%")])];
    }),
    ("relief", |s| {
        let rough = "fractal:size=64,amplitude=8%";
        let surface = scenes::relief(s, "-0.4,-0.3,-1@50%,50%,55%", rough);
        s.cuts = vec![Cut::new("cut", vec![surface])];
    }),
    ("two cuts", |s| {
        let rough = scenes::relief(s, "-z=70%", "waves:size=32,amplitude=5%");
        let plane = section(s, "-1,0.2,0.1@65%,50%,50%");
        s.cuts = vec![Cut::new("one", vec![rough]), Cut::new("two", vec![plane])];
    }),
];

fn section(scene: &Scene, text: &str) -> ClipSurface {
    ClipSurface::parse(text, &scene.bounds()).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn scene_of(shape: &str, cutting: Cutting) -> Scene {
    let mut scene = scenes::of_parts(shape, meshes::parts(shape), Vec::new());
    cutting(&mut scene);
    scene
}

/// The lanes of a mask.
#[derive(PartialEq)]
struct Mask {
    words: Vec<u32>,
    lane_bits: u32,
}

impl Mask {
    /// The bits of a word that hold the total parity of a lane.
    fn totals(&self) -> u32 {
        (1..=32 / self.lane_bits).fold(0, |bits, lane| bits | 1 << (lane * self.lane_bits - 1))
    }
}

/// The answer by a rasteriser, and its mask.
fn answer(question: &Question, options: DrawOptions) -> (Judged, Mask) {
    let strategy = Strategy::RAYCAST_MASK;
    let mut session = session();
    let method = Method::new(strategy, options);
    let drawn = session
        .draw(&question.model, &question.view, method)
        .unwrap_or_else(|e| panic!("{e}"));
    let words = |name: &str| {
        let words = session.words(method, name);
        words.unwrap_or_else(|e| panic!("{e}"))
    };
    let mask = Mask {
        words: words("mask"),
        lane_bits: lane_bits(session.plan(method).expect("the plan of a drawn frame")),
    };
    let judged = question.judge(&session, method, drawn.outcome);
    (judged, mask)
}

/// How wide a lane of the mask is.
pub(crate) fn lane_bits(plan: &Plan) -> u32 {
    let found = (plan.passes.iter())
        .flat_map(|p| &p.constants)
        .find(|(name, _)| *name == "lane_bits");
    found.expect("how wide a lane is").1 as u32
}

/// How far two depths of one pixel may be apart: rasterisers find depth with vertices snapped to 1/256 px or not, which moves
/// it by that much along the slope of the surface.
fn depth_bound(question: &Question, layer: &Layer) -> f64 {
    // Shading normals of coarse round shapes lean from those of their faces.
    let facing = layer.normal.as_dvec3().dot(question.view.forward).abs();
    let facing = (facing - 0.15).max(0.01);
    question.view.pixel_size(layer.depth) * coarseness() / 128.0 / facing + 1e-5 * layer.depth
}

/// Every shape with every cut, through cameras of both kinds.
pub(crate) fn scenes_and_cameras() -> impl Iterator<Item = (String, Scene, Camera)> {
    SHAPES.into_iter().flat_map(|shape| {
        CUTS.into_iter()
            .enumerate()
            .map(move |(i, (name, cutting))| {
                let scene = scene_of(shape, cutting);
                let orthographic = (i + shape.len()) % 2 == 0;
                let camera = scenes::orbit(30.0, 25.0, orthographic);
                let label = format!("{shape}, {name}, orthographic: {orthographic}");
                (label, scene, camera)
            })
    })
}

fn questions() -> impl Iterator<Item = (String, Question)> {
    scenes_and_cameras()
        .map(|(label, scene, camera)| (label, Question::through(&scene, &camera, SIZE)))
}

#[test]
fn frames_are_exact_and_those_of_the_hardware() {
    let mut faults = Vec::new();
    let (mut compared, mut open_bits) = (0, 0);
    for (label, question) in questions() {
        let (hardware, hardware_mask) = answer(&question, DrawOptions::default());
        let (compute, compute_mask) = answer(&question, COMPUTE);
        assert_eq!(compute.outcome, Outcome::Complete, "{label}");
        if let Some(fault) = compute.fault_of_exact() {
            faults.push(format!("{label}: {fault}"));
        }
        assert_eq!(
            hardware_mask.words.len(),
            compute_mask.words.len(),
            "{label}: lanes"
        );
        let pixels = compute.layers.pixels.len();
        let undecided = &hardware.exact.undecided;
        for (i, (a, b)) in (hardware_mask.words.iter().zip(&compute_mask.words)).enumerate() {
            compared += usize::from(*a != 0);
            let decided = !undecided[i % pixels];
            open_bits += usize::from(a != b && decided);
            if decided && (a ^ b) & compute_mask.totals() != 0 {
                faults.push(format!("{label}: totals of pixel {} differ", i % pixels));
            }
        }
        for (i, (a, b)) in hardware
            .layers
            .pixels
            .iter()
            .zip(&compute.layers.pixels)
            .enumerate()
        {
            if undecided[i] {
                continue;
            }
            if class_of(a) != class_of(b) || a.back_face != b.back_face {
                faults.push(format!(
                    "{label}: {} by hardware {}",
                    compute.describe(i),
                    hardware.describe(i)
                ));
            }
            if a.depth.is_finite() && (a.depth - b.depth).abs() > depth_bound(&question, a) {
                faults.push(format!("{label}: pixel {i} at {} and {}", a.depth, b.depth));
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{} faults\n{}",
        faults.len(),
        faults[..faults.len().min(20)].join("\n")
    );
    assert!(
        compared > 20_000,
        "only {compared} words of the masks say anything"
    );
    // Behind what is seen nothing is undecided; vertices that are moved as little fall alike there too.
    assert!(
        open_bits == 0 || coarseness() > 1.0,
        "{open_bits} of {compared} words of masks differ"
    );
}

#[test]
fn fifty_frames_are_the_same_to_the_bit() {
    let scene = scene_of("crank?throws=2&detail=16", CUTS[2].1);
    let question = Question::through(&scene, &Camera::default(), SIZE);
    let (first, mask) = answer(&question, COMPUTE);
    for repeat in 1..50 {
        let (again, its_mask) = answer(&question, COMPUTE);
        assert!(its_mask == mask, "masks of frame {repeat}");
        assert!(again.layers == first.layers, "layers of frame {repeat}");
    }
}

/// What two frames of a scene by the compute rasteriser do not share, of which one asks a lone plane, and lists crossings where triangles
/// are, and the other has lists of all.
fn not_shared(scene: &Scene, camera: &Camera, lists: [&str; 2]) -> usize {
    let question = Question::through(scene, camera, SIZE);
    let [asked, listed] = lists.map(|name| {
        let method: Method = name.parse().expect("a method");
        let judged = question.answer(method);
        assert_eq!(judged.fault_of_exact(), None, "{} by {name}", scene.name);
        judged.layers.pixels
    });
    let differ = |(a, b): &(&Layer, &Layer)| {
        let close = a.depth.total_cmp(&b.depth).is_eq()
            || (a.depth - b.depth).abs() <= 4.0 * f64::from(f32::EPSILON) * a.depth.abs();
        class_of(a) != class_of(b) || !close
    };
    asked.iter().zip(&listed).filter(differ).count()
}

#[test]
fn what_lists_leave_out_is_seen_nowhere() {
    let names = ["raycast+mask@compute", "raycast+mask@compute,list"];
    // Oblique, and in the plane of faces.
    for text in ["-1,-2,-1.5@50%,45%,60%", "z=50%", "-z=0%", "y=25%"] {
        for shape in SHAPES {
            let mut scene = scene_of(shape, |_| {});
            scene.cuts = vec![Cut::new("cut", vec![section(&scene, text)])];
            for orthographic in [false, true] {
                let camera = scenes::orbit(30.0, 25.0, orthographic);
                let count = not_shared(&scene, &camera, names);
                assert_eq!(count, 0, "{shape} cut by {text}");
            }
        }
    }
    // Lists that hold but what is near triangles show the same.
    for (label, scene, camera) in scenes_and_cameras() {
        let count = not_shared(&scene, &camera, names);
        assert_eq!(count, 0, "{label}");
    }
    // The control: from a degree beside it is another picture.
    let scene = scene_of("crank?throws=2&detail=16", CUTS[0].1);
    let pixels = |azimuth_deg: f64, name: &str| {
        let camera = scenes::orbit(azimuth_deg, 25.0, false);
        let method: Method = name.parse().expect("a method");
        let question = Question::through(&scene, &camera, SIZE);
        question.answer(method).layers.pixels
    };
    assert!(pixels(30.0, names[0]) != pixels(31.0, names[1]));
}
