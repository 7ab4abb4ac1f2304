//! The built-in crank of about 100 thousand triangles, halved in two ways.

use cutaway::generate::shapes;
use cutaway::scene::{Camera, Cut, Scene, Viewpoint};
use cutaway_io::document::section;

/// The crank halved by a plane, and by a relief of 256 x 256 texels; both are seen from the side that is removed.
pub(crate) fn scenes() -> [(&'static str, Scene); 2] {
    let uncut = Scene {
        parts: shapes::shape("crank").expect("a built-in shape"),
        camera: Camera {
            viewpoint: Viewpoint::Orbit {
                azimuth_deg: 35.0,
                elevation_deg: 25.0,
            },
            ..Camera::default()
        },
        ..Scene::default()
    };
    let bounds = uncut.bounds();
    let relief = section("-z=50%").relief("fractal:amplitude=4%,period=45%,seed=7");
    [("plane", section("-z=50%")), ("relief", relief)].map(|(name, surface)| {
        let surface = surface.on(&bounds).expect("a clip-surface");
        let cuts = vec![Cut::new("front", vec![surface])];
        (
            name,
            Scene {
                cuts,
                ..uncut.clone()
            },
        )
    })
}
