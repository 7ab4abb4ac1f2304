//! Inside tests that keep fragments: lists and slots end in the very words of the mask, images of volumes agree with each other,
//! and what does not fit is told and marked.

use crate::common;

mod images;
mod masks;
mod overflow;
mod plans;
mod scan;

use cutaway::layers::Layers;
use cutaway::plan::{Capacities, Plan};
use cutaway::scene::{Cut, Part, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{self, DrawOptions, Method, Rasteriser, Strategy};
use glam::{DAffine3, DVec3};

use common::{Question, meshes, scenes};

const SIZE: [u32; 2] = [96, 72];

/// A ring under an oblique plane: one part, one crossing.
fn ring() -> Scene {
    scenes::sectioned("torus?segments=40&sides=20", &["-0.3,-1,-0.2@50%,50%,50%"])
}

/// Six blocks one behind the other under a relief: lanes of 8 bits, in two words.
fn row() -> Scene {
    let parts = (0..6).map(|i| {
        let mut part = Part::new(format!("block {i}"), meshes::shape("sphere?subdivisions=2"));
        part.world_from_part = DAffine3::from_translation(DVec3::X * 0.7 * f64::from(i));
        part
    });
    let mut scene = scenes::of_parts("row", parts.collect(), Vec::new());
    let rough = scenes::relief(&scene, "-z=55%", "waves:size=16,amplitude=8%");
    scene.cuts = vec![Cut::new("cut", vec![rough])];
    scene.camera = scenes::orbit(80.0, 25.0, false);
    scene
}

/// A strategy by a rasteriser; by the hardware's it is named by the strategy alone.
fn method(strategy: &Strategy, rasteriser: Rasteriser) -> Method {
    match rasteriser {
        Rasteriser::Hardware => Method::from(strategy),
        // With all crossings in the lists, so that masks are the same word by word.
        Rasteriser::Compute => {
            let list = Some(true);
            let options = DrawOptions::by(rasteriser);
            Method::new(*strategy, DrawOptions { list, ..options })
        }
    }
}

/// Draws a question, and looks at the frame.
fn drawn<T>(
    question: &Question,
    strategy: &Strategy,
    rasteriser: Rasteriser,
    look: impl FnOnce(&Session, &Outcome) -> T,
) -> T {
    let mut session = common::session();
    let method = method(strategy, rasteriser);
    let drawn = session
        .draw(&question.model, &question.view, method)
        .unwrap_or_else(|e| panic!("{strategy}: {e}"));
    look(&session, &drawn.outcome)
}

fn layers(question: &Question, strategy: &Strategy, rasteriser: Rasteriser) -> Layers {
    drawn(question, strategy, rasteriser, |session, outcome| {
        assert_eq!(*outcome, Outcome::Complete, "{strategy} by {rasteriser}");
        session
            .layers(method(strategy, rasteriser))
            .unwrap_or_else(|e| panic!("{e}"))
    })
}

fn words(session: &Session, method: impl Into<Method>, buffer: &str) -> Vec<u32> {
    let words = session.words(method, buffer);
    words.unwrap_or_else(|e| panic!("{buffer}: {e}"))
}

fn plan_with(question: &Question, strategy: &Strategy, capacities: &Capacities) -> Plan {
    strategies::plan(&question.model, &question.view, strategy, capacities)
        .unwrap_or_else(|e| panic!("{e}"))
}
