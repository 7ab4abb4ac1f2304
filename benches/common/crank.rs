//! The built-in crank of about 100 thousand triangles, halved in two ways.

use cutaway::scene::{
    Camera, Cut, ReliefSpec, Scene, Viewpoint, apply_relief, section_surface, shapes,
};

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
    let plane = section_surface("-z=50%", &bounds).expect("a plane");
    let spec = ReliefSpec::parse("fractal:amplitude=4%,period=45%,seed=7").expect("a relief");
    let relief = apply_relief(plane.clone(), &spec, &bounds).expect("a relief that is computed");
    [("plane", plane), ("relief", relief)].map(|(name, surface)| {
        let cuts = vec![Cut::of("front", vec![surface])];
        (
            name,
            Scene {
                cuts,
                ..uncut.clone()
            },
        )
    })
}
