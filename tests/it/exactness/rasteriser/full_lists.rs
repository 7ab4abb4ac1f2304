//! Comparison of the layers of frames that list few crossings, or none, with those of full lists, in one frame after another.

use cutaway::passes::Model;
use cutaway::plan::Capacities;
use cutaway::scene::{Camera, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{self, Method};
use glam::DVec3;

use crate::common::{gpu, scenes};

const SIZE_PX: [u32; 2] = [96, 72];

fn cameras() -> [Camera; 5] {
    [
        scenes::looking(DVec3::new(1.5, -2.0, 3.0), DVec3::ZERO, 40.0),
        scenes::looking(DVec3::new(-4.0, 3.0, -6.0), DVec3::new(0.8, 0.3, 0.0), 40.0),
        // Along a plane through the middle, and from within.
        scenes::looking(DVec3::new(5.0, 0.3, 0.1), DVec3::ZERO, 30.0),
        scenes::looking(DVec3::new(0.2, 0.1, 0.05), DVec3::X, 70.0),
        scenes::parallel(DVec3::new(2.0, 3.0, 4.0), DVec3::ZERO, 3.0),
    ]
}

fn method(options: &str) -> Method {
    let name = format!("raycast+mask@compute{options}");
    name.parse().unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The names of the passes of a frame; `options` follow the name of the method.
pub(super) fn passes(scene: &Scene, options: &str) -> Vec<String> {
    let model = Model::new(scene);
    let view = model.prepared.view(SIZE_PX);
    let plan = strategies::plan(&model, &view, method(options), &Capacities::UNKNOWN);
    let plan = plan.unwrap_or_else(|e| panic!("{e}"));
    plan.passes.iter().map(|p| p.name.clone()).collect()
}

/// Compares the layers word by word in five views. `lists_less` recognises the passes of a frame without full lists.
pub(super) fn layers_are_those_of_full_lists(
    scenes: &[Scene],
    ways: &[&str],
    lists_less: impl Fn(&[String]) -> bool,
) {
    let mut differ = 0;
    for (number, scene) in scenes.iter().enumerate() {
        let model = Model::new(scene);
        for options in ways {
            assert!(lists_less(&passes(scene, options)), "{number}");
            let full = format!("{options},list");
            assert!(!lists_less(&passes(scene, &full)), "the control");
            // One session each: what a frame leaves must not reach the next.
            let mut sessions = [Session::new(gpu()), Session::new(gpu())];
            let mut before = Vec::new();
            for (turn, camera) in cameras().iter().enumerate() {
                let view = model.prepared.view_of(camera, SIZE_PX);
                let layers = |session: &mut Session, options: &str| {
                    let drawn = session.draw(&model, &view, method(options));
                    let drawn = drawn.unwrap_or_else(|e| panic!("{number}{options}: {e}"));
                    assert_eq!(drawn.outcome, Outcome::Complete, "{number}{options}");
                    let words = session.words(method(options), "layers");
                    words.unwrap_or_else(|e| panic!("{number}{options}: {e}"))
                };
                let [less, lists] = &mut sessions;
                let found = layers(less, options);
                let expected = layers(lists, &full);
                assert!(found == expected, "scene {number}{options}, view {turn}");
                differ += usize::from(found != before);
                before = found;
            }
        }
    }
    assert_eq!(
        differ,
        scenes.len() * ways.len() * cameras().len(),
        "the control: views differ"
    );
}
