//! Scenes that users of other programs complained of, rebuilt from simple solids: what leaked, flickered, was filled in or turned over.

use std::sync::Arc;

use cutaway::scene::{ClipSurface, Cut, Mesh, Part, Role, Scene};
use glam::{DAffine3, DVec3};

use super::meshes::{block, joined, moved, shape, turned, with_degenerate, with_needles, without};
use super::{scenes, solids};

/// Toward the kept side: the cap shows to the usual camera.
const SHOWN: DVec3 = DVec3::new(-0.2, -0.3, -1.0);

fn cut(name: &str, mesh: Mesh, at: DVec3) -> Scene {
    scenes::scene(name, mesh, vec![ClipSurface::plane(at, SHOWN)])
}

/// A mesh without the triangles whose corners all pass.
fn without_those(mesh: &Mesh, leaves: impl Fn(&DVec3) -> bool) -> Mesh {
    let mut open = mesh.clone();
    let stays = |t: &[u32; 3]| !t.iter().all(|i| leaves(&mesh.positions[*i as usize]));
    open.triangles.retain(stays);
    open
}

/// A mesh with one edge of every so manieth triangle split, in that triangle alone, at its middle or beside it: by `off` of the way
/// to the third corner.
pub fn with_t_junctions(mesh: &Mesh, every: usize, off: f64) -> Mesh {
    let mut split = mesh.clone();
    for t in (0..mesh.triangles.len()).step_by(every) {
        let [a, b, c] = mesh.triangles[t];
        let [pa, pb, pc] = mesh.corners(t);
        let middle = split.positions.len() as u32;
        split.positions.push(((pa + pb) * 0.5).lerp(pc, off));
        split.triangles[t] = [a, middle, c];
        split.triangles.push([middle, b, c]);
    }
    split
}

/// Case 21: edges split on one side only, where the new vertex rounds off the edge, and where it is beside it.
pub fn t_junctions(_: u32) -> Vec<Scene> {
    let ball = shape("sphere?subdivisions=2");
    [("at the middle", 0.0), ("beside it", 0.03)]
        .map(|(name, off)| cut(name, with_t_junctions(&ball, 3, off), DVec3::ZERO))
        .to_vec()
}

/// A shell with no bottom, a box with T-junctions, and one with a face twice.
pub fn leaking(_: u32) -> Vec<Scene> {
    let cube = shape("cube?divisions=2");
    let mut twice = cube.clone();
    twice.triangles.push(cube.triangles[0]);
    vec![
        cut(
            "no bottom",
            without_those(&cube, |p| p.y < -0.4),
            DVec3::ZERO,
        ),
        cut("T-junctions", with_t_junctions(&cube, 2, 0.02), DVec3::ZERO),
        cut("a face twice", twice, DVec3::ZERO),
    ]
}

/// Sections with many holes.
pub fn holes(_: u32) -> Vec<Scene> {
    [
        "sponge?level=2",
        "gears?flank=2",
        "torus?segments=24&sides=12",
    ]
    .map(|shape| {
        let mut scene = scenes::sectioned(shape, &["-0.1,-0.2,-1@50%,50%,52%"]);
        scene.name = shape.to_owned();
        scene
    })
    .to_vec()
}

/// Copies of one mesh: turned, stretched, mirrored.
fn copies(mesh: &Arc<Mesh>) -> Vec<Part> {
    let placed = [
        DAffine3::from_translation(DVec3::new(-0.7, 0.0, 0.1)),
        DAffine3::from_rotation_x(0.7),
        DAffine3::from_translation(DVec3::new(0.7, 0.1, 0.0))
            * DAffine3::from_scale(DVec3::new(-1.0, 0.6, 1.3)),
        DAffine3::from_translation(DVec3::new(0.1, 0.75, -0.2))
            * DAffine3::from_scale(DVec3::splat(0.4)),
    ];
    let part = |(i, at): (usize, &DAffine3)| {
        let mut part = Part::new(format!("copy {i}"), Mesh::default());
        part.mesh = mesh.clone();
        part.world_from_part = *at;
        part
    };
    placed.iter().enumerate().map(part).collect()
}

/// Copies of one mesh, all cut at once.
pub fn instances(_: u32) -> Vec<Scene> {
    let small = |spec: &str| moved(&shape(spec), DAffine3::from_scale(DVec3::splat(0.55)));
    ["cube", "sphere?subdivisions=2"]
        .map(|spec| {
            let parts = copies(&Arc::new(small(spec)));
            scenes::of_parts(spec, parts, vec![ClipSurface::plane(DVec3::ZERO, SHOWN)])
        })
        .to_vec()
}

/// The same of a mesh that is not closed.
pub fn moved_and_open(_: u32) -> Vec<Scene> {
    let small = DAffine3::from_scale(DVec3::splat(0.55));
    let open = without(&moved(&shape("cube"), small), 0);
    let parts = copies(&Arc::new(open));
    vec![scenes::of_parts(
        "open copies",
        parts,
        vec![ClipSurface::plane(DVec3::ZERO, SHOWN)],
    )]
}

