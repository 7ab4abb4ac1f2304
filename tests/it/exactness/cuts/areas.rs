//! Areas and volumes of what boxes and wedges leave, counted in pixels of parallel rays against closed forms.

use std::f64::consts::PI;

use cutaway::layers::Kind;
use cutaway::scene::Scene;

use super::{Scratch, of_shape, seen};

const SIZE_PX: [u32; 2] = [200, 200];

/// The height of pictures: an edge of 1 is 100 pixels long, and halves of it end between pixels.
const HEIGHT: f64 = 2.0;
const PIXEL: f64 = HEIGHT / 200.0;

/// Radius of the ball.
const R: f64 = 0.5;
const BALL: &str = "sphere?subdivisions=6";

/// Of a ball of 41 thousand triangles and pixels of a hundredth: outlines of 300 pixels, each right to a fraction of one.
const TOLERANCE: f64 = 2e-3;

fn area(scene: &Scene, wanted: impl Fn(Kind) -> bool) -> f64 {
    let layers = seen(scene, SIZE_PX).layers;
    let count = layers.pixels.iter().filter(|p| wanted(p.kind)).count();
    count as f64 * PIXEL * PIXEL
}

fn covered(scene: &Scene) -> f64 {
    area(scene, |k| k != Kind::Background)
}

fn caps(scene: &Scene) -> f64 {
    area(scene, |k| k == Kind::Cap)
}

#[test]
fn a_box_takes_its_volume_out_of_a_cube() {
    let folder = Scratch::new("box");
    for (block, cap, volume) in [
        // An octant.
        (
            "box = { min = [0, 0, 0], max = [1, 1, 1] }",
            0.25,
            1.0 - 0.125,
        ),
        (
            "box = { min = [\"50%\", \"50%\", \"50%\"], max = [1, 1, 1] }",
            0.25,
            1.0 - 0.125,
        ),
        ("box = { min = [0, 0, 0] }", 0.25, 1.0 - 0.125),
        // A pocket of a tenth by a fifth, 0.3 deep.
        (
            "box = { centre = [0, 0, 0.5], size = [0.1, 0.2, 0.6] }",
            0.02,
            1.0 - 0.1 * 0.2 * 0.3,
        ),
        (
            "box = { centre = [0, 0, 0.5], size = [\"10%\", \"20%\", \"60%\"] }",
            0.02,
            1.0 - 0.1 * 0.2 * 0.3,
        ),
        // All around a smaller cube: nothing of the inside is seen.
        ("box = { centre = [0, 0, 0], size = 0.5 }", 0.0, 1.0),
        // Beside a plane: what both remove.
        (
            "box = { min = [-1, -1, 0] }\nsurfaces = [{ section = \"-x=0\" }]",
            0.5,
            1.0 - 0.25,
        ),
    ] {
        let scene = folder.scene(&of_shape("cube", [0, 0, 5], HEIGHT, block));
        let exact = seen(&scene, SIZE_PX);
        let found = caps(&scene);
        assert!((found - cap).abs() < 1e-9, "{block}: caps of {found}");
        // The height over the bottom of the cube, summed over all pixels.
        let prepared = cutaway::scene::Prepared::new(&scene);
        let view = prepared.view(SIZE_PX);
        let height = |depth: f64| {
            let z = (view.eye + view.forward * depth).z / prepared.scale;
            z + prepared.centre_in_world.z + 0.5
        };
        let shown = exact
            .layers
            .pixels
            .iter()
            .filter(|p| p.kind != Kind::Background);
        let found: f64 = shown.map(|p| height(p.depth) * PIXEL * PIXEL).sum();
        assert!(
            (found - volume).abs() < 1e-5,
            "{block}: a volume of {found}"
        );
    }
}

