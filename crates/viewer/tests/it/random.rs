//! Random actions: none panics, a document written and read again is equal, every step can be undone and redone, and the copied command and
//! link draw the same picture as the window.
//!
//! A run depends on its seed alone. A failure reports the seed and the last actions.

use std::collections::VecDeque;
use std::fmt::Write;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use cutaway::{Gpu, GpuOptions, Session};
use cutaway_io::Document;
use cutaway_io::document::Value;
use cutaway_io::load::Assets;
use cutaway_lab::experiment::Renderer;
use cutaway_viewer::action::Selection;
use cutaway_viewer::camera::CameraMove;
use cutaway_viewer::cuts::{NewCut, PlaneMove};
use cutaway_viewer::regions::RegionMove;
use cutaway_viewer::slot::{SlotLayout, SlotSide};
use cutaway_viewer::{Action, State, link};
use glam::{DVec2, DVec3};
use image::RgbaImage;

use super::command::run;
use super::common::Scratch;

/// Two small solids, one of them moved, and a cut.
const SCENE: &str = "# Mine.\n[[part]]\nname = \"ring\"\nshape = \"torus?segments=8&sides=5\"\n\n[[part]]\nname = \"box\"\nshape = \"cube\"\ntranslate = [0.5, 0, 0] # aside\n\n[[cut]]\nname = \"front\"\nsurfaces = [{ section = \"z=50%\" }]\n";

/// Maximum number of parts; files are not added beyond it.
const MOST_PARTS: usize = 4;

/// Width and height of the pictures, in pixels.
const SIZE_PX: [u32; 2] = [80, 60];

/// Pseudo-random numbers (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn pick<T: Clone>(&mut self, among: &[T]) -> T {
        among[self.below(among.len())].clone()
    }

    fn flag(&mut self) -> bool {
        self.below(2) == 0
    }

    /// A number from -1 to 1.
    fn share(&mut self) -> f64 {
        (self.next() % 20_001) as f64 / 10_000.0 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.share(), self.share(), self.share())
    }
}

/// Document paths, with valid values.
const VALUES: &[(&str, &[&str])] = &[
    ("cut.0.enabled", &["true", "false"]),
    ("cut.1.enabled", &["true", "false"]),
    ("cut.0.name", &["\"main\"", "\"second\""]),
    ("cut.0.except", &["[\"ring\"]", "[\"box\"]", "[]"]),
    (
        "cut.0.surfaces.0.section",
        &["\"x=30%\"", "\"-y=60%\"", "\"z=0.1\""],
    ),
    ("cut.0.surfaces.0.flip", &["true", "false"]),
    ("cut.0.surfaces.0.amplitude", &["\"3%\"", "0.05"]),
    ("part.0.translate", &["[0.1, 0, 0]", "[0, -0.2, 0.3]"]),
    ("part.1.rotate_deg", &["[0, 30, 0]", "[45, 0, 10]"]),
    ("part.1.scale", &["0.5", "1.25"]),
    ("part.0.material.color", &["\"#c02020\"", "\"#2040c0\""]),
    (
        "part.1.material.hatch",
        &["\"steel\"", "\"wood\"", "\"none\""],
    ),
    (
        "style",
        &[
            "\"blueprint\"",
            "\"technical\"",
            "\"engraving\"",
            "\"clay\"",
        ],
    ),
    ("style.hatch.angle_deg", &["30", "75.5"]),
    ("style.hatch.width", &["0.2", "0.4"]),
    ("style.strokes.outline", &["0", "2.5"]),
    ("style.occlusion.strength", &["0", "0.5"]),
    ("camera.zoom", &["0.8", "1.5"]),
    ("camera.azimuth_deg", &["12.25", "-100"]),
    ("camera.view", &["\"front\"", "\"iso\""]),
    ("interference", &["\"#ff0000\""]),
];

