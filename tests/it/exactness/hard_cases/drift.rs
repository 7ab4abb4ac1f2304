//! Cases 7 and 40: what many triangles and many frames ask beyond their outcome.

use std::sync::Arc;

use cutaway::Model;
use cutaway::layers::Layers;
use cutaway::scene::{Camera, Scene, Viewpoint};
use cutaway::strategies::{DrawOptions, Method, Rasteriser, Strategy};
use cutaway_lab::exact::{Exact, Truth};
use cutaway_lab::hard_cases::{Question, class_of, scenes};
use glam::DVec2;

use crate::common::{coarseness, session, tolerances};

const SIDE_PX: u32 = 40;
const FRAMES: u32 = 256;

/// A flip of a decided pixel from one frame to the next is one of exact: otherwise it is in excess.
#[derive(Default)]
struct Flicker {
    flips: usize,
    excess: usize,
}

/// Of each method over all frames. Truth is worked out once for all of them.
fn drifting<const N: usize>(scene: &Scene, methods: [Method; N]) -> [Flicker; N] {
    let model = Model::new(scene);
    let truth = model.truth(scene);
    let whole = model.prepared.view([SIDE_PX; 2]);
    let mut all = methods.map(|method| (method, Flicker::default(), None));
    for frame in 0..FRAMES {
        let drift = DVec2::new(f64::from(frame) / 64.0, 0.0);
        let view = whole.sampled_at(DVec2::splat(0.5) + drift);
        let question = Question {
            model: model.clone(),
            view,
            exact: Arc::new(Truth::new(truth.clone().into_owned(), view)),
        };
        for (method, flicker, before) in &mut all {
            let judged = question.answer(&mut session(), method).expect("a frame");
            assert_eq!(judged.outcome.reason(), None, "{method}: frame {frame}");
            let now = (judged.layers, judged.exact);
            if let Some(before) = before {
                flicker.add(before, &now);
            }
            *before = Some(now);
        }
    }
    all.map(|(_, flicker, _)| flicker)
}

impl Flicker {
    /// Adds a frame, with its truth, and the one before.
    fn add(&mut self, before: &(Layers, Arc<Exact>), now: &(Layers, Arc<Exact>)) {
        let flips =
            |a: &Layers, b: &Layers, p: usize| class_of(&a.pixels[p]) != class_of(&b.pixels[p]);
        let is_decided = |p: &usize| !before.1.undecided[*p] && !now.1.undecided[*p];
        for p in (0..now.1.undecided.len()).filter(is_decided) {
            let of_exact = flips(&before.1.layers, &now.1.layers, p);
            self.flips += usize::from(of_exact);
            self.excess += usize::from(flips(&before.0, &now.0, p) != of_exact);
        }
    }
}

#[test]
fn case_40_a_drifting_camera_flips_what_exact_flips() {
    let mut scene = scenes::of_parts(
        "comb",
        cutaway_lab::hard_cases::meshes::parts("comb?teeth=8"),
        vec![],
    );
    let rough = scenes::relief(
        &scene,
        "-0.2,-0.3,-1@50%,50%,50%",
        "fractal:size=32,amplitude=6%",
    );
    scene.cuts = vec![cutaway::scene::Cut::new("cut", vec![rough])];
    let names = ["raycast+mask", "raycast+mask@compute", "grid:32+vds:64"];
    let found = drifting(&scene, names.map(|n| n.parse::<Method>().expect(n)));
    let [exact @ .., coarse] = &found;
    for (name, flicker) in names.iter().zip(exact) {
        // A step of the camera is less than a step of few sub-pixel bits: exact is not sure of what changes.
        let is_seen = flicker.flips > 300 || !tolerances::holds_lower_bounds();
        assert!(is_seen, "only {} pixels changed", flicker.flips);
        assert_eq!(flicker.excess, 0, "{name}");
    }
    // The control: what is off by a texel flips where exact does not.
    println!(
        "a coarse sprite flips {} pixels in excess of {}",
        coarse.excess, coarse.flips
    );
    let is_noticed = coarse.excess > 50 || !tolerances::holds_lower_bounds();
    assert!(is_noticed, "a coarse sprite is not noticed");
}

#[test]
fn case_07_a_million_triangles_leave_no_odd_pixel() {
    let mut scene = scenes::sectioned(
        "torus?segments=1000&sides=500",
        &["-0.3,-1,-0.2@50%,50%,50%"],
    );
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: 30.0,
            elevation_deg: 40.0,
        },
        ..Camera::default()
    };
    let model = Model::new(&scene);
    assert_eq!(model.prepared.triangle_count(), 1_000_000);
    let view = model.prepared.view([64; 2]);
    let mut session = session();
    let strategy = Strategy::RAYCAST_MASK;
    let mut drawn = Vec::new();
    for rasteriser in [Rasteriser::Hardware, Rasteriser::Compute] {
        let method = Method::new(strategy, DrawOptions::by(rasteriser));
        let outcome = session
            .draw(&model, &view, method)
            .expect("a frame")
            .outcome;
        assert_eq!(outcome.reason(), None, "{rasteriser}");
        let layers = session.layers(method).expect("layers");
        let odd = layers.pixels.iter().filter(|p| p.unreliable).count();
        assert_eq!(odd, 0, "{rasteriser}: odd pixels");
        drawn.push(layers);
    }
    session.forget();
    let differing = (drawn[0].pixels.iter().zip(&drawn[1].pixels))
        .filter(|(a, b)| class_of(a) != class_of(b))
        .count();
    assert!(
        differing as f64 <= tolerances::MILLION_TRIANGLES_PX * coarseness(),
        "the rasterisers differ in {differing} pixels"
    );
}
