//! What a host gets: the very pixels of a session of our own, in whatever bands, and again when buffers grew.

use cutaway::Gpu;
use cutaway::Model;
use cutaway::gpu::{ClockSet, wgpu};
use cutaway::plan::{Clock, Limits};
use cutaway::scene::{ClipSurface, Cut, Scene};
use cutaway::session::{Encoded, Outcome, Session};
use cutaway::strategies::{Method, Unsupported};

use super::common::{meshes, scenes, session};
use super::host::{Host, adapter};

pub(super) const SIZE_PX: [u32; 2] = [160, 120];
const PLAIN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

pub(super) fn crank() -> Scene {
    let mut scene = scenes::of_parts("crank", meshes::parts("crank"), Vec::new());
    let plane = ClipSurface::parse("-z=50%", &scene.bounds()).expect("a section");
    let rough = scenes::relief(&scene, "x=60%", "waves:amplitude=4%");
    scene.cuts = vec![
        Cut::new("plane", vec![plane]),
        Cut::new("relief", vec![rough]),
    ];
    scene
}

fn method(name: &str) -> Method {
    name.parse().expect("a method")
}

/// Encodes and submits until no buffer asks for more: how many passes each frame took, and what overflowed.
fn preclassified(
    host: &Host,
    session: &mut Session,
    model: &Model,
    method: Method,
) -> (Vec<usize>, Vec<String>) {
    let view = model.prepared.view(SIZE_PX);
    let views = host.views();
    let (mut passes, mut overflows) = (Vec::new(), Vec::new());
    for _ in 0..6 {
        let mut encoder = host.encoder();
        let target = host.target(&views, None);
        let encoded = session.encode(&mut encoder, model, &view, method, &target);
        let Encoded::Drawn { passes: count } = encoded.expect("a frame") else {
            panic!("{method} is refused");
        };
        passes.push(count);
        host.submit(encoder);
        // A host would go on; a test wants to know what comes of this frame.
        host.wait();
        let lacked = session.poll().expect("a device");
        overflows.extend(lacked.into_iter().map(|(_, overflow)| overflow.what));
    }
    (passes, overflows)
}

