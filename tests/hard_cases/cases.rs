//! The table: what is hard, and who is expected to manage it.

use cutaway::scene::{Camera, ClipSurface, Cut, Pose, Projection, Scene, Wrap};
use glam::{DVec2, DVec3};

use super::table::{Case, Expected};
use crate::common::numbers::Numbers;
use crate::common::{meshes, scenes};

use Expected::{Band, Exact, Fails, Marked, Share};

/// Decided wrong pixels per boundary pixel that the paper's strategy may have on a mild relief: as in `agree`.
const MILD: Expected = Share(1.0 / 8.0);
/// The same where every texel is a step: the grid of 256 has no vertex at the step.
const ROUGH: Expected = Share(1.0 / 2.0);

/// All cases that are judged by their picture alone.
pub(crate) const CASES: &[Case] = &[
    case(
        1,
        "cube through its middle",
        |_| vec![scenes::sectioned("cube", &["-z=0"])],
        Exact,
        Band,
    ),
    case(
        2,
        "plane in a face",
        planes_in_faces,
        Exact,
        Fails("chi of an interpolated point is rounding where the face lies in the plane"),
    ),
    case(
        3,
        "plane through an edge, a vertex, a diagonal",
        through_edges,
        Exact,
        Band,
    ),
    case(
        4,
        "rays through vertices and edges",
        |px| aligned("cube?divisions=8", px),
        Exact,
        Band,
    ),
    case(
        5,
        "1000 needles meet at a pixel centre",
        |px| aligned("slivers", px),
        Exact,
        Band,
    ),
    case(
        6,
        "needles and triangles without area",
        degenerate,
        Exact,
        Band,
    ),
    case(
        10,
        "eye inside, kept side",
        eye_inside,
        Exact,
        Fails("it has no cap at the near plane"),
    ),
    case(11, "eye in a void", eye_in_void, Exact, Band),
    case(
        12,
        "near plane in the solid",
        near_plane,
        Exact,
        Fails("it has no cap at the near plane"),
    ),
    case(14, "far away, tiny, huge", far_tiny_huge, Exact, Band),
    case(15, "near to far as 1 to 100000", near_and_far, Exact, Band),
    case(
        16,
        "hollow ball, inner sphere either way round",
        hollow,
        Exact,
        Band,
    ),
    case(
        19,
        "every face twice",
        |_| vec![doubled()],
        Exact,
        Fails("peeling loses the second of two faces"),
    ),
    case(
        20,
        "one triangle missing",
        open,
        Marked,
        Fails("a sprite cannot tell that it is open"),
    ),
    case(22, "flat map", flat, Exact, Band),
    case(23, "ramp and saddle", ramp_and_saddle, Exact, MILD),
    case(
        24,
        "rays along N, along U, along the plane",
        along_axes,
        Exact,
        ROUGH,
    ),
    case(25, "rays along texel borders", along_texels, Exact, ROUGH),
    case(26, "rays graze crests", grazing, Exact, ROUGH),
    case(
        28,
        "steps one texel wide, very high",
        plateaus,
        Exact,
        ROUGH,
    ),
    case(29, "wrap modes", wraps, Exact, MILD),
    case(31, "maps of odd sizes", odd_sizes, Exact, ROUGH),
    case(32, "cut almost along a face", tangent, Exact, MILD),
    case(37, "opposite signs", opposite, Exact, MILD),
    case(38, "two crossing surfaces, and, or", crossing, Exact, MILD),
    case(48, "U and V of different lengths", anisotropic, Exact, MILD),
];

const fn case(
    number: u32,
    name: &'static str,
    scenes: fn(u32) -> Vec<Scene>,
    mask: Expected,
    paper: Expected,
) -> Case {
    Case {
        number,
        name,
        scenes,
        mask,
        paper,
    }
}

fn each(shape: &str, sections: &[&str]) -> Vec<Scene> {
    let named = |s: &&str| {
        let mut scene = scenes::sectioned(shape, &[s]);
        scene.name = format!("{shape} cut by {s}");
        scene
    };
    sections.iter().map(named).collect()
}

fn planes_in_faces(_: u32) -> Vec<Scene> {
    each(
        "cube",
        &["z=0.5", "-z=0.5", "z=-0.5", "-z=-0.5", "x=0.5", "-y=0.5"],
    )
}

