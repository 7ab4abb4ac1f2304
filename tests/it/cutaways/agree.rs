//! Strategies that are exact are so on cutouts and breakaways, with the eye before the opening and within it.

use super::*;
use cutaway::strategies::{Means, Method, Rasteriser, Strategy};

fn methods() -> Vec<Method> {
    let exact = ["raycast+mask", "raycast+abuffer", "raycast+stencil"].map(common::strategy);
    let by_compute = Method::new(Strategy::RAYCAST_MASK, Means::by(Rasteriser::Compute));
    exact
        .into_iter()
        .map(Method::from)
        .chain([by_compute])
        .collect()
}

fn must_agree(scene: &Scene) {
    let (open, question) = opened(scene, [240, 180]);
    let caps = question.exact.layers.count(Kind::Cap);
    assert!(caps > 100, "{}: {caps} pixels of caps", open.name);
    for method in methods() {
        let fault = question.answer(method).fault_of_exact();
        assert_eq!(fault, None, "{} by {method}", open.name);
    }
}

#[test]
fn breakaways_are_cut_exactly() {
    for mut scene in boxes_with_something_inside() {
        let bounds = scene.bounds();
        let far = cameras_around(&bounds, 3, 4.0);
        for camera in far.chain(cameras_around(&bounds, 3, 1.05)) {
            scene.camera = camera;
            must_agree(&scene);
        }
    }
}

#[test]
fn cutouts_are_cut_exactly() {
    let folder = command::Scratch::new("cutouts");
    for (shape, keys) in [
        ("crank", ""),
        ("torus", "angle_deg = 200"),
        (
            "gears",
            "relief = \"saw\", amplitude = \"4%\", period = \"12%\"",
        ),
    ] {
        let text = format!(
            "part = [{{ shape = \"{shape}\" }}]\nrelief.saw = {{ kind = \"sawtooth\" }}\ncut = [{{ cutout = {{ {keys} }} }}]"
        );
        must_agree(&folder.scene(&text));
    }
}