/// Invalid paths, and paths to values that are not numbers.
const NONSENSE: &[&str] = &[
    "",
    ".",
    "..",
    "cut",
    "part",
    "cut.9.enabled",
    "cut.-1",
    "part.0.mesh",
    "part.0.nothing",
    "key.0.times_s",
    "style.no.such",
    "camera",
    "a b.c\"d",
    "cut.0.surfaces.99999999999999999999",
    "relief.x.kind",
    "part.0.shape.deeper",
    "time_s",
];

const NUMBERS: &[f64] = &[
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.37,
    50.0,
    1e-9,
    1e9,
    -1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Which actions are generated: only those that a window can send, or others as well.
#[derive(Clone, Copy, PartialEq)]
enum Kinds {
    Usual,
    All,
}

fn number(random: &mut Random, kinds: Kinds, most: f64) -> f64 {
    match kinds == Kinds::All && random.below(4) == 0 {
        true => random.pick(NUMBERS),
        false => random.share() * most,
    }
}

fn value(random: &mut Random, kinds: Kinds) -> (String, Value) {
    let (path, values) = random.pick(VALUES);
    let usual = (path.to_owned(), Value::read(random.pick(values)));
    if kinds == Kinds::Usual {
        return usual;
    }
    match random.below(6) {
        0 => (random.pick(NONSENSE).to_owned(), usual.1),
        1 => (usual.0, random.pick(NUMBERS).into()),
        2 => {
            let odd = [
                "\"\"",
                "[]",
                "{}",
                "[[1]]",
                "2020-01-01",
                "\"a\\nb\"",
                "{ a = 1 }",
            ];
            (usual.0, Value::read(random.pick(&odd)))
        }
        _ => usual,
    }
}

fn action(random: &mut Random, kinds: Kinds) -> Action {
    let new = |random: &mut Random| {
        let axis = random.below(3);
        random.pick(&[
            NewCut::Plane(axis),
            NewCut::Relief(axis),
            NewCut::Box,
            NewCut::Wedge,
            NewCut::Cutout,
            NewCut::Breakaway,
        ])
    };
    let index = random.below(3);
    match random.below(34) {
        0..=2 => Action::Add(new(random)),
        3 => Action::Duplicate(index),
        4 => Action::Remove(index),
        5..=7 => Action::Select(match random.below(4) {
            0 => Selection::Scene,
            1 => Selection::Part(index),
            _ => Selection::Cut(index),
        }),
        8..=11 => {
            let [by, share] = [number(random, kinds, 1.0), number(random, kinds, 0.3)];
            let (point, normal) = (random.vector() * 0.5, random.vector());
            Action::MovePlane(match random.below(8) {
                0 => PlaneMove::Along(by),
                1 => PlaneMove::To(by),
                2 => PlaneMove::Step(share),
                3 => PlaneMove::Across(index),
                4 => PlaneMove::Flip,
                5 => PlaneMove::Turn(normal),
                6 => PlaneMove::Through(point, normal),
                _ => PlaneMove::Tilt(point, normal),
            })
        }
        12..=13 => Action::MoveRegion(match random.flag() {
            true => RegionMove::Face {
                region: random.below(2),
                axis: index,
                is_greatest: random.flag(),
                to: number(random, kinds, 1.0),
            },
            false => RegionMove::Angle {
                region: random.below(2),
                is_end: random.flag(),
                to_deg: number(random, kinds, 200.0),
            },
        }),
        14 => {
            let normal = match kinds == Kinds::All && random.below(4) == 0 {
                true => DVec3::ZERO,
                false => random.vector(),
            };
            Action::CutThrough(random.vector() * 0.5, normal)
        }
        15 => Action::FaceEye,
        16..=18 => {
            let degrees = |random: &mut Random| number(random, kinds, 90.0);
            Action::MoveCamera(match random.below(6) {
                0 | 1 => CameraMove::Orbit(DVec2::new(degrees(random), degrees(random))),
                2 => CameraMove::Pan(DVec2::new(random.share(), number(random, kinds, 0.2))),
                3 => CameraMove::Zoom {
                    factor: number(random, kinds, 0.5) + 1.0,
                    about: DVec2::new(random.share(), random.share()) * 0.5,
                },
                4 => CameraMove::Stand([degrees(random), degrees(random)]),
                _ => random.pick(&[
                    CameraMove::Home,
                    CameraMove::Parallel(true),
                    CameraMove::Parallel(false),
                ]),
            })
        }
        19..=22 => {
            let (path, value) = value(random, kinds);
            Action::Set { path, value }
        }
        23 => {
            let changes = (0..=index).map(|_| {
                let (path, value) = value(random, kinds);
                (path, random.flag().then_some(value))
            });
            Action::Change(changes.collect())
        }
        24 => Action::TakeBack(
            random
                .pick(&[
                    "style.hatch.angle_deg",
                    "style.hatch",
                    "style.strokes.outline",
                ])
                .to_owned(),
        ),
        25 => Action::ShowPart(index, random.flag()),
        26 => Action::AddKey,
        27 => match random.flag() {
            true => Action::Animate,
            false => Action::RemoveKey([index, random.below(2)]),
        },
        28 => Action::MoveKey([random.below(2), index], number(random, kinds, 3.0)),
        29 => Action::Seek(number(random, kinds, 1.0).abs()),
        30 => random.pick(&[Action::Undo, Action::Undo, Action::Redo]),
        31 => random.pick(&[Action::Release, Action::Undo]),
        32 => match random.below(7) {
            0 => Action::Swap,
            1 => Action::Arrange(random.pick(&SlotLayout::ALL)),
            2 => Action::Wipe(number(random, kinds, 2.0) as f32),
            3 => Action::ShowErrors(random.flag()),
            4 => Action::ShowOpenEdges(random.flag()),
            _ => {
                let painter = ["auto", "raycast+mask@compute", "grid:256+vds:1024"];
                Action::Choose(
                    random.pick(&SlotSide::BOTH),
                    random.pick(&painter).parse().unwrap(),
                )
            }
        },
        _ => match kinds {
            Kinds::Usual => Action::Reload,
            Kinds::All => random.pick(&[
                Action::Reload,
                Action::Take(vec!["shape:cube".into()]),
                Action::Take(vec!["gone.obj".into(), "shape:cube".into()]),
                Action::Take(vec!["no.xyz".into()]),
                Action::Take(Vec::new()),
            ]),
        },
    }
}

/// Runs a function that applies actions; a failure reports the seed and the last actions.
fn run_of(seed: u64, run: impl FnOnce(&mut Random, &mut VecDeque<Action>)) {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let mut last = VecDeque::new();
    let done = catch_unwind(AssertUnwindSafe(|| run(&mut random, &mut last)));
    if let Err(panic) = done {
        let mut told = String::new();
        for action in &last {
            writeln!(told, "  {action:?}").unwrap();
        }
        eprintln!("seed {seed}, after\n{told}");
        resume_unwind(panic);
    }
}

fn keep(last: &mut VecDeque<Action>, action: &Action) {
    last.push_back(action.clone());
    if last.len() > 12 {
        last.pop_front();
    }
}

/// A document without its eye, which undo does not change.
fn without_eye(document: &Document) -> Document {
    let mut document = document.clone();
    document.remove("camera").unwrap();
    document
}

fn open(text: &str) -> State {
    State::open(Document::parse("", text).unwrap(), Assets::default()).unwrap()
}

/// Repeats an undo or redo until none is left.
fn to_the_end(state: &mut State, step: &Action, reach: usize) {
    let mut steps = 0;
    while state.can_undo_redo()[reach] {
        state.apply(step.clone());
        steps += 1;
        assert!(steps <= 200, "{step:?} leads nowhere");
        let refused: Vec<_> = state
            .notices()
            .into_iter()
            .filter(|n| n.is_error())
            .collect();
        assert!(refused.is_empty(), "{step:?}: {refused:?}");
    }
}

#[test]
fn documents_stay_files_and_steps_are_taken_back_and_done_again() {
    for seed in 1..=10 {
        run_of(seed, |random, last| {
            let mut state = open(SCENE);
            let first = without_eye(state.document());
            for count in 0..100 {
                let action = action(random, Kinds::All);
                let parts = state
                    .document()
                    .root()
                    .get("part")
                    .map_or(0, |p| p.items().len());
                if matches!(action, Action::Take(_)) && parts >= MOST_PARTS {
                    continue;
                }
                keep(last, &action);
                state.apply(action);
                let text = state.document().to_string();
                let again = Document::parse("", &text);
                let again = again.unwrap_or_else(|e| panic!("{e}\n{text}"));
                assert_eq!(again, *state.document(), "{text}");
                if count % 20 == 19 {
                    let opened = State::open(again, Assets::default());
                    assert!(opened.is_ok(), "{}\n{text}", opened.unwrap_err());
                    assert!(state.command(SIZE_PX).is_ok(), "{text}");
                }
            }
            state.apply(Action::Release);
            state.notices();
            to_the_end(&mut state, &Action::Redo, 1);
            let end = without_eye(state.document());
            to_the_end(&mut state, &Action::Undo, 0);
            assert_eq!(without_eye(state.document()), first, "{}", state.document());
            to_the_end(&mut state, &Action::Redo, 1);
            assert_eq!(without_eye(state.document()), end, "{}", state.document());
        });
    }
}

/// The picture of a window's first slot at rest.
fn drawn(session: &mut Session, state: &mut State) -> RgbaImage {
    state.classify();
    let shown = state.shown().unwrap();
    let view = shown.view(SIZE_PX);
    let painter = state.painter(SlotSide::A);
    let Renderer::Method(method) = painter.classify(session.gpu(), &shown.at.model, &view) else {
        panic!("{painter} is no method");
    };
    let drawn = session.draw(&shown.at.model, &view, method).unwrap();
    drop(drawn);
    let pixels = session.picture(method).unwrap();
    RgbaImage::from_raw(SIZE_PX[0], SIZE_PX[1], pixels).unwrap()
}

fn apart(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions(), "pictures of one view");
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

#[test]
fn command_and_link_draw_what_is_seen() {
    let gpu = Gpu::open(&GpuOptions::default()).unwrap();
    let mut session = Session::new(gpu);
    let empty = drawn(&mut session, &mut open(SCENE));
    let mut changed = 0;
    for seed in 1..=8 {
        run_of(seed, |random, last| {
            let mut state = super::common::state("shape:torus?segments=16&sides=8");
            state.apply(Action::Add(NewCut::Plane(0)));
            let mut count = 0;
            while count < 8 {
                let action = action(random, Kinds::Usual);
                keep(last, &action);
                state.apply(action);
                count += usize::from(state.notices().iter().all(|n| !n.is_error()));
            }
            let seen = drawn(&mut session, &mut state);
            changed += usize::from(apart(&seen, &empty) > 0);
            let command = state.command(SIZE_PX).unwrap();
            let made = run(&format!("{command} --supersample 1"), &Scratch::new());
            assert_eq!(apart(&made, &seen), 0, "{command}");
            let fragment = link::fragment(&state.as_seen().unwrap()).unwrap();
            let document = link::document(&fragment).unwrap().unwrap();
            let mut opened = State::open(document, Assets::default()).unwrap();
            let linked = drawn(&mut session, &mut opened);
            assert_eq!(apart(&linked, &seen), 0, "{}", opened.document());
        });
    }
    assert!(
        changed > 4,
        "{changed} pictures show something else than the first"
    );
}
