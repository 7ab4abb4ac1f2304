//! Scenes of the table whose mesh, plane or camera is what is hard.

use cutaway::scene::{Camera, ClipSurface, Projection, Scene, Viewpoint};
use glam::DVec3;

use super::{meshes, scenes};

/// A shape cut by each of some sections.
pub fn each(shape: &str, sections: &[&str]) -> Vec<Scene> {
    let named = |s: &&str| {
        let mut scene = scenes::sectioned(shape, &[s]);
        scene.name = format!("{shape} cut by {s}");
        scene
    };
    sections.iter().map(named).collect()
}

/// Case 2: planes in faces of a cube.
pub fn planes_in_faces(_: u32) -> Vec<Scene> {
    each(
        "cube",
        &["z=0.5", "-z=0.5", "z=-0.5", "-z=-0.5", "x=0.5", "-y=0.5"],
    )
}

/// Case 3: planes through edges, vertices and diagonals of a cube.
pub fn through_edges(_: u32) -> Vec<Scene> {
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
pub fn aligned(shape: &str, px: u32) -> Vec<Scene> {
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
pub fn centred(towards: DVec3, px: u32) -> Camera {
    let half_pixel = 1.0 / f64::from(px);
    let right = (-towards)
        .cross(DVec3::Y)
        .try_normalize()
        .unwrap_or(DVec3::X);
    let up = right.cross(-towards);
    let shift = (right - up) * half_pixel;
    Camera {
        viewpoint: Viewpoint::Explicit {
            position: towards * 4.0 + shift,
            focal_point: shift,
            view_up: Some(up),
        },
        projection: Projection::Orthographic { height: Some(2.0) },
        ..Camera::default()
    }
}

/// Case 6: triangles without area, and needles.
pub fn degenerate(_: u32) -> Vec<Scene> {
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

/// A scene by another name, through another camera.
pub fn through(mut scene: Scene, name: &str, camera: Camera) -> Scene {
    scene.name = name.to_owned();
    scene.camera = camera;
    scene
}

/// Case 10: eyes in the solid.
pub fn eye_inside(_: u32) -> Vec<Scene> {
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

/// Case 11: eyes in a void in the solid.
pub fn eye_in_void(_: u32) -> Vec<Scene> {
    let mut all = Vec::new();
    for flip in [0, 1] {
        let shape = format!("shells?subdivisions=3&flip_inner={flip}");
        for (name, section, to) in [
            ("wall", "-x=0.2", -DVec3::X),
            ("opening", "-x=0.2", DVec3::X),
            ("both", "-x=0.2", DVec3::Z),
            // The eye is on the removed side, and sees the ring that the cut leaves.
            ("ring", "x=0.28", DVec3::X),
        ] {
            let scene = scenes::sectioned(&shape, &[section]);
            let camera = Camera {
                near: Some(0.01),
                ..scenes::looking(DVec3::new(0.02, 0.01, 0.03), to, 70.0)
            };
            all.push(through(scene, name, camera));
        }
    }
    all
}

/// Case 12: near planes that cut the solid.
pub fn near_plane(_: u32) -> Vec<Scene> {
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

/// A torus cut by an oblique plane.
pub fn torus_cut() -> Scene {
    scenes::sectioned("torus?segments=40&sides=20", &["-0.3,-1,-0.2@50%,50%,50%"])
}

/// A scene moved and scaled, with its clip-surfaces.
pub fn placed(scene: &Scene, scale: f64, offset: DVec3) -> Scene {
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

/// Case 14: a scene far from the origin, tiny, huge.
pub fn far_tiny_huge(_: u32) -> Vec<Scene> {
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
pub fn near_and_far(_: u32) -> Vec<Scene> {
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

/// Case 16: a hollow ball, its inner sphere either way round.
pub fn hollow(_: u32) -> Vec<Scene> {
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

/// Case 17: two balls in one mesh.
pub fn overlapping(_: u32) -> Vec<Scene> {
    let ball = meshes::shape("sphere?subdivisions=3");
    let moved = |x: f64| meshes::moved(&ball, glam::DAffine3::from_translation(DVec3::X * x));
    let both = meshes::joined(&[moved(-0.2), moved(0.2)]);
    ["-z=0.05", "-0.2,-1,-0.3@0,0.1,0"]
        .map(|section| {
            let mut scene = scenes::scene(section, both.clone(), Vec::new());
            let plane = ClipSurface::parse(section, &scene.bounds()).expect(section);
            scene.cuts = vec![cutaway::scene::Cut::new("cut", vec![plane])];
            scene
        })
        .to_vec()
}

/// A torus with every face twice.
pub fn doubled() -> Scene {
    let mut scene = torus_cut();
    let mut mesh = meshes::shape("torus?segments=40&sides=20");
    mesh.triangles.extend(mesh.triangles.clone());
    scene.parts[0].mesh = mesh.into();
    scene
}

/// A ball that lacks one triangle in front, or one at the back.
pub fn open(_: u32) -> Vec<Scene> {
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
