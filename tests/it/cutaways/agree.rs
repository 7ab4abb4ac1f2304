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
    let caps = caps_agreed_on(scene, [240, 180], &methods());
    assert!(caps > 100, "{}: {caps} pixels of caps", scene.name);
}

/// How many pixels of caps there are, on all of which the methods agree with exact.
fn caps_agreed_on(scene: &Scene, size_px: [u32; 2], methods: &[Method]) -> usize {
    let (open, question) = opened(scene, size_px);
    for method in methods {
        let fault = question.answer(*method).fault_of_exact();
        assert_eq!(fault, None, "{} by {method}", open.name);
    }
    question.exact.layers.count(Kind::Cap)
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

#[test]
fn real_meshes_are_opened_exactly() {
    let folder = command::Scratch::new("opened");
    let [mask, .., compute] = &methods()[..] else {
        panic!("several methods");
    };
    let methods = [*mask, *compute];
    let size_px = [160, 120];
    let mut meshes = 0;
    let [mut of_cutouts, mut of_openings] = [0; 2];
    for file in real::files(&["cad", "organic", "assembly"]) {
        let plain = real::cut(&file, None);
        if !real::is_closed(&plain) {
            continue;
        }
        meshes += 1;
        let path = file.display().to_string();
        let text = format!(
            "part = [{{ mesh = {path:?}, material = {{ cap = {{ solid = \"granite\" }} }} }}]\n\
             relief.saw = {{ kind = \"sawtooth\" }}\n\
             cut = [{{ cutout = {{ relief = \"saw\", amplitude = \"3%\", period = \"9%\" }} }}]"
        );
        of_cutouts += caps_agreed_on(&folder.scene(&text), size_px, &methods);
        // Something in the middle that is to be seen.
        let bounds = plain.bounds();
        let size = DVec3::splat(0.2 * bounds.size().max_element());
        let ball = placed("ball", "sphere?subdivisions=3", size, bounds.centre());
        let mut parts = plain.parts;
        parts.push(interior(ball));
        let mut scene = broken_open(&plain.name, parts, Breakaway::default());
        scene.camera = cameras_around(&bounds, 5, 3.0).nth(1).expect("a camera");
        of_openings += caps_agreed_on(&scene, size_px, &methods);
    }
    println!(
        "{meshes} meshes: {of_cutouts} pixels of caps of cutouts, {of_openings} of breakaways"
    );
    assert!(meshes == 0 || of_cutouts > 10_000 && of_openings > 5000);
}