fn through_edges(_: u32) -> Vec<Scene> {
    let planes = [
        "1,0,1@0.5,0,0.5",
        "-1,0,-1@0.5,0,0.5",
        "1,1,1@0.5,0.5,0.5",
        "-1,-1,-1@0.5,0.5,0.5",
        "-1,0,-1@0,0,0",
        "1,0,-1@0,0,0",
        "-1,1,0@0,0,0",
        "-1,-1,-1@0,0,0",
    ];
    each("cube", &planes)
}

/// Parallel rays down z through vertices: a pixel is 1/32 or 1/128 and its centre on a multiple of it.
pub(crate) fn aligned(shape: &str, px: u32) -> Vec<Scene> {
    let mut all = each(
        shape,
        &["-z=0.1", "z=-10", "-1,0,-1@0,0,0.1", "-1,-0.3,-2@0,0,0"],
    );
    for scene in &mut all {
        scene.camera = centred(DVec3::Z, px);
    }
    all
}

/// Parallel rays against a direction, 2 units of picture, the origin at a pixel centre.
pub(crate) fn centred(towards: DVec3, px: u32) -> Camera {
    let half_pixel = 1.0 / f64::from(px);
    let right = (-towards)
        .cross(DVec3::Y)
        .try_normalize()
        .unwrap_or(DVec3::X);
    let up = right.cross(-towards);
    let shift = (right - up) * half_pixel;
    Camera {
        pose: Pose::Explicit {
            position: towards * 4.0 + shift,
            focal_point: shift,
            view_up: Some(up),
        },
        projection: Projection::Orthographic { height: Some(2.0) },
        ..Camera::default()
    }
}

fn degenerate(_: u32) -> Vec<Scene> {
    let plane = || {
        vec![ClipSurface::plane(
            DVec3::ZERO,
            DVec3::new(-0.2, -0.1, -1.0),
        )]
    };
    vec![
        scenes::scene(
            "no area",
            meshes::with_degenerate(&meshes::shape("cube")),
            plane(),
        ),
        scenes::scene(
            "needles",
            meshes::with_needles(&meshes::shape("cube"), 1e-6),
            plane(),
        ),
        scenes::sectioned("slivers?needles=4000", &["-1,0.2,-1@0,0,0"]),
    ]
}

fn through(mut scene: Scene, name: &str, camera: Camera) -> Scene {
    scene.name = name.to_owned();
    scene.camera = camera;
    scene
}

fn eye_inside(_: u32) -> Vec<Scene> {
    let cube = || scenes::sectioned("cube", &["-z=0.3"]);
    let at = |from: DVec3, to: DVec3| Camera {
        near: Some(0.02),
        ..scenes::looking(from, to, 50.0)
    };
    let (low, high) = (DVec3::new(0.1, 0.05, -0.2), DVec3::new(0.1, 0.1, 0.9));
    let torus = scenes::sectioned("torus?segments=40&sides=20", &["-z=0.05"]);
    vec![
        through(cube(), "away from the cut", at(low, -high)),
        through(cube(), "toward the cut", at(low, high)),
        through(
            cube(),
            "on the removed side",
            at(DVec3::new(0.1, 0.1, 0.45), low),
        ),
        through(
            torus,
            "in the tube",
            at(DVec3::new(0.5, 0.0, 0.0), DVec3::new(-0.5, 0.1, 0.0)),
        ),
    ]
}

fn eye_in_void(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for flip in [0, 1] {
        let shape = format!("shells?subdivisions=3&flip_inner={flip}");
        for (name, to) in [
            ("wall", -DVec3::X),
            ("opening", DVec3::X),
            ("both", DVec3::Z),
        ] {
            let scene = scenes::sectioned(&shape, &["-x=0.2"]);
            let camera = Camera {
                near: Some(0.01),
                ..scenes::looking(DVec3::new(0.02, 0.01, 0.03), to, 70.0)
            };
            all.push(through(scene, name, camera));
        }
    }
    all
}

fn near_plane(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for shape in ["cube", "knot?segments=160&sides=12", "earth?subdivisions=3"] {
        for orthographic in [false, true] {
            let mut scene = scenes::sectioned(shape, &["-1,-0.3,-0.2@60%,50%,50%"]);
            let bounds = scene.bounds();
            let from =
                bounds.centre() + DVec3::new(0.7, 0.9, 2.0).normalize() * bounds.radius() * 3.0;
            let camera = if orthographic {
                scenes::parallel(from, bounds.centre(), bounds.radius() * 2.0)
            } else {
                scenes::looking(from, bounds.centre(), 40.0)
            };
            scene = through(scene, shape, camera);
            scene.camera.near = Some(bounds.radius() * 3.0 - bounds.radius() * 0.15);
            all.push(scene);
        }
    }
    all
}