/// A ball that lacks triangles here and there.
pub fn riddled(_: u32) -> Vec<Scene> {
    let mut ball = shape("sphere?subdivisions=2");
    let mut number = 0;
    ball.triangles.retain(|_| {
        number += 1;
        number % 31 != 7
    });
    vec![cut(
        "every 31st triangle missing",
        ball,
        DVec3::new(0.0, 0.05, 0.0),
    )]
}

/// Planes of all directions, each with the half that shows its cap.
pub fn all_directions(_: u32) -> Vec<Scene> {
    let sections = [
        "-x=0.1",
        "-y=0.1",
        "-z=0.1",
        "-1,-1,0@0,0,0",
        "-1,-2,-3@0,0,0.1",
    ];
    let mut all = solids::each("cube", &sections);
    // The other half, seen from behind it.
    for mut scene in solids::each("cube", &["x=0.1", "1,2,3@0,0,0.1"]) {
        scene.camera = scenes::looking(DVec3::new(-1.6, -1.2, -2.0), DVec3::ZERO, 40.0);
        all.push(scene);
    }
    all
}

/// Rooms with doors, cut at half their height.
pub fn rooms(_: u32) -> Vec<Scene> {
    let storey = block(DVec3::new(-0.6, -0.25, -0.5), DVec3::new(0.6, 0.25, 0.5));
    let room = |x: f64, z: f64| {
        turned(&block(
            DVec3::new(x, -0.2, z),
            DVec3::new(x + 0.5, 0.2, z + 0.4),
        ))
    };
    let rooms = [room(-0.55, -0.45), room(0.02, -0.45), room(-0.55, 0.03)];
    let house = joined(&[&[storey], &rooms[..]].concat());
    let plane = ClipSurface::plane(DVec3::Y * 0.03, -DVec3::Y);
    let mut scene = scenes::scene("three rooms", house, vec![plane]);
    scene.camera = scenes::orbit(30.0, 50.0, false);
    vec![scene]
}

/// Caps seen almost along their plane.
pub fn oblique(_: u32) -> Vec<Scene> {
    [0.5_f64, 2.0, 5.0]
        .map(|elevation_deg| {
            let mut scene = scenes::sectioned("torus?segments=24&sides=12", &["-z=0.04"]);
            scene.name = format!("{elevation_deg} degrees");
            let (sin, cos) = elevation_deg.to_radians().sin_cos();
            let from = DVec3::new(0.0, -2.2 * cos, 0.04 + 2.2 * sin);
            scene.camera = scenes::looking(from, DVec3::Z * 0.04, 40.0);
            scene
        })
        .to_vec()
}

/// A face in the plane, and the plane moved by the least that f32 can tell.
pub fn coplanar(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for sign in [1.0, -1.0] {
        for ulps in [-1, 0, 1] {
            let z = f32::from_bits(0.5_f32.to_bits().wrapping_add_signed(ulps));
            let plane = ClipSurface::plane(DVec3::Z * f64::from(z), DVec3::Z * sign);
            all.push(scenes::scene(
                &format!("{ulps:+} ulp, side {sign}"),
                shape("cube?divisions=2"),
                vec![plane],
            ));
        }
    }
    all
}

/// Two boxes that share an edge, or a face, as one mesh.
pub fn touching(_: u32) -> Vec<Scene> {
    let left = block(DVec3::new(-0.5, -0.5, -0.4), DVec3::new(0.0, 0.0, 0.4));
    let across = block(DVec3::ZERO - DVec3::Z * 0.4, DVec3::new(0.5, 0.5, 0.4));
    let beside = block(DVec3::new(0.0, -0.5, -0.4), DVec3::new(0.5, 0.0, 0.4));
    let mut all = Vec::new();
    for (name, other) in [("an edge", across), ("a face", beside)] {
        let mesh = joined(&[left.clone(), other]);
        all.push(cut(name, mesh.clone(), DVec3::ZERO));
        let through = ClipSurface::plane(DVec3::ZERO, DVec3::new(-1.0, -1.0, 0.0));
        all.push(scenes::scene(
            &format!("{name}, through it"),
            mesh,
            vec![through],
        ));
    }
    all
}

/// Two products, part against part, with a gap or none.
fn products(gap: f64) -> Vec<Part> {
    let lower = block(DVec3::new(-0.4, -0.4, -0.5), DVec3::new(0.4, 0.4, 0.0));
    let upper = block(DVec3::new(-0.3, -0.3, gap), DVec3::new(0.3, 0.3, 0.5));
    vec![Part::new("lower", lower), Part::new("upper", upper)]
}

/// Two products cut across, without a gap and with one that is hardly one.
pub fn face_to_face(_: u32) -> Vec<Scene> {
    [("no gap", 0.0), ("a gap of a thousandth", 1e-3)]
        .map(|(name, gap)| {
            let plane = ClipSurface::plane(DVec3::ZERO, DVec3::new(-1.0, -0.2, 0.0));
            scenes::of_parts(name, products(gap), vec![plane])
        })
        .to_vec()
}

