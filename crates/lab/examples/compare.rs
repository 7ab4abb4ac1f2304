//! Two methods on one frame: where each is wrong, judged by the exact reference pixel by pixel.
//!
//! `cargo run --example compare`

use cutaway::Model;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::scene::{ClipSurface, Cut, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Method;
use cutaway_lab::exact::evaluate;

fn main() -> cutaway::Result<()> {
    for (name, wrong_px, cracks_px) in errors()? {
        println!("{name}: {wrong_px} px wrong where the reference is sure, {cracks_px} px of gaps");
    }
    Ok(())
}

/// Name, decided wrong pixels and pixels of gaps of two methods.
pub(crate) fn errors() -> cutaway::Result<Vec<(String, usize, usize)>> {
    let mut scene = Scene {
        parts: cutaway::generate::shapes::shape("crank")?,
        ..Scene::default()
    };
    let plane = ClipSurface::parse("-z=50%", &scene.bounds())?;
    scene.cuts.push(Cut::new("front half", vec![plane]));
    scene.camera = scene.camera.facing(&scene.cuts);

    let model = Model::new(&scene);
    let view = model.prepared.view([320, 240]);
    let exact = evaluate(&model.truth(&scene), &view);
    let mut session = Session::new(Gpu::open(&GpuOptions::default())?);
    let mut found = Vec::new();
    for name in ["raycast+mask", "grid:64+vds:128"] {
        let method: Method = name.parse()?;
        let drawn = session.draw(&model, &view, method)?;
        assert_eq!(drawn.outcome, Outcome::Complete, "{name}");
        let layers = session.layers(method)?;
        let error = cutaway_lab::compare(&exact, &layers, &view, model.prepared.scale);
        found.push((name.to_owned(), error.decided_wrong_px, error.crack_px));
    }
    Ok(found)
}
