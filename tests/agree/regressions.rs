//! What once was wrong, by number, each in the smallest scene that showed it.

use cutaway::layers::Kind;
use cutaway::scene::{Camera, Wrap};
use cutaway::session::Session;
use cutaway::strategies::Strategy;
use glam::DVec3;

use crate::common::{Question, meshes, scenes, strategy};

/// A map of one height is a plane, which the vertex shader does not displace; the grid lay on the plane without the height.
#[test]
fn regression_0001_the_grid_of_a_flat_map_is_lifted() {
    let map = scenes::map([1, 1], |_, _| 0.25);
    let surface = scenes::mapped(DVec3::ZERO, -DVec3::Z, map, (1.0, 1.0), Wrap::Repeat);
    let scene = scenes::scene("lifted", meshes::shape("cube"), vec![surface]);
    let judged = Question::of(&scene, [64; 2]).answer(&strategy("grid:4+vds:512"));
    assert!(
        judged.exact.layers.count(Kind::Cap) > 200,
        "the cap is in the picture"
    );
    assert_eq!(
        judged.comparison.decided_wrong_px, 0,
        "{:?}",
        judged.comparison
    );
    let off = judged.comparison.depth_error_max;
    assert!(off < 1e-4, "the cap lies {off} beside the surface");
}

/// Along a row of crests that touch the ray, rounding left out the two roots or put them on one spot; exact was then sure of
/// what a hair decides.
#[test]
fn regression_0002_a_ray_that_touches_crests_is_undecided() {
    let ridges = scenes::map([8, 4], |x, y| f32::from(x % 2 == 0 && y % 2 == 1));
    for height in [0.25, 0.25 + 1e-7, 0.25 - 1e-7] {
        let mut surface = scenes::mapped(
            DVec3::ZERO,
            DVec3::Z,
            ridges.clone(),
            (1.0, height),
            Wrap::Repeat,
        );
        (surface.u, surface.v) = (DVec3::X, DVec3::Y);
        let mut scene = scenes::scene(
            "crests",
            meshes::shape("sphere?subdivisions=3"),
            vec![surface.flipped()],
        );
        // An odd number of pixels: the middle row is the ray at z = 0, where the valleys are.
        scene.camera = scenes::parallel(DVec3::Y * 4.0, DVec3::ZERO, 2.0);
        let judged = Question::of(&scene, [255; 2]).answer(&Strategy::RAYCAST_MASK);
        assert_eq!(judged.fault_of_exact(), None, "height {height}");
    }
}

/// Where the near plane is in a solid and makes no cap, an odd count is no sign of an open mesh.
#[test]
fn regression_0003_a_near_plane_without_a_cap_leaves_pixels_reliable() {
    let mut scene = scenes::sectioned("cube", &["-x=0.25"]);
    scene.camera = Camera {
        near: Some(1.6),
        near_cap: false,
        ..scenes::looking(DVec3::new(0.3, 0.4, 2.0), DVec3::ZERO, 40.0)
    };
    let judged = Question::of(&scene, [64; 2]).answer(&Strategy::RAYCAST_MASK);
    assert_eq!(
        judged.comparison.odd_parity_px, 0,
        "{:?}",
        judged.comparison
    );
}

/// A session held `Rc`s, so no application could draw on another thread than the one it began on.
#[test]
fn regression_0004_a_session_can_go_to_another_thread() {
    fn goes<T: Send>() {}
    goes::<Session>();
}
