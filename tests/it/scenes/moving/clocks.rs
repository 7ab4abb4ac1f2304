//! Which passes run when something moved.

use cutaway::Model;
use cutaway::gpu::ClockSet;
use cutaway::layers::Layers;
use cutaway::plan::Clock;
use cutaway::scene::{ClipSurface, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;
use glam::DVec3;

use super::actors::{bend, bent_bar, still};
use super::common::meshes::lumpy;
use super::common::{gpu, scenes, strategy};

/// A bar that bends, and a torus; both are cut.
fn scene() -> Scene {
    let plane = ClipSurface::plane(DVec3::Z * 0.02, DVec3::new(0.1, 0.15, -1.0));
    let parts = vec![bent_bar(30.0), still("torus", DVec3::X * 0.9)];
    let mut scene = scenes::of_parts("clocks", parts, vec![plane]);
    scene.camera = scenes::orbit(20.0, 15.0, false);
    scene.stage = Some(cutaway::scene::Bounds {
        min: DVec3::splat(-2.0),
        max: DVec3::splat(2.0),
    });
    scene
}

struct Stage {
    session: Session,
    strategy: Strategy,
}

impl Stage {
    fn new(strategy: Strategy) -> Self {
        let gpu = gpu();
        Self {
            session: Session::new(gpu).timed(),
            strategy,
        }
    }

    /// The passes of the solid clock that ran, and what is seen.
    fn draw(&mut self, model: &Model) -> (Vec<String>, Layers) {
        let view = model.prepared.view([64, 48]);
        let drawn = self.session.draw(model, &view, self.strategy);
        let drawn = drawn.unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(drawn.outcome, Outcome::Complete, "{}", self.strategy);
        let ran = drawn.ran_on(Clock::Solid);
        let layers = self.session.layers(self.strategy).expect("layers");
        (ran.into_iter().map(str::to_owned).collect(), layers)
    }

    /// As [`Stage::draw`], held against a device that has never drawn anything.
    fn draws(&mut self, model: &Model, what: &str) -> Vec<String> {
        let (ran, layers) = self.draw(model);
        let (_, fresh) = Self::new(self.strategy).draw(model);
        assert_eq!(layers, fresh, "{}: {what}", self.strategy);
        ran
    }
}

/// Which of the parts had passes that ran: of the pose pass, of the sprite.
fn of_parts(ran: &[String]) -> [Vec<u32>; 2] {
    ["place ", "sprite "].map(|kind| {
        let numbers = ran.iter().filter(|n| n.starts_with(kind)).map(|n| {
            let number = n.rsplit(' ').next().unwrap_or(n);
            let number = number.split('.').next().unwrap_or(number);
            number.parse::<u32>().expect("the number of a part")
        });
        let mut numbers: Vec<u32> = numbers.collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    })
}

#[test]
fn only_what_moved_is_built_again() {
    for (strategy, sprites) in [
        (Strategy::RAYCAST_MASK, false),
        (strategy("grid:16+vds:64"), true),
    ] {
        let mut stage = Stage::new(strategy);
        let all = |parts: &[u32]| if sprites { parts.to_vec() } else { Vec::new() };
        let mut scene = scene();
        let mut model = Model::new(&scene);
        let ran = stage.draws(&model, "the first frame");
        assert_eq!(of_parts(&ran), [vec![0], all(&[0, 1])], "{strategy}: first");

        let mut step = |what: &str, scene: &Scene, expected: [Vec<u32>; 2]| {
            model = model.updated(scene);
            let ran = stage.draws(&model, what);
            assert_eq!(of_parts(&ran), expected, "{strategy}: {what}: {ran:?}");
        };
        step("nothing changed", &scene, [vec![], vec![]]);
        scene.camera = scenes::orbit(35.0, 20.0, false);
        step("the camera moved", &scene, [vec![], vec![]]);
        scene.cuts[0].surfaces[0].origin.z -= 0.05;
        step("the cut moved", &scene, [vec![], vec![]]);
        bend(&mut scene.parts[0], 50.0);
        step("the bar bent", &scene, [vec![0], all(&[0])]);
        step("and stood still", &scene, [vec![], vec![]]);
        // The first time that it moves it is packed anew, for the pose pass.
        scene.parts[1].world_from_part.translation.y += 0.05;
        step("the torus moved", &scene, [vec![1], all(&[1])]);
        scene.parts[1].world_from_part.translation.y += 0.05;
        step("the torus moved on", &scene, [vec![1], all(&[1])]);
        bend(&mut scene.parts[0], 40.0);
        step("the bar bent again", &scene, [vec![0], all(&[0])]);
        scene.parts[1].mesh = std::sync::Arc::new(lumpy(2, 0.2, 0.0));
        step("another mesh", &scene, [vec![], all(&[1])]);
        scene.parts[1].mesh = std::sync::Arc::new(lumpy(2, 0.2, 1.0));
        step("and another", &scene, [vec![], all(&[1])]);
    }
}

#[test]
fn the_sprite_of_a_moving_mesh_costs_on_the_clock_of_the_solid() {
    let strategy = strategy("grid:16+vds:64");
    let mut stage = Stage::new(strategy);
    let mut scene = scene();
    let mut model = Model::new(&scene);
    for degrees in [30.0, 45.0, 60.0] {
        bend(&mut scene.parts[0], degrees);
        model = model.updated(&scene);
        let view = model.prepared.view([64, 48]);
        let drawn = stage
            .session
            .draw(&model, &view, strategy)
            .expect("a frame");
        assert!(drawn.clocks.contains(Clock::Solid), "{degrees} degrees");
        assert!(
            drawn.times.clock_ms(Clock::Solid) > 0.0,
            "{degrees} degrees"
        );
    }
    // And none where nothing moved.
    let view = model.prepared.view([64, 48]);
    let drawn = stage
        .session
        .draw(&model, &view, strategy)
        .expect("a frame");
    assert_eq!(drawn.clocks, ClockSet::FRAME, "it stood still");
    assert_eq!(drawn.times.clock_ms(Clock::Solid), 0.0, "it stood still");
}

#[test]
fn what_stays_is_shared_and_not_packed_again() {
    let mut scene = scene();
    let first = Model::new(&scene);
    bend(&mut scene.parts[0], 80.0);
    let next = first.updated(&scene);
    let rank = |model: &Model, part| {
        let found = model.prepared.parts.iter().position(|p| p.part == part);
        found.expect("the part")
    };
    let (a, b) = (
        &first.prepared.parts[rank(&first, 1)],
        &next.prepared.parts[rank(&next, 1)],
    );
    assert!(
        std::sync::Arc::ptr_eq(&a.positions, &b.positions),
        "the torus"
    );
    let not_shared =
        next.vertices.not_in(&first.vertices).count() + next.indices.not_in(&first.indices).count();
    assert_eq!(not_shared, 0, "nothing large is uploaded");
    assert!(
        first.is_kin_of(&next),
        "what is known of its sizes holds on"
    );
    // The control: another mesh is.
    scene.parts[1].mesh = std::sync::Arc::new(lumpy(2, 0.2, 0.0));
    let other = next.updated(&scene);
    assert_eq!(other.vertices.not_in(&next.vertices).count(), 1, "one part");
}
