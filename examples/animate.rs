//! A mesh that moves in every frame and stays cut: what did not change is neither packed nor uploaded again.
//!
//! `cargo run --example animate`

use cutaway::Model;
use cutaway::gpu::{Gpu, GpuOptions};
use cutaway::layers::Kind;
use cutaway::scene::{ClipSurface, Cut, Scene};
use cutaway::session::{Outcome, Session};
use cutaway::strategies::Strategy;
use glam::{DAffine3, DQuat};

fn main() -> cutaway::Result<()> {
    for (degrees, caps_px) in frames()? {
        println!("{degrees:3} degrees: {caps_px} px of cap");
    }
    Ok(())
}

/// The turn of a crankshaft in degrees, and how many pixels of cap are seen.
pub(crate) fn frames() -> cutaway::Result<Vec<(u32, usize)>> {
    let mut scene = Scene {
        parts: cutaway::generate::shapes::shape("crank")?,
        ..Scene::default()
    };
    let bounds = scene.bounds();
    let plane = ClipSurface::parse("-z=50%", &bounds)?;
    scene.cuts.push(Cut::new("front half", vec![plane]));
    // Room for all of the turn: the camera is to stand still.
    scene.stage = Some(cutaway::scene::Bounds::from_points([
        bounds.min - bounds.radius(),
        bounds.max + bounds.radius(),
    ]));
    let mut session = Session::new(Gpu::open(&GpuOptions::default())?);
    let mut model = Model::new(&scene);
    let view = model.prepared.view([320, 240]);
    let mut found = Vec::new();
    for degrees in [0, 30, 60, 90] {
        let turn = DQuat::from_rotation_x(f64::from(degrees).to_radians());
        for part in &mut scene.parts {
            part.world_from_part = DAffine3::from_quat(turn);
        }
        model = model.updated(&scene);
        let drawn = session.draw(&model, &view, Strategy::RAYCAST_MASK)?;
        assert_eq!(drawn.outcome, Outcome::Complete, "{degrees} degrees");
        let layers = session.layers(Strategy::RAYCAST_MASK)?;
        found.push((degrees, layers.count(Kind::Cap)));
    }
    Ok(found)
}
