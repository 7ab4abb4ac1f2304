//! Pixels that neither an open mesh nor its closing triangles cover, and that are inside nevertheless: between two plates that are seen from the
//! side. The compute rasteriser processed only the tiles that triangles touch, and all of these caps were missing.

use cutaway::layers::Kind;
use cutaway::scene::{Cut, Cutter, Mesh, Scene};
use cutaway_io::document;
use glam::{DAffine3, DVec3};

use super::device::judged;
use crate::common::{meshes, scenes};

/// Two square plates, facing away from each other.
fn plates() -> Scene {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let at = |z: f64| corners.map(|[x, y]| DVec3::new(x, y, z));
    let mesh = Mesh {
        positions: [at(-0.2), at(0.2)].concat(),
        triangles: vec![[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]],
        ..Mesh::default()
    };
    let mut scene = scenes::scene("plates", mesh, Vec::new());
    scene.camera = scenes::orbit(90.0, 0.0, true);
    scene
}

fn cap_is_whole(scene: &Scene, name: &str) {
    let mut caps = 0;
    for azimuth_deg in [0.0, 90.0, 180.0, 270.0] {
        for orthographic in [true, false] {
            let mut scene = scene.clone();
            scene.camera = scenes::orbit(azimuth_deg, 0.0, orthographic);
            for judged in judged(&scene) {
                let wrong = &judged.comparison;
                assert_eq!(wrong.unmarked_wrong_px, 0, "{name} from {azimuth_deg}");
                caps += judged.layers.count(Kind::Cap);
            }
        }
    }
    assert!(caps > 500, "{name}: {caps} cap pixels prove too little");
}

#[test]
fn a_cap_between_plates_is_whole_by_every_kind_of_clip_surface() {
    let scene = plates();
    let plane = |section: &str| document::section(section).on(&scene.bounds()).unwrap();
    let ball = Cutter::from_parts("ball", &meshes::parts("sphere?subdivisions=3")).unwrap();
    let ball = ball.placed(
        DAffine3::from_translation(DVec3::new(1.0, 0.5, 0.0))
            * DAffine3::from_scale(DVec3::splat(0.3)),
    );
    let cuts = [
        ("plane", Cut::new("cut", vec![plane("-x=50%")])),
        (
            "two planes",
            Cut::new("cut", vec![plane("-x=50%"), plane("y=40%")]),
        ),
        (
            "relief",
            Cut::new(
                "cut",
                vec![scenes::relief(&scene, "x=50%", "waves:amplitude=5%")],
            ),
        ),
        ("cutter", Cut::by(ball)),
    ];
    for (name, cut) in cuts {
        let mut scene = scene.clone();
        scene.cuts = vec![cut];
        cap_is_whole(&scene, name);
    }
}