#[test]
fn a_wedge_takes_its_angle_out_of_a_ball() {
    let folder = Scratch::new("wedge");
    let whole = PI * R * R;
    for (from, to) in [
        (0, 90),
        (-30, 15),
        (200, 335),
        (10, 190),
        (0, 200),
        (45, 315),
        (0, 359),
    ] {
        let wedge = format!("wedge = {{ axis = \"z\", from_deg = {from}, to_deg = {to} }}");
        let scene = folder.scene(&of_shape(BALL, [0, 0, 5], HEIGHT, &wedge));
        let expected = whole * (1.0 - f64::from(to - from) / 360.0);
        let found = covered(&scene);
        assert!(
            (found - expected).abs() < TOLERANCE,
            "{wedge}: {found} instead of {expected}"
        );
    }
    // The control: an angle of five degrees is an area that would be seen.
    assert!(whole * 5.0 / 360.0 > 5.0 * TOLERANCE);
}

#[test]
fn the_face_of_a_wedge_is_half_a_disc() {
    // The quarter from x to y is gone: from y one looks at the half of the plane y = 0 where x > 0.
    let folder = Scratch::new("face");
    for (axis, from) in [
        ("\"z\"", [0, 5, 0]),
        ("[0, 0, 3]", [0, 5, 0]),
        // The next axis is 0 degrees, the one after it 90.
        ("\"x\"", [0, 0, 5]),
        ("\"y\"", [5, 0, 0]),
        // About -z it turns the other way round, from x over -y.
        ("\"-z\"", [0, -5, 0]),
    ] {
        let wedge = format!("wedge = {{ axis = {axis}, from_deg = 0, to_deg = 90 }}");
        let scene = folder.scene(&of_shape(BALL, from, HEIGHT, &wedge));
        let found = caps(&scene);
        let expected = PI * R * R / 2.0;
        assert!((found - expected).abs() < TOLERANCE, "{axis}: {found}");
        // The control: from the other side no cap is seen.
        let behind = from.map(|c| -c);
        let scene = folder.scene(&of_shape(BALL, behind, HEIGHT, &wedge));
        assert_eq!(caps(&scene), 0.0, "{axis} from behind");
    }
}

#[test]
fn the_ends_of_a_wedge_bound_it_along_its_axis() {
    let folder = Scratch::new("ends");
    let whole = PI * R * R;
    // The strip of a disc between two heights.
    let below = |h: f64| h * (R * R - h * h).sqrt() + R * R * (h / R).asin();
    for (ends, low, high) in [
        ("min = -0.1, max = 0.3", -0.1, 0.3),
        ("min = \"40%\", max = \"80%\"", -0.1, 0.3),
        ("min = 0.2", 0.2, R),
        ("max = 0", -R, 0.0),
    ] {
        let wedge = format!("wedge = {{ axis = \"z\", from_deg = 7, to_deg = 367, {ends} }}");
        let scene = folder.scene(&of_shape(BALL, [5, 0, 0], HEIGHT, &wedge));
        let expected = whole - (below(high) - below(low));
        let found = covered(&scene);
        assert!(
            (found - expected).abs() < 2.0 * TOLERANCE,
            "{ends}: {found} instead of {expected}"
        );
    }
}

#[test]
fn an_offset_moves_every_face_towards_what_is_removed() {
    let folder = Scratch::new("offset");
    // The part of a disc of a radius beyond a line at a distance from its middle.
    let segment = |radius: f64, d: f64| {
        radius * radius * (d / radius).acos() - d * (radius * radius - d * d).sqrt()
    };
    let diagonal = 3.0_f64.sqrt();
    for (offset, keeps) in [
        ("{ solid = 0.1 }", 0.1),
        ("{ \"so*\" = 0.2 }", 0.2),
        ("{ \"*\" = 0.3, solid = -0.1 }", -0.1),
        ("{ solid = \"5%\" }", diagonal * 0.05),
        ("{ solid = 0 }", 0.0),
    ] {
        let cut =
            format!("wedge = {{ axis = \"z\", from_deg = 0, to_deg = 90 }}\noffset = {offset}");
        let scene = folder.scene(&of_shape(BALL, [0, 5, 0], HEIGHT, &cut));
        // The face lies at y = offset and begins at x = offset.
        let radius = (R * R - keeps * keeps).sqrt();
        let expected = segment(radius, keeps);
        let found = caps(&scene);
        assert!(
            (found - expected).abs() < 2.0 * TOLERANCE,
            "{offset}: {found} instead of {expected}"
        );
    }
}
