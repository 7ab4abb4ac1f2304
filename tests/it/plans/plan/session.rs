//! The one part of this file that draws: a session runs the clocks that a plan changed on, no others, and what it then shows
//! is what a fresh session shows.

use cutaway::gpu::ClockSet;
use cutaway::layers::{Kind, Layers};
use cutaway::scene::{Camera, Mesh, Viewpoint};
use cutaway::session::{Outcome, Session};

use super::*;
use crate::common::gpu;

/// Draws a scene; the clocks that ran, and what is seen.
fn draw(session: &mut Session, scene: &Scene, strategy: &Strategy) -> (ClockSet, Layers) {
    let model = Model::new(scene);
    let view = model.prepared.view([48, 40]);
    let drawn = session
        .draw(&model, &view, strategy)
        .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(drawn.outcome, Outcome::Complete, "{strategy}");
    let layers = session.layers(strategy).unwrap_or_else(|e| panic!("{e}"));
    assert!(
        layers.count(Kind::Cap) > 20,
        "{strategy}: no cap to speak of"
    );
    if session.gpu().has_timestamps() {
        for pass in &drawn.times.passes {
            assert!(drawn.clocks.contains(pass.clock), "{} ran", pass.name);
        }
    }
    (drawn.clocks, layers)
}

/// From the side that is removed, where the caps show.
fn seen_from_behind(mut scene: Scene, azimuth_deg: f64) -> Scene {
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg: 25.0,
        },
        ..scene.camera
    };
    scene
}

fn clocks(of: &[Clock]) -> ClockSet {
    of.iter().fold(ClockSet::NONE, |set, c| set.with(*c))
}

#[test]
fn only_the_clocks_of_what_changed_run() {
    let scene = seen_from_behind(
        scene_of(&["cube?divisions=2"], vec![reliefs(0.1, 1)]),
        210.0,
    );
    let turned = seen_from_behind(scene.clone(), 195.0);
    let mut moved = turned.clone();
    moved.cuts[0].surfaces[0].origin.z -= 0.2;
    let mut dented = moved.clone();
    let mut mesh = Mesh::clone(&dented.parts[0].mesh);
    for p in &mut mesh.positions {
        // The middles of the faces go halfway to the centre: the bounds stay.
        if p.abs().max_element() == p.abs().element_sum() {
            *p *= 0.5;
        }
    }
    dented.parts[0].mesh = Arc::new(mesh);

    for strategy in [Strategy::RAYCAST_MASK, strategy("grid:16+vds:64")] {
        let mut session = Session::new(gpu());
        let (first, mut before) = draw(&mut session, &scene, &strategy);
        assert_eq!(first, ClockSet::ALL, "{strategy}: the first frame");
        for (what, scene, expected) in [
            ("nothing", &scene, clocks(&[Clock::Frame])),
            ("the view", &turned, clocks(&[Clock::Frame])),
            ("the cut", &moved, clocks(&[Clock::Cut, Clock::Frame])),
            ("the mesh", &dented, clocks(&[Clock::Solid, Clock::Frame])),
        ] {
            let (ran, layers) = draw(&mut session, scene, &strategy);
            assert_eq!(ran, expected, "{strategy}: {what} changed");
            let (_, fresh) = draw(&mut Session::new(gpu()), scene, &strategy);
            assert_eq!(layers, fresh, "{strategy}: {what} changed");
            // The control: a stale frame would show.
            assert_eq!(layers == before, what == "nothing", "{strategy}: {what}");
            before = layers;
        }
        let again = session
            .repeat(strategy, ClockSet::FRAME)
            .unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(again.clock_ms(Clock::Solid), 0.0, "{strategy}: solid");
        let repeated = session.layers(strategy).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(repeated, before, "{strategy}: the frame once more");
    }
}

#[test]
fn strategies_keep_their_own_programs() {
    let scene = seen_from_behind(scene_of(&["cube"], vec![planes(0.1, 1)]), 210.0);
    let mut session = Session::new(gpu());
    let both = [Strategy::RAYCAST_MASK, strategy("grid:16+vds:64")];
    for strategy in &both {
        draw(&mut session, &scene, strategy);
    }
    // In turns, neither is rebuilt.
    for strategy in both.iter().chain(&both) {
        let (ran, _) = draw(&mut session, &scene, strategy);
        assert_eq!(ran, ClockSet::FRAME, "{strategy}");
    }
}
