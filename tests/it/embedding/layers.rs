//! Layers that come from a frame without a wait, and layers from elsewhere that are composed.

use cutaway::Model;
use cutaway::gpu::{layers_from_words, wgpu, words_from_layers};
use cutaway::layers::Kind;
use cutaway::session::Outcome;
use cutaway::strategies::Method;

use super::common::session;
use super::guest::{SIZE_PX, crank, in_bands};
use super::host::Host;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

fn method(name: &str) -> Method {
    name.parse().expect("a method")
}

#[test]
fn awaited_layers_are_those_that_are_waited_for() {
    let model = Model::new(&crank());
    let view = model.prepared.view(SIZE_PX);
    let host = Host::new(SIZE_PX, FORMAT);
    // The sprite of the grid is too small at first; the session in bands puts the rows together.
    for (name, bands) in [
        ("raycast+mask", false),
        ("grid:32+vds:64", false),
        ("raycast+mask", true),
    ] {
        let method = method(name);
        let asked = || match bands {
            true => in_bands(&host, &model, method),
            false => host.session(),
        };
        let expected = {
            let mut waits = asked();
            let drawn = waits.draw(&model, &view, method).expect("a frame");
            assert_eq!(drawn.outcome, Outcome::Complete, "{name}");
            assert_eq!(waits.bands(method).expect("a frame") > 1, bands, "{name}");
            (
                waits.layers(method).expect("layers"),
                waits.picture(method).expect("a picture"),
            )
        };
        let mut session = asked();
        let awaited = pollster::block_on(session.layers_async(&model, &view, method));
        let awaited = awaited.expect("a device").expect("layers");
        assert!(awaited == expected.0, "{name}: other layers");
        let awaited = pollster::block_on(asked().frame_async(&model, &view, method));
        let awaited = awaited.expect("a device").expect("a frame");
        assert!(awaited == expected, "{name}: another frame");
        let shaded = pollster::block_on(session.shade_async(&model, &view, &awaited.0));
        let shaded = shaded.expect("a device");
        assert!(
            shaded == session.shade(&model, &view, &awaited.0).expect("a picture"),
            "{name}: another picture"
        );
    }
    let refused = pollster::block_on(host.session().layers_async(&model, &view, method("planar")));
    assert!(refused.expect("a device").is_err(), "a relief is no plane");
}

#[test]
fn layers_from_elsewhere_are_composed_as_they_are_shaded() {
    let model = Model::new(&crank());
    let view = model.prepared.view(SIZE_PX);
    let mut own = session();
    let drawn = own.draw(&model, &view, method("raycast+mask"));
    assert_eq!(drawn.expect("a frame").outcome, Outcome::Complete);
    let mut layers = own.layers(method("raycast+mask")).expect("layers");
    let host = Host::new(SIZE_PX, FORMAT);
    let compose = |layers: &cutaway::Layers| {
        let views = host.views();
        let mut encoder = host.encoder();
        let target = host.target(&views, None);
        let composed = host
            .session()
            .encode_layers(&mut encoder, &model, &view, layers, &target);
        composed.expect("a picture");
        host.submit(encoder);
        host.read().0
    };
    let expected = own.shade(&model, &view, &layers).expect("a picture");
    assert!(compose(&layers) == expected, "another picture");
    // The control: other layers are another picture.
    for pixel in &mut layers.pixels {
        pixel.kind = Kind::Background;
    }
    assert!(compose(&layers) != expected, "whatever the layers say");
}

#[test]
fn words_carry_layers_as_shaders_have_them() {
    let model = Model::new(&crank());
    let view = model.prepared.view(SIZE_PX);
    let mut own = session();
    let drawn = own.draw(&model, &view, method("raycast+mask"));
    assert_eq!(drawn.expect("a frame").outcome, Outcome::Complete);
    let layers = own.layers(method("raycast+mask")).expect("layers");
    let back = layers_from_words(&words_from_layers(&layers));
    assert!(back == layers.pixels, "something is lost on the way");
}
