//! Cameras in awkward places, and scenes far away, tiny or huge.

use cutaway::layers::{Kind, NEAR_PLANE};
use cutaway::scene::{Camera, ClipSurface, Prepared, View};
use cutaway_lab::exact::Exact;
use glam::{DVec2, DVec3, dvec3};

use crate::exactness::exact::solids::{
    ball, cuboid, differing, eye, fractal, frame, inside_out, joined, mapped, orbit, parallel,
    relief, scene, sound, unit_cube,
};

const FRONT: DVec3 = DVec3::new(0.0, 0.0, 4.0);
const SIZE: [u32; 2] = [48, 48];

fn hollow() -> cutaway::scene::Mesh {
    joined(ball(1.0, 24, 24), inside_out(ball(0.5, 24, 24)))
}

#[test]
fn inside_a_solid_the_near_plane_caps_the_whole_picture() {
    let camera = eye(dvec3(0.1, 0.0, 0.2), dvec3(0.0, 1.0, -3.0), 50.0);
    let capped = sound(&scene(vec![unit_cube()], vec![], camera), SIZE);
    assert_eq!(capped.layers.count(Kind::Cap), 48 * 48, "solid all around");
    let layer = capped.layers.at(3, 40);
    assert_eq!(layer.clip_surface, NEAR_PLANE, "no clip-surface made it");
    let open = Camera {
        near_cap: false,
        ..camera
    };
    let open = sound(&scene(vec![unit_cube()], vec![], open), SIZE);
    assert_eq!(open.covered_px(), 0, "the ray leaves and enters nothing");
}

#[test]
fn inside_a_void_its_wall_is_seen() {
    let camera = eye(DVec3::ZERO, dvec3(0.3, 0.2, -1.0), 60.0);
    for cuts in [
        vec![],
        // Beyond the void nothing the plane does can be seen.
        vec![vec![ClipSurface::plane(DVec3::Z * -0.8, DVec3::Z)]],
    ] {
        let exact = sound(&scene(vec![hollow()], cuts, camera), SIZE);
        assert_eq!(
            exact.layers.count(Kind::Surface),
            48 * 48,
            "wall all around"
        );
    }
}

#[test]
fn a_near_plane_in_the_solid_caps_it_or_shows_what_the_ray_enters_next() {
    let camera = Camera {
        near: Some(3.75),
        ..parallel(FRONT, DVec3::ZERO, 2.0)
    };
    let capped = sound(&scene(vec![unit_cube()], vec![], camera), [64, 64]);
    assert_eq!(
        capped.layers.count(Kind::Cap),
        32 * 32,
        "the cube at z = 1/4"
    );
    assert!(
        (capped.layers.at(32, 32).depth - 3.75).abs() < 1e-12,
        "at the near plane"
    );
    let open = Camera {
        near_cap: false,
        near: Some(3.25),
        ..camera
    };
    let hollow = scene(vec![hollow()], vec![], open);
    let shell = sound(&hollow, [64, 64]);
    let middle = shell.layers.at(32, 32);
    let depth = middle.depth / Prepared::new(&hollow).scale;
    assert_eq!(
        middle.kind,
        Kind::Surface,
        "beyond the void the ray enters the far wall"
    );
    assert!((depth - 4.5).abs() < 0.02, "depth {depth}");
}

#[test]
fn a_floor_that_goes_on_behind_the_eye_is_where_it_should_be() {
    let floor = cuboid(dvec3(-10.0, -1.0, -10.0), dvec3(10.0, 0.0, 10.0));
    let camera = eye(dvec3(0.0, 1.0, 0.0), dvec3(0.3, 0.7, -1.0), 70.0);
    let scene = scene(vec![floor], vec![], camera);
    let prepared = Prepared::new(&scene);
    let view = prepared.view(SIZE);
    let exact = sound(&scene, SIZE);
    let mut covered = 0;
    for y in 0..48 {
        for x in 0..48 {
            let (o, d) = view.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
            let o = o / prepared.scale + prepared.centre_in_world;
            let t = -o.y / d.y;
            let hit = o + d * t;
            let expected = t > 0.0 && hit.x.abs() < 10.0 && hit.z.abs() < 10.0;
            let layer = exact.layers.at(x, y);
            assert_eq!(layer.kind == Kind::Surface, expected, "pixel {x}, {y}");
            if expected {
                covered += 1;
                let depth = layer.depth / prepared.scale;
                assert!((depth - t).abs() < 1e-6 * t, "depth {depth}, not {t}");
            }
        }
    }
    assert!((500..2000).contains(&covered), "{covered} px of floor");
}

fn moved(offset: DVec3, size: f64, shift: f64) -> Exact {
    let place = |p: DVec3| p * size + offset;
    let mut surface = relief(0.1, 0.8, 0.3, fractal(32, 9));
    surface.origin = place(surface.origin + DVec3::Z * shift);
    surface.u *= size;
    surface.v *= size;
    surface.scale.z *= size;
    let meshes = [ball(1.0, 20, 24), mapped(unit_cube(), |p| p * 0.7)].map(|m| mapped(m, place));
    frame(
        &scene(meshes.to_vec(), vec![vec![surface]], orbit(30.0, 40.0)),
        [128, 128],
    )
}

#[test]
fn far_tiny_and_huge_scenes_look_alike() {
    let here = moved(DVec3::ZERO, 1.0, 0.0);
    assert!(
        here.layers.count(Kind::Cap) > 2000,
        "caps are what is compared"
    );
    for (offset, size) in [(1e6, 1.0), (0.0, 1e-6), (0.0, 1e6), (1e3, 1e-3)] {
        let there = moved(DVec3::splat(offset), size, 0.0);
        // Coordinates of 1e6 keep 2^-33 of a unit: far under 1/256 px.
        assert_eq!(differing(&here, &there), 0, "offset {offset}, size {size}");
    }
    let other = moved(DVec3::ZERO, 1.0, 0.02);
    assert!(
        differing(&here, &other) > 20,
        "a moved cut must look different"
    );
}

#[test]
fn the_horizon_of_the_view_does_not_matter_to_parity() {
    // Vertices before, at and behind the eye: the homogeneous edge functions need no clipping.
    let mut view: View = Prepared::new(&scene(vec![hollow()], vec![], orbit(0.0, 0.0))).view(SIZE);
    let prepared = Prepared::new(&scene(vec![hollow()], vec![], orbit(0.0, 0.0)));
    let vertex = prepared.parts[0].positions[200].as_dvec3();
    // Not on the mesh itself: an eye there has no side.
    for eye in [
        DVec3::ZERO,
        vertex * 1.01,
        vertex * 0.99,
        vertex * 0.75,
        dvec3(0.4, 0.4, 0.0),
    ] {
        view.eye = eye;
        view.near = 1e-3;
        let exact = cutaway_lab::exact::evaluate(&prepared, &view);
        let odd = crate::exactness::exact::solids::odd(&exact);
        assert_eq!(odd, 0, "{odd} odd px from {eye}");
    }
}
