//! Cases 7 and 40: what many triangles and many frames ask beyond their outcome.

use std::sync::Arc;

use cutaway::Model;
use cutaway::layers::Layers;
use cutaway::scene::{Camera, Scene, Viewpoint};
use cutaway::strategies::{Means, Method, Rasteriser, Strategy};
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
    /// Flips of exact that a picture which does not change would miss.
    lagging: usize,
}

fn drifting(scene: &Scene, method: &Method) -> Flicker {
    let model = Model::new(scene);
    let truth = model.truth(scene);
    let whole = model.prepared.view([SIDE_PX; 2]);
    let mut flicker = Flicker::default();
    let mut before: Option<(Layers, Arc<Exact>)> = None;
    for frame in 0..FRAMES {
        let drift = DVec2::new(f64::from(frame) / 64.0, 0.0);
        let view = whole.sampled_at(DVec2::splat(0.5) + drift);
        let question = Question {
            model: model.clone(),
            view,
            exact: Arc::new(Truth::new(truth.clone().into_owned(), view)),
        };
        let judged = question.answer(&mut session(), method).expect("a frame");
        let exact = judged.exact.clone();
        assert_eq!(judged.outcome.reason(), None, "{method}: frame {frame}");
        if let Some((layers_before, exact_before)) = &before {
            for p in 0..exact.undecided.len() {
                if exact.undecided[p] || exact_before.undecided[p] {
                    continue;
                }
                let flips =
                    |a: &Layers, b: &Layers| class_of(&a.pixels[p]) != class_of(&b.pixels[p]);
                let of_exact = flips(&exact_before.layers, &exact.layers);
                flicker.flips += usize::from(of_exact);
                flicker.excess += usize::from(flips(layers_before, &judged.layers) != of_exact);
                flicker.lagging += usize::from(of_exact);
            }
        }
        before = Some((judged.layers, exact));
    }
    flicker
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
    let method = |name: &str| name.parse::<Method>().expect(name);
    for name in ["raycast+mask", "raycast+mask@compute"] {
        let flicker = drifting(&scene, &method(name));
        // A step of the camera is less than a step of few sub-pixel bits: exact is not sure of what changes.
        let is_seen = flicker.flips > 300 || !tolerances::holds_lower_bounds();
        assert!(is_seen, "only {} pixels changed", flicker.flips);
        assert_eq!(flicker.excess, 0, "{name}");
    }
    if !tolerances::holds_lower_bounds() {
        return;
    }
    // The control: what is off by a texel flips where exact does not.
    let coarse = drifting(&scene, &method("grid:32+vds:64"));
    println!(
        "a coarse sprite flips {} pixels in excess of {}",
        coarse.excess, coarse.flips
    );
    assert!(coarse.excess > 50, "a coarse sprite is not noticed");
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
        let method = Method::new(strategy, Means::by(rasteriser));
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
