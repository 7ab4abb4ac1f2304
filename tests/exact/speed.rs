//! The work of one large frame, for `cargo test --release --test exact -- --ignored --nocapture large`.

use cutaway::scene::ClipSurface;
use glam::dvec3;

use crate::solids::{ball, fractal, frame, orbit, relief, scene};

#[test]
#[ignore = "for timing, in release"]
fn large_frames() {
    let mesh = ball(1.0, 224, 224);
    let plane = ClipSurface::plane(dvec3(0.0, 0.0, 0.1), dvec3(0.2, 0.1, -1.0));
    let ragged = relief(0.1, 0.5, 0.3, fractal(256, 5));
    let size = [1024, 768];
    for (name, cuts) in [
        ("nothing", vec![]),
        ("a plane", vec![vec![plane]]),
        ("a relief of 256 x 256", vec![vec![ragged]]),
    ] {
        let camera = orbit(30.0, 40.0);
        let scene = scene(vec![mesh.clone()], cuts, camera);
        #[allow(clippy::disallowed_methods, reason = "timing is what this is for")]
        let start = std::time::Instant::now();
        let exact = frame(&scene, size);
        println!(
            "{} faces cut by {name}: {:?}, {} px covered, {:.1e} undecided, {} px open in depth",
            mesh.triangles.len(),
            start.elapsed(),
            exact.covered_px(),
            exact.undecided_share(),
            exact.depth_open.iter().filter(|o| **o).count()
        );
    }
}