/// The plane between them, with the one or the other kept.
pub fn between(_: u32) -> Vec<Scene> {
    [("the lower", -1.0), ("the upper", 1.0)]
        .map(|(name, side)| {
            let plane = ClipSurface::plane(DVec3::ZERO, DVec3::Z * side);
            scenes::of_parts(name, products(0.0), vec![plane])
        })
        .to_vec()
}

/// A corner bitten off by three planes, and the same planes each by itself.
pub fn three_planes(_: u32) -> Vec<Scene> {
    let planes = || {
        [DVec3::X, DVec3::Y, DVec3::Z]
            .map(|n| ClipSurface::plane(n * 0.05, -n))
            .to_vec()
    };
    let bitten = scenes::scene("a corner", shape("cube"), planes());
    let mut apart = bitten.clone();
    apart.name = "three halves".to_owned();
    let each = planes().into_iter().enumerate();
    apart.cuts = each
        .map(|(i, s)| Cut::new(format!("cut {i}"), vec![s]))
        .collect();
    apart.camera = scenes::looking(DVec3::new(1.2, 0.9, 1.6), DVec3::ZERO, 30.0);
    vec![bitten, apart]
}

/// Two planes that meet in a plate with holes.
pub fn corners_and_holes(_: u32) -> Vec<Scene> {
    ["sponge?level=2", "conduit?segments=16&sides=24"]
        .map(|shape| {
            let sections = ["-x=60%", "-0.1,-1,-0.1@50%,55%,50%"];
            let mut scene = scenes::sectioned(shape, &sections);
            scene.name = shape.to_owned();
            scene
        })
        .to_vec()
}

/// Triangles without area, and needles, where the plane passes.
pub fn degenerate_sections(_: u32) -> Vec<Scene> {
    let cube = shape("cube");
    vec![
        cut(
            "no area",
            with_degenerate(&with_degenerate(&cube)),
            DVec3::ZERO,
        ),
        cut(
            "needles",
            with_needles(&with_needles(&cube, 1e-7), 0.5),
            DVec3::ZERO,
        ),
    ]
}

/// Every other triangle turned over: which side is out cannot be known, and by parity need not be.
pub fn mixed_winding(_: u32) -> Vec<Scene> {
    let mut mesh = shape("torus?segments=24&sides=12");
    for triangle in mesh.triangles.iter_mut().step_by(2) {
        triangle.swap(1, 2);
    }
    vec![cut("every other triangle", mesh, DVec3::ZERO)]
}

/// Small solids before much background, whose planes reach across all of it.
pub fn before_the_sky(_: u32) -> Vec<Scene> {
    ["comb?teeth=8", "knot?segments=160&sides=12"]
        .map(|shape| {
            let mut scene = scenes::sectioned(shape, &["-0.2,-0.1,-1@50%,50%,50%"]);
            scene.name = shape.to_owned();
            let (centre, radius) = (scene.bounds().centre(), scene.bounds().radius());
            let from = centre + DVec3::new(0.5, 0.4, 1.0).normalize() * radius * 6.0;
            scene.camera = scenes::looking(from, centre, 30.0);
            scene
        })
        .to_vec()
}

/// A cap with a part before it that is not cut.
pub fn behind_others(_: u32) -> Vec<Scene> {
    let mut ring = Part::new("ring", shape("torus?segments=24&sides=12"));
    ring.role = Role::Interior;
    ring.world_from_part = DAffine3::from_translation(DVec3::new(0.3, 0.2, 0.9));
    let parts = vec![Part::new("solid", shape("cube")), ring];
    vec![scenes::of_parts(
        "a ring before the cap",
        parts,
        vec![ClipSurface::plane(DVec3::ZERO, SHOWN)],
    )]
}

/// One plane, and the same turned over.
pub fn flipped(_: u32) -> Vec<Scene> {
    let plane = ClipSurface::plane(DVec3::new(0.05, 0.0, 0.02), DVec3::new(-0.5, 0.3, -1.0));
    [("plane", plane.clone()), ("flipped", plane.flipped())]
        .map(|(name, plane)| {
            let mut scene = scenes::scene(name, shape("shells?subdivisions=3"), vec![plane]);
            if name == "flipped" {
                scene.camera = scenes::looking(DVec3::new(1.0, -0.6, -2.4), DVec3::ZERO, 30.0);
            }
            scene
        })
        .to_vec()
}

/// A solid that goes on far behind all that is near the eye.
pub fn far_plane(_: u32) -> Vec<Scene> {
    let beam = block(DVec3::new(-1.0, -1.0, -2000.0), DVec3::new(1.0, 1.0, -4.0));
    let plane = || ClipSurface::plane(DVec3::new(0.0, 0.2, -10.0), DVec3::new(0.0, -1.0, -0.02));
    let (from, to) = (DVec3::new(0.4, 1.5, 0.0), DVec3::new(0.0, 0.0, -12.0));
    [
        ("perspective", scenes::looking(from, to, 40.0)),
        ("parallel", scenes::parallel(from, to, 4.0)),
    ]
    .map(|(name, camera)| {
        let mut scene = scenes::scene(name, beam.clone(), vec![plane()]);
        scene.camera = camera;
        scene
    })
    .to_vec()
}
