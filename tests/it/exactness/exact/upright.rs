//! An image on a section stands upright and is not mirrored, seen from the removed side.

use cutaway::scene::relief::Placement;
use cutaway::scene::{
    Camera, Cut, OffsetMap, Part, PlaneSpec, Prepared, Projection, Scene, Up, Viewpoint, Wrap,
};
use cutaway_lab::exact::evaluate;
use cutaway_lab::hard_cases::meshes;
use glam::{DVec2, DVec3};

/// The letter F, 1 where it is drawn: no turn and no mirror image of it is the same.
const LETTER: [&str; 5] = ["###", "#..", "##.", "#..", "#.."];

fn letter() -> OffsetMap {
    let heights = (LETTER.iter().flat_map(|row| row.bytes()))
        .map(|c| f32::from(u8::from(c == b'#')))
        .collect();
    OffsetMap::new([3, 5], heights).expect("finite heights")
}

/// A cube with the letter on a section, seen along the normal from the removed side with the world's up axis up, or in a level
/// plane with the x axis to the right.
fn cube(section: &str, up: Up) -> Scene {
    let mut scene = Scene {
        parts: vec![Part::new("cube", meshes::shape("cube"))],
        ..Scene::default()
    };
    let bounds = scene.bounds();
    let plane = PlaneSpec::parse(section).and_then(|s| s.surface(&bounds, up));
    let plane = plane.expect(section);
    let placement = Placement {
        amplitude: cutaway::scene::Amount::Units(0.2),
        period: Some(cutaway::scene::Amount::Units(0.6)),
        wrap: Wrap::Clamp,
    };
    let normal = plane.frame().normal;
    let placed = plane.with_relief(letter(), &placement, &bounds);
    scene.cuts = vec![Cut::new("cut", vec![placed.expect("a relief")])];
    let is_level = normal.dot(up.axis()).abs() > 0.5;
    scene.camera = Camera {
        viewpoint: Viewpoint::Explicit {
            position: normal * -4.0,
            focal_point: DVec3::ZERO,
            view_up: Some(if is_level {
                DVec3::X.cross(normal)
            } else {
                up.axis()
            }),
        },
        projection: Projection::Orthographic { height: Some(1.0) },
        up,
        ..Camera::default()
    };
    scene
}

#[test]
fn the_letter_can_be_read_on_all_axes() {
    let sections = [
        "x=50%",
        "-x=50%",
        "y=50%",
        "-y=50%",
        "z=50%",
        "-z=50%",
        "-1,0,0@0,0,0",
        "-1,-0,-0,0",
        "0,0,2@0,0,0",
    ];
    for up in [Up::PlusY, Up::PlusZ] {
        for section in sections {
            let prepared = Prepared::new(&cube(section, up));
            let exact = evaluate(&prepared, &prepared.view([100, 100]));
            // What is high rises toward the eye. Texels are 0.2 wide and lie around the middle.
            let depth = |column: usize, row: usize| {
                let texel = DVec2::new(column as f64 - 1.0, row as f64 - 2.0) * 20.0 + 50.0;
                exact.layers.at(texel.x as u32, texel.y as u32).depth / prepared.scale
            };
            let read: Vec<String> = (0..5)
                .map(|row| {
                    let is_high = |column: usize| depth(column, row) < 4.0;
                    let drawn = (0..3).map(|c| if is_high(c) { '#' } else { '.' });
                    drawn.collect()
                })
                .collect();
            assert_eq!(read, LETTER, "{section}, {up:?}");
        }
    }
}