pub(crate) fn torus_cut() -> Scene {
    scenes::sectioned("torus?segments=40&sides=20", &["-0.3,-1,-0.2@50%,50%,50%"])
}

/// A scene moved and scaled, with its clip-surfaces.
pub(crate) fn placed(scene: &Scene, scale: f64, offset: DVec3) -> Scene {
    let mut placed = scene.clone();
    let map =
        glam::DAffine3::from_translation(offset) * glam::DAffine3::from_scale(DVec3::splat(scale));
    for part in &mut placed.parts {
        part.world_from_part = map * part.world_from_part;
    }
    for surface in placed.cuts.iter_mut().flat_map(|c| &mut c.surfaces) {
        surface.origin = map.transform_point3(surface.origin);
        surface.u *= scale;
        surface.v *= scale;
        surface.scale.z *= scale;
    }
    placed
}

fn far_tiny_huge(_: u32) -> Vec<Scene> {
    let scene = torus_cut();
    [(1.0, 1e6), (1e-6, 0.0), (1e6, 0.0)]
        .map(|(scale, offset)| {
            let mut moved = placed(&scene, scale, DVec3::splat(offset));
            moved.name = format!("scale {scale} offset {offset}");
            moved
        })
        .to_vec()
}

/// A bolt head before the eye and a tower behind it.
pub(crate) fn near_and_far(_: u32) -> Vec<Scene> {
    let small = meshes::block(
        DVec3::new(-0.004, -0.003, -0.012),
        DVec3::new(0.001, 0.003, -0.006),
    );
    let large = meshes::block(
        DVec3::new(-20.0, -30.0, -95.0),
        DVec3::new(30.0, 25.0, -60.0),
    );
    let plane = ClipSurface::plane(DVec3::new(0.0, 0.0, -0.007), DVec3::new(-0.1, -0.9, -0.4));
    let mut scene = scenes::scene(
        "bolt and tower",
        meshes::joined(&[small, large]),
        vec![plane],
    );
    scene.camera = Camera {
        near: Some(1e-3),
        ..scenes::looking(DVec3::ZERO, -DVec3::Z, 60.0)
    };
    vec![scene]
}

fn hollow(_: u32) -> Vec<Scene> {
    let mut all = each(
        "shells?subdivisions=3&flip_inner=0",
        &["-z=0.05", "-1,-1,-1@0,0,0.1"],
    );
    all.extend(each(
        "shells?subdivisions=3&flip_inner=1",
        &["-z=0.05", "-1,-1,-1@0,0,0.1"],
    ));
    all
}

/// A torus with every face twice.
pub(crate) fn doubled() -> Scene {
    let mut scene = torus_cut();
    let mut mesh = meshes::shape("torus?segments=40&sides=20");
    mesh.triangles.extend(mesh.triangles.clone());
    scene.parts[0].mesh = mesh.into();
    scene
}

/// A ball that lacks one triangle in front, or one at the back.
pub(crate) fn open(_: u32) -> Vec<Scene> {
    let ball = meshes::shape("sphere?subdivisions=2");
    let toward = DVec3::new(0.45, 0.35, 0.75);
    let facing = |sign: f64| {
        let along = |t: &usize| {
            ball.corners(*t)
                .iter()
                .map(|p| p.dot(toward) * sign)
                .sum::<f64>()
        };
        let triangles = 0..ball.triangles.len();
        triangles
            .max_by(|a, b| along(a).total_cmp(&along(b)))
            .expect("triangles")
    };
    [("front", facing(1.0)), ("back", facing(-1.0))]
        .map(|(name, triangle)| {
            let plane = ClipSurface::plane(DVec3::new(0.0, 0.2, 0.0), DVec3::new(-0.2, -1.0, -0.1));
            scenes::scene(name, meshes::without(&ball, triangle), vec![plane])
        })
        .to_vec()
}

fn ball() -> cutaway::scene::Mesh {
    meshes::shape("sphere?subdivisions=3")
}