#[test]
fn a_host_sees_the_pixels_of_render() {
    let (scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let view = model.prepared.view(SIZE_PX);
    let mut seen = Vec::new();
    for name in [
        "raycast+mask",
        "raycast+mask@compute",
        "raycast+abuffer",
        "raycast+ldi:64",
        "grid:32+vds:64",
        "adaptive:0.5+mask",
    ] {
        let method = method(name);
        let expected = {
            let mut own = session();
            let drawn = own.draw(&model, &view, method).expect("a frame");
            assert_eq!(drawn.outcome, Outcome::Complete, "{name}");
            own.picture(method).expect("a picture")
        };
        let mut session = host.session();
        let (passes, _) = preclassified(&host, &mut session, &model, method);
        let (color, _) = host.read();
        assert!(color == expected, "{name}: other pixels");
        seen.push(color);
        // A still scene runs no pass of its own, once its buffers are large enough.
        assert!(passes[0] > 2, "{name}: {passes:?}");
        assert_eq!(passes.last(), Some(&0), "{name}: {passes:?}");
    }
    // The control: methods differ, so equal pictures above are no blank ones.
    assert!(seen.iter().any(|c| *c != seen[0]), "all alike");
}

#[test]
fn what_overflows_is_reported_later_and_has_room_then() {
    let (scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let mut session = host.session();
    let (passes, overflows) = preclassified(&host, &mut session, &model, method("grid:32+vds:64"));
    let layers = |o: &&String| o.contains("layers of the sprite");
    assert!(overflows.iter().any(|o| layers(&o)), "{overflows:?}");
    assert!(passes[1] > passes[0], "more layers are peeled: {passes:?}");
    // What cannot grow stays as it is, and is reported once: no frame after it is encoded anew.
    let mut session = host.session();
    let (passes, overflows) =
        preclassified(&host, &mut session, &model, method("raycast+kbuffer:1"));
    assert!(
        overflows.iter().any(|o| o.contains("the K")),
        "{overflows:?}"
    );
    assert_eq!(passes.last(), Some(&0), "{passes:?}");
}

/// A session that draws a frame in several bands.
pub(super) fn in_bands(host: &Host, model: &Model, method: Method) -> Session {
    let mut whole = host.session();
    preclassified(host, &mut whole, model, method);
    let plan = whole.plan(method).expect("a plan");
    let largest = plan.resources.iter().map(|r| r.shape.bytes()).max();
    let limits = Limits {
        storage_binding_bytes: largest.expect("resources") / 2,
        ..Limits::CORE
    };
    let (device, queue) = (host.device.clone(), host.queue.clone());
    let gpu = Gpu::from_device(&host.info, device, queue).expect("a device");
    Session::new(gpu.held_to(limits))
}

#[test]
fn a_picked_pixel_is_that_of_the_layers() {
    let (scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let method = method("raycast+mask");
    for mut session in [host.session(), in_bands(&host, &model, method)] {
        let mut encoder = host.encoder();
        let none = session.pick(&mut encoder, method, [0, 0]);
        assert!(none.is_err(), "there is no frame yet");
        preclassified(&host, &mut session, &model, method);
        let layers = session.layers(method).expect("layers");
        let mut kinds = [0; 3];
        for index in (0..layers.pixels.len()).step_by(611) {
            let [x, y] = [index as u32 % SIZE_PX[0], index as u32 / SIZE_PX[0]];
            let mut encoder = host.encoder();
            let pick = session
                .pick(&mut encoder, method, [x, y])
                .expect("it is there");
            assert!(pick.layer().is_none(), "nothing was submitted");
            host.submit(encoder);
            host.wait();
            session.poll().expect("a device");
            let layer = pick.layer().expect("it has come");
            assert_eq!(layer, layers.pixels[index], "({x}, {y})");
            kinds[layer.kind as usize] += 1;
        }
        assert!(kinds.iter().all(|k| *k > 0), "of every kind: {kinds:?}");
        for beyond in [[SIZE_PX[0], 0], [0, SIZE_PX[1]]] {
            let refused = session.pick(&mut encoder, method, beyond);
            assert!(refused.is_err(), "{beyond:?} is beyond it");
        }
    }
}

#[test]
fn bands_are_composed_to_one_picture() {
    let (scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let method = method("raycast+mask");
    let mut held = in_bands(&host, &model, method);
    let (expected, _) = host.read();
    let mut encoder = host.encoder();
    host.clear(&mut encoder, [0.0; 3], 0.0);
    host.submit(encoder);
    preclassified(&host, &mut held, &model, method);
    assert!(held.bands(method).expect("a frame") > 1, "in one piece");
    let (color, _) = host.read();
    assert!(color == expected, "another picture in bands");
}

#[test]
fn what_moves_is_drawn_anew_and_what_is_refused_leaves_no_trace() {
    let (mut scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let mut session = host.session();
    let exact = method("raycast+mask");
    preclassified(&host, &mut session, &model, exact);
    let (before, _) = host.read();
    scene.cuts[0].surfaces[0].origin.z += 0.1;
    let moved = model.updated(&scene);
    let (passes, _) = preclassified(&host, &mut session, &moved, exact);
    assert!(passes[0] > 0, "{passes:?}");
    let (after, _) = host.read();
    assert!(before != after, "nothing moved");

    let view = moved.prepared.view(SIZE_PX);
    let views = host.views();
    let mut encoder = host.encoder();
    let target = host.target(&views, None);
    let encoded = session.encode(&mut encoder, &moved, &view, method("planar"), &target);
    host.submit(encoder);
    match encoded.expect("an answer") {
        Encoded::Refused(refusal) => assert_eq!(refusal.unsupported, Unsupported::Reliefs),
        drawn => panic!("{drawn:?}"),
    }
    assert!(host.read().0 == after, "a refusal has drawn");
}

#[test]
fn clocks_are_those_of_the_passes_that_ran() {
    let (mut scene, host) = (crank(), Host::new(SIZE_PX, PLAIN));
    let model = Model::new(&scene);
    let mut session = host.session();
    let paper = method("grid:16+vds:64");
    assert!(session.clocks(paper).is_err(), "there is no frame");
    preclassified(&host, &mut session, &model, paper);
    let first = session.clocks(paper).expect("a frame");
    assert!(first.contains(Clock::Solid), "sprites are made: {first:?}");
    assert!(first.contains(Clock::Frame), "{first:?}");
    scene.camera.zoom *= 1.1;
    preclassified(&host, &mut session, &model.updated(&scene), paper);
    let moved = session.clocks(paper).expect("a frame");
    assert_eq!(moved, ClockSet::FRAME, "only the eye has moved");
}

#[test]
fn linear_targets_get_linear_light() {
    let (scene, host) = (
        crank(),
        Host::new(SIZE_PX, wgpu::TextureFormat::Rgba8UnormSrgb),
    );
    let model = Model::new(&scene);
    let method = method("raycast+mask");
    preclassified(&host, &mut host.session(), &model, method);
    let view = model.prepared.view(SIZE_PX);
    let mut own = session();
    let _ = own.draw(&model, &view, method).expect("a frame");
    let expected = own.picture(method).expect("a picture");
    let (color, _) = host.read();
    let farthest = color
        .iter()
        .zip(&expected)
        .map(|(a, b)| a.abs_diff(*b))
        .max();
    assert!(farthest <= Some(1), "off by {farthest:?} of 255");
}

#[test]
fn a_device_with_less_than_core_is_refused_by_name() {
    let adapter = adapter();
    let asked = wgpu::DeviceDescriptor {
        required_limits: wgpu::Limits {
            max_storage_buffers_per_shader_stage: 4,
            ..wgpu::Limits::default()
        },
        ..wgpu::DeviceDescriptor::default()
    };
    let asked = adapter.request_device(&asked);
    let (device, queue) = pollster::block_on(asked).expect("a device");
    let refused = Gpu::from_device(&adapter.get_info(), device, queue);
    let message = refused.err().expect("too little").to_string();
    for phrase in [
        "max_storage_buffers_per_shader_stage",
        "8 are needed, 4",
        "help:",
    ] {
        assert!(message.contains(phrase), "{message}");
    }
}

#[test]
fn what_the_device_lacks_is_refused_with_what_works() {
    // A device without the optional features: the stencil strategies want one.
    let adapter = adapter();
    let asked = adapter.request_device(&wgpu::DeviceDescriptor::default());
    let (device, queue) = pollster::block_on(asked).expect("a device");
    let gpu = Gpu::from_device(&adapter.get_info(), device, queue).expect("core is enough");
    let mut session = Session::new(gpu);
    let scene = scenes::sectioned("cube", &["-z=50%"]);
    let model = Model::new(&scene);
    let view = model.prepared.view(SIZE_PX);
    let drawn = session
        .draw(&model, &view, method("stencil"))
        .expect("an answer");
    let Outcome::Refused(refusal) = drawn.outcome else {
        panic!("{:?}", drawn.outcome);
    };
    assert_eq!(refusal.unsupported, Unsupported::Limit, "{refusal}");
    for phrase in ["depth32float-stencil8", "raycast+mask", "planar"] {
        assert!(refusal.reason.contains(phrase), "{refusal}");
    }
    assert!(!refusal.reason.contains("raycast+stencil"), "{refusal}");
}

#[test]
fn the_handler_of_the_host_is_not_called() {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};
    let host = Host::new(SIZE_PX, PLAIN);
    let calls = Arc::new(AtomicUsize::new(0));
    let count = calls.clone();
    host.device
        .on_uncaptured_error(Arc::new(move |_: wgpu::Error| {
            count.fetch_add(1, Ordering::Relaxed);
        }));
    let mut session = host.session();
    let model = Model::new(&crank());
    preclassified(&host, &mut session, &model, method("raycast+mask"));
    // A target that does not fit its pipeline is our error, not the host's.
    let view = model.prepared.view([SIZE_PX[0] * 2, SIZE_PX[1]]);
    let views = host.views();
    let mut encoder = host.encoder();
    let target = host.target(&views, None);
    let encoded = session.encode(&mut encoder, &model, &view, method("raycast+mask"), &target);
    let message = encoded
        .expect_err("a frame larger than its target")
        .to_string();
    assert!(
        message.contains("320 x 120") && message.contains("160 x 120"),
        "{message}"
    );
    assert_eq!(
        calls.load(Ordering::Relaxed),
        0,
        "the handler of the host was called"
    );
}
