//! Comparison of the layers of frames that list few crossings, or none, with those of full lists, in one frame after another.

use cutaway::passes::Model;
use cutaway::plan::Capacities;
use cutaway::scene::{Camera, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::{self, Method};
use glam::DVec3;

use crate::common::{gpu, scenes};

const SIZE_PX: [u32; 2] = [96, 72];

/// First word of the layer of a pixel that shows nothing.
const BACKGROUND: u32 = 0;

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

/// Compares the layers of each scene word by word in five views, in one of the ways in turn. `lists_less` recognises the passes of a frame
/// without full lists.
pub(super) fn layers_are_those_of_full_lists(
    scenes: &[Scene],
    ways: &[&str],
    lists_less: impl Fn(&[String]) -> bool,
) {
    let mut differ = 0;
    for (scene, options) in scenes.iter().zip(ways.iter().cycle()) {
        assert!(lists_less(&passes(scene, options)), "{}", scene.name);
        let full = format!("{options},list");
        assert!(!lists_less(&passes(scene, &full)), "the control");
        differ += compare(scene, options, &cameras(), SIZE_PX);
    }
    assert_eq!(
        differ,
        scenes.len() * cameras().len(),
        "the control: views differ"
    );
}

/// Compares the layers of a scene in some views, one after the other; returns the number of views that differ from the one before.
pub(super) fn compare(
    scene: &Scene,
    options: &str,
    cameras: &[Camera],
    size_px: [u32; 2],
) -> usize {
    let model = Model::new(scene);
    // One session each: what a frame leaves must not reach the next.
    let [mut less, mut full] = [Session::new(gpu()), Session::new(gpu())];
    let mut before = Vec::new();
    let mut differ = 0;
    for (turn, camera) in cameras.iter().enumerate() {
        let view = model.prepared.view_of(camera, size_px);
        let layers = |session: &mut Session, options: &str| {
            let drawn = session.draw(&model, &view, method(options));
            let drawn = drawn.unwrap_or_else(|e| panic!("{}{options}: {e}", scene.name));
            assert_eq!(drawn.outcome, Outcome::Complete, "{}{options}", scene.name);
            let words = session.words(method(options), "layers");
            words.unwrap_or_else(|e| panic!("{}{options}: {e}", scene.name))
        };
        let found = layers(&mut less, options);
        let expected = layers(&mut full, &format!("{options},list"));
        let [here, there] = [&found, &expected].map(|words| words.as_chunks::<3>().0);
        // The depth of a pixel that shows nothing has no meaning, and depends on whether its tile was touched.
        let is_background = |pixel: &[u32; 3]| pixel[0] == BACKGROUND;
        let wrong = (here.iter().zip(there).enumerate())
            .find(|(_, (a, b))| a != b && !(is_background(a) && is_background(b)));
        assert_eq!(wrong, None, "{}{options}, view {turn}", scene.name);
        assert_eq!(found.len(), expected.len(), "words");
        differ += usize::from(found != before);
        before = found;
    }
    differ
}