/// Toward the kept side: the cap shows to the usual camera.
const TILTED: DVec3 = DVec3::new(-0.3, -0.5, -1.0);

pub(crate) fn flat(_: u32) -> Vec<Scene> {
    [(0.0, 0.5), (0.25, 0.5), (1.0, -0.125), (-0.5, 0.25)]
        .map(|(height, scale)| {
            let map = scenes::map([3, 5], |_, _| height);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, map, (0.5, scale), Wrap::Repeat);
            scenes::scene(
                &format!("height {height} times {scale}"),
                ball(),
                vec![surface],
            )
        })
        .to_vec()
}

pub(crate) fn ramp_and_saddle(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for (name, texels) in [
        ("ramp", [0.0, 1.0, 0.0, 1.0]),
        ("saddle", [0.0, 1.0, 1.0, 0.0]),
    ] {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            let map = scenes::map([2, 2], |x, y| texels[(2 * y + x) as usize] - 0.5);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, map, (1.6, 0.4), wrap);
            let scene = scenes::scene(name, ball(), vec![surface.clone()]);
            // Edge-on: along U, and along the diagonal on which a saddle is straight.
            for towards in [surface.u, surface.u + surface.v] {
                let from = towards.normalize() * 3.0;
                all.push(through(
                    scene.clone(),
                    name,
                    scenes::parallel(from, DVec3::ZERO, 1.2),
                ));
            }
            all.push(scene);
        }
    }
    all
}

fn noise(size: [u32; 2], seed: u64) -> cutaway::scene::OffsetMap {
    let mut numbers = Numbers(seed);
    let texels: Vec<f32> = (0..size[0] * size[1])
        .map(|_| (numbers.unit() - 0.5) as f32)
        .collect();
    scenes::map(size, |x, y| texels[(y * size[0] + x) as usize])
}

/// A relief that lies flat on `z = 0`, with its texel centres on multiples of 1/8.
fn bumpy_floor(size: [u32; 2]) -> ClipSurface {
    let mut surface = scenes::mapped(
        DVec3::ZERO,
        DVec3::Z,
        noise(size, 5),
        (1.0, 0.3),
        Wrap::Repeat,
    );
    surface.u = DVec3::X;
    surface.v = DVec3::Y;
    surface.origin = DVec3::new(-0.5 - 0.0625, -0.5 - 0.0625, 0.0);
    surface
}

fn along_axes(px: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for normal in [DVec3::Z, -DVec3::Z] {
        let surface = scenes::mapped(
            DVec3::ZERO,
            normal,
            noise([8, 8], 3),
            (0.7, 0.3),
            Wrap::Repeat,
        );
        let scene = scenes::scene("axes", ball(), vec![surface.clone()]);
        for towards in [
            DVec3::Z,
            -DVec3::Z,
            surface.u,
            surface.v,
            -surface.u,
            surface.u + surface.v,
        ] {
            let towards = towards.normalize();
            let eye = scenes::looking(towards * 2.0, DVec3::ZERO, 40.0);
            all.push(through(
                scene.clone(),
                &format!("{normal} along {towards}"),
                centred(towards, px),
            ));
            all.push(through(
                scene.clone(),
                &format!("{normal} from {towards}"),
                eye,
            ));
        }
    }
    all
}

fn along_texels(px: u32) -> Vec<Scene> {
    let scene = scenes::scene("texels", ball(), vec![bumpy_floor([8, 8])]);
    [
        DVec3::X,
        DVec3::Y,
        -DVec3::X,
        DVec3::Z,
        DVec3::new(1.0, 1.0, 0.0).normalize(),
    ]
    .map(|towards| {
        through(
            scene.clone(),
            &format!("along {towards}"),
            centred(towards, px),
        )
    })
    .to_vec()
}

/// Ridges whose crests are exactly at the height of a row of samples.
fn grazing(px: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for height in [0.25, 0.25 + 1e-7, 0.25 - 1e-7] {
        let ridges = scenes::map([8, 4], |x, y| {
            if x % 2 == 0 {
                f32::from(y as u8 % 2)
            } else {
                0.0
            }
        });
        let mut surface =
            scenes::mapped(DVec3::ZERO, DVec3::Z, ridges, (1.0, height), Wrap::Repeat);
        surface.u = DVec3::X;
        surface.v = DVec3::Y;
        let scene = scenes::scene("crests", ball(), vec![surface.clone(), surface.flipped()]);
        for cuts in [vec![surface.clone()], vec![surface.flipped()]] {
            let mut one = scene.clone();
            one.cuts = vec![Cut::of("cut", cuts)];
            for towards in [DVec3::X, DVec3::Y] {
                let name = format!("height {height} along {towards}");
                all.push(through(one.clone(), &name, centred(towards, px)));
            }
        }
    }
    all
}

