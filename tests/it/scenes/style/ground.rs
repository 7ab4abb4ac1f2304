//! The shadow on the ground: where what is kept hides the sky, from whatever the method.

use super::*;
use cutaway::scene::style::Shadow;
use cutaway::scene::{Camera, Projection, Viewpoint};
use glam::DVec2;

/// A cube that stands on the ground of which the right half is cut away, and seen from above.
fn half_a_cube(strength: f32) -> Scene {
    let parts = vec![Part::new("cube", meshes::shape("cube"))];
    let mut scene = scenes::of_parts("grounded", parts, Vec::new());
    let plane = ClipSurface::parse("-x=50%", &scene.bounds()).expect("a section");
    scene.cuts = vec![Cut::new("cut", vec![plane])];
    scene.camera = Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg: 20.0,
            elevation_deg: 50.0,
        },
        projection: Projection::Orthographic { height: None },
        zoom: 0.6,
        ..Camera::default()
    };
    scene.style.paper = Paper::Color(glam::Vec3::ONE);
    scene.style.shadow = Shadow {
        strength,
        ..Shadow::default()
    };
    scene
}

/// How much darker than white the ground is at points of it, right and towards the eye from the middle of the cube in halves of its side.
fn darkness(scene: &Scene, method: Method, points: &[[f64; 2]]) -> Vec<f64> {
    let mut session = session();
    let model = Model::new(scene);
    let view = model.prepared.view([300, 300]);
    let shadow = session.ground_shadow(&model, method).expect("a frame");
    let model = model.on_ground(shadow.expect("a shadow"));
    let drawn = session.draw(&model, &view, method).expect("a frame");
    assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
    let picture = session.picture(method).expect("a picture");
    let (centre, half) = {
        let bounds = model.prepared.bounds;
        (bounds.centre(), bounds.size() / 2.0)
    };
    let dark = points.iter().map(|[x, y]| {
        let point = centre + half * DVec3::new(*x, -1.0, *y);
        let DVec2 { x, y } = view.project(point).0;
        let first = 4 * (y as usize * 300 + x as usize);
        1.0 - f64::from(picture[first]) / 255.0
    });
    dark.collect()
}

#[test]
fn the_ground_is_dark_beside_what_is_kept_alone() {
    // Beside the half that is kept, far from all, and beside the half that is gone: in the picture all of them are ground.
    let points = [[-0.5, 1.08], [-0.5, 3.2], [0.95, 1.3]];
    for method in [Strategy::RAYCAST_MASK, Strategy::STENCIL].map(Method::from) {
        let dark = darkness(&half_a_cube(0.8), method, &points);
        assert!(dark[0] > 0.1, "{method}: {dark:?}");
        assert!(dark[1] < 0.01, "{method}: {dark:?}");
        assert!(dark[2] < 0.5 * dark[0], "{method}: {dark:?}");
    }
}

#[test]
fn where_there_is_no_background_the_shadow_covers_alone() {
    let mut scene = half_a_cube(1.0);
    scene.style.paper = Paper::None;
    let mut session = session();
    let method = Method::from(Strategy::RAYCAST_MASK);
    let model = Model::new(&scene);
    let view = model.prepared.view([240, 240]);
    let alphas = |session: &mut Session, model: &Model| {
        let drawn = session.draw(model, &view, method).expect("a frame");
        assert_eq!(drawn.outcome, Outcome::Complete, "a frame");
        let layers = session.layers(method).expect("layers");
        let picture = session.picture(method).expect("a picture");
        let ground = layers.pixels.iter().zip(picture.chunks_exact(4));
        let ground = ground.filter(|(l, _)| l.kind == Kind::Background);
        ground.map(|(_, c)| [c[0], c[3]]).collect::<Vec<_>>()
    };
    // A model that was given no shadow has none.
    assert!(alphas(&mut session, &model).iter().all(|[_, a]| *a == 0));
    let shadow = session.ground_shadow(&model, method).expect("a frame");
    let grounded = alphas(&mut session, &model.on_ground(shadow.expect("a shadow")));
    assert!(
        grounded.iter().all(|[color, a]| *a == 0 || *color == 0),
        "black"
    );
    let covered = grounded.iter().filter(|[_, a]| *a > 4).count();
    assert!(covered > 60, "{covered} pixels of shadow");
}
