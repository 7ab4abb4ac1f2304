//! A scene that moves has one fit for all its times, whether its cuts move, its parts, or the vertices of its parts.

use cutaway::scene::{Fit, Prepared, Scene};
use cutaway_io::document::{Document, Timeline};
use cutaway_io::load::Assets;
use cutaway_lab::exact::evaluate;

use super::margins_of;

const SIZE: [u32; 2] = [200, 150];

const DRIFT: &str = "\
[camera]
azimuth_deg = 30
elevation_deg = 20
fit = \"kept\"
[[part]]
name = \"solid\"
shape = \"crank\"
[[cut]]
name = \"front\"
surfaces = [{ origin = [0, 0, 0], normal = [1, 0, 0] }]
[[key]]
target = \"cut.front.surfaces.0.origin\"
times_s = [0, 2]
values = [[0, 0, 0], [0.7, 0, 0]]
";

const TWIST: &str = "\
[camera]
azimuth_deg = 30
elevation_deg = 20
fit = \"kept\"
[[part]]
name = \"solid\"
shape = \"cube?divisions=8\"
deform = [{ kind = \"bend\", turn_deg = 0, across = \"y\" }]
[[cut]]
surfaces = [{ section = \"-y=70%\" }]
[[key]]
target = \"part.solid.deform.0.turn_deg\"
times_s = [0, 2]
values = [0, 120]
";

fn timeline(text: &str) -> Timeline {
    let document = Document::parse("scene.toml", text).expect(text);
    document.timeline(&mut Assets::default()).expect(text)
}

fn seen(scene: &Scene) -> (glam::DVec3, f64, [f64; 4]) {
    let prepared = Prepared::new(scene);
    let view = prepared.view(SIZE);
    let margins = margins_of(&evaluate(&prepared, &view).layers).expect("something is kept");
    (view.eye, view.half_height, margins)
}

#[test]
fn one_fit_serves_all_times() {
    for text in [DRIFT, TWIST] {
        let timeline = timeline(text);
        let times = [0.0, 0.4, 1.0, 1.3, 2.0];
        let shown = times.map(|t| seen(&timeline.at(t).expect("a scene")));
        let mut least = [f64::INFINITY; 4];
        for (eye, half_height, margins) in shown {
            assert_eq!((eye, half_height), (shown[0].0, shown[0].1), "{text}");
            least = std::array::from_fn(|i| least[i].min(margins[i]));
        }
        let wanted = 0.06 * f64::from(SIZE[1]);
        let tight = (least[0] + least[1]).min(least[2] + least[3]) / 2.0;
        assert!((tight - wanted).abs() <= 1.5, "{text}: {least:?}");
        // The control: fitted by itself each time has a camera of its own.
        let eyes = times.map(|t| {
            let mut scene = timeline.at(t).expect("a scene");
            scene.outline = None;
            seen(&scene).0
        });
        assert!(eyes[0] != eyes[4], "{text}: the control");
    }
}

#[test]
fn what_a_document_does_not_say_is_said_by_who_opens_it() {
    let text = DRIFT.replace("fit = \"kept\"\n", "");
    let fit = |timeline: Timeline| {
        let own = timeline.at(1.0).expect("a scene").camera.fit;
        assert_eq!(timeline.rest().camera.fit, own);
        own
    };
    assert_eq!(fit(timeline(&text)), Fit::All);
    assert_eq!(fit(timeline(&text).with_usual_fit(Fit::Kept)), Fit::Kept);
    assert_eq!(fit(timeline(DRIFT).with_usual_fit(Fit::All)), Fit::Kept);
    let all = DRIFT.replace("\"kept\"", "\"all\"");
    assert_eq!(fit(timeline(&all).with_usual_fit(Fit::Kept)), Fit::All);
}