fn plateaus(_: u32) -> Vec<Scene> {
    [0.2, 2.0]
        .map(|height| {
            let checker = scenes::map([16, 16], |x, y| f32::from((x / 4 + y / 4) as u8 % 2) - 0.5);
            let surface = scenes::mapped(DVec3::ZERO, TILTED, checker, (0.9, height), Wrap::Repeat);
            scenes::scene(&format!("{height} high"), ball(), vec![surface])
        })
        .to_vec()
}

fn wraps(_: u32) -> Vec<Scene> {
    [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp]
        .map(|wrap| {
            let surface = scenes::mapped(DVec3::ZERO, TILTED, noise([6, 6], 11), (0.6, 0.2), wrap);
            scenes::scene(&format!("{wrap:?}"), ball(), vec![surface])
        })
        .to_vec()
}

fn odd_sizes(_: u32) -> Vec<Scene> {
    [[1, 1], [1, 9], [9, 1], [13, 7], [2, 2], [255, 3]]
        .map(|size| {
            let surface = scenes::mapped(
                DVec3::ZERO,
                TILTED,
                noise(size, 17),
                (0.8, 0.2),
                Wrap::Mirror,
            );
            scenes::scene(&format!("{size:?}"), ball(), vec![surface])
        })
        .to_vec()
}

/// A cut that leaves the top of a slab at an angle of a tenth, or a hundredth, of a degree, with a relief as low.
pub(crate) fn tangent(_: u32) -> Vec<Scene> {
    [0.1_f64, 0.01]
        .map(|angle_deg| {
            let slope = angle_deg.to_radians().tan();
            let normal = DVec3::new(slope, -1.0, 0.5 * slope);
            let low = scenes::mapped(
                DVec3::new(0.0, 0.25, 0.0),
                normal,
                noise([32, 32], 23),
                (0.9, slope),
                Wrap::Repeat,
            );
            let slab = meshes::block(DVec3::new(-0.5, -0.25, -0.5), DVec3::new(0.5, 0.25, 0.5));
            scenes::scene(&format!("{angle_deg} degrees"), slab, vec![low])
        })
        .to_vec()
}

pub(crate) fn opposite(_: u32) -> Vec<Scene> {
    let surface = scenes::mapped(
        DVec3::ZERO,
        TILTED,
        noise([12, 12], 29),
        (0.9, 0.3),
        Wrap::Repeat,
    );
    let torus = || meshes::shape("torus?segments=40&sides=20");
    vec![
        scenes::scene("kept", torus(), vec![surface.clone()]),
        scenes::scene("removed", torus(), vec![surface.flipped()]),
    ]
}

/// A relief and a plane that cross in the picture.
pub(crate) fn crossing(_: u32) -> Vec<Scene> {
    let rough = scenes::mapped(
        DVec3::ZERO,
        TILTED,
        noise([12, 12], 31),
        (0.9, 0.2),
        Wrap::Mirror,
    );
    let plane = ClipSurface::plane(DVec3::new(0.05, 0.0, 0.0), DVec3::new(-1.0, 0.2, -0.4));
    let both = scenes::scene("and", ball(), vec![rough.clone(), plane.clone()]);
    let mut either = both.clone();
    either.name = "or".to_owned();
    either.cuts = vec![Cut::of("one", vec![rough]), Cut::of("two", vec![plane])];
    vec![both, either]
}

pub(crate) fn anisotropic(_: u32) -> Vec<Scene> {
    [(1.0, 1.0), (2.5, -0.7)]
        .map(|(sx, sy)| {
            let mut surface = scenes::mapped(
                DVec3::ZERO,
                TILTED,
                noise([9, 14], 37),
                (1.0, 0.25),
                Wrap::Repeat,
            );
            surface.v *= 0.35;
            surface.scale = DVec2::new(sx, sy).extend(surface.scale.z);
            scenes::scene(&format!("scale {sx}, {sy}"), ball(), vec![surface])
        })
        .to_vec()
}
