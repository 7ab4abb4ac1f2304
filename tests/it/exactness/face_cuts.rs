//! Promise: cuts along faces, and just beside them, are exact in every view, by every exact strategy and both rasterisers
//! (hard cases 2 and 51), and a cut leaves nothing without thickness.

mod removed;
mod turned;

use crate::common;

use std::collections::BTreeMap;

use common::meshes::{self, block};
use common::numbers::Numbers;
use common::real::files;
use common::scenes::{looking, of_parts, sectioned};
use common::{Question, is_long};
use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Mesh, Part, Scene};
use cutaway::slice::{SlicePlane, Slicer};
use cutaway::strategies::{Method, Unsupported};
use cutaway_io::load::load_mesh_file;
use cutaway_lab::hard_cases::Judged;
use glam::DVec3;

/// Every strategy that is exact for planes, by both rasterisers where there are two.
const EXACT: [&str; 8] = [
    "raycast+mask",
    "raycast+stencil",
    "raycast+abuffer",
    "stencil",
    "planar",
    "raycast+mask@compute",
    "raycast+abuffer@compute",
    "planar@compute",
];

/// How many views are looked at: a quarter of all, unless tests run whole.
fn views(all: usize) -> usize {
    if is_long() { all } else { all / 4 }
}

/// What is wrong with the answers of the exact strategies.
fn faults(question: &Question, what: &str) -> Vec<String> {
    faults_and(question, what, |_| None)
}

/// The same, and what else is wrong with an answer that was drawn.
fn faults_and(
    question: &Question,
    what: &str,
    also: impl Fn(&Judged) -> Option<String>,
) -> Vec<String> {
    let mut all = Vec::new();
    for method in EXACT.map(|name| name.parse::<Method>().expect("a strategy")) {
        let judged: Judged = question.answer(method);
        // A near plane in the solid, which grazing views may have, is not what is asked about.
        let is_refused = matches!(&judged.outcome, cutaway::session::Outcome::Refused(r) if r.unsupported == Unsupported::NearPlane);
        let wrong = judged.comparison.decided_wrong_px;
        let fault = (wrong > 0 && !is_refused).then(|| judged.fault_of_exact().unwrap_or_default());
        let is_drawn = !matches!(&judged.outcome, cutaway::session::Outcome::Refused(_));
        let other = is_drawn.then(|| also(&judged)).flatten();
        let found = fault.into_iter().chain(other);
        all.extend(found.map(|fault| format!("{what}: {method}: {fault}")));
    }
    all
}

/// A view that runs along a plane: the eye is a little off it.
fn grazing(random: &mut Numbers, plane: &ClipSurface, at: DVec3, radius: f64) -> Camera {
    let frame = plane.frame();
    let turn = random.between(0.0, std::f64::consts::TAU);
    let along = frame.u_hat * turn.cos() + frame.v_hat * turn.sin();
    let off = random.between(-0.2, 0.2) * random.between(0.05, 1.0);
    let eye = at + (along + frame.normal * off) * radius * random.between(2.0, 4.0);
    looking(
        eye,
        at + frame.normal * radius * random.between(-0.1, 0.1),
        30.0,
    )
}

/// The planes of the largest flat faces of a mesh, in order of area: each as a point and the direction out of the solid.
fn largest_faces(mesh: &Mesh, most: usize) -> Vec<(DVec3, DVec3)> {
    let mut areas: BTreeMap<[i64; 4], (f64, DVec3, DVec3)> = BTreeMap::new();
    let radius = mesh.bounds().radius();
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t);
        let cross = (b - a).cross(c - a);
        let (area, normal) = (cross.length(), cross.normalize_or_zero());
        let key = [normal.x, normal.y, normal.z, normal.dot(a) / radius];
        let entry = areas
            .entry(key.map(|k| (k * 1e4).round() as i64))
            .or_insert((0.0, a, normal));
        entry.0 += area;
    }
    let mut faces: Vec<_> = areas.into_values().collect();
    faces.sort_by(|a, b| b.0.total_cmp(&a.0));
    faces.truncate(most);
    faces
        .into_iter()
        .map(|(_, at, normal)| (at, normal))
        .collect()
}

/// Both sides of a plane through a face.
fn cuts(scene: &Scene, (at, normal): (DVec3, DVec3)) -> [(ClipSurface, Scene); 2] {
    [normal, -normal].map(|n| {
        let surface = ClipSurface::plane(at, n);
        let cut = of_parts(&scene.name, scene.parts.clone(), vec![surface.clone()]);
        (surface, cut)
    })
}

#[test]
fn real_parts_cut_along_their_largest_faces() {
    let mut random = Numbers(7);
    let (mut all, mut frames) = (Vec::new(), 0);
    for file in files(&["cad"]) {
        let scene = Scene {
            name: file.display().to_string(),
            parts: load_mesh_file(&file).expect("a mesh").parts,
            ..Scene::default()
        };
        let faces: Vec<_> = (scene.parts.iter())
            .flat_map(|p| largest_faces(&p.mesh, 2))
            .collect();
        let bounds = scene.bounds();
        for face in faces.into_iter().take(2) {
            for (surface, scene) in cuts(&scene, face) {
                let views = (0..views(28) / 4).map(|view| match view {
                    0 => scene.camera,
                    _ => grazing(
                        &mut random,
                        &surface,
                        bounds.centre()
                            - surface.frame().normal
                                * (bounds.centre() - face.0).dot(surface.frame().normal),
                        bounds.radius(),
                    ),
                });
                for (view, camera) in views.collect::<Vec<_>>().into_iter().enumerate() {
                    let what = format!(
                        "{}, {:?}, view {view}, {:?}",
                        scene.name,
                        surface.frame().normal,
                        camera.viewpoint
                    );
                    let question = Question::through(&scene, &camera, [200, 150]);
                    all.extend(faults(&question, &what));
                    frames += 1;
                }
            }
        }
    }
    assert!(
        all.is_empty(),
        "{} of {frames}:\n{}",
        all.len(),
        all.join("\n")
    );
}

#[test]
fn shapes_cut_along_their_faces_from_anywhere() {
    let mut random = Numbers(11);
    let mut all = Vec::new();
    for view in 0..views(200) {
        let shape = ["cube", "sponge", "crank"][view % 3];
        let parts = meshes::parts(shape);
        let faces = largest_faces(&parts[0].mesh, 6);
        let face = faces[view / 3 % faces.len()];
        let scene = of_parts(shape, parts, Vec::new());
        let (surface, scene) = cuts(&scene, face)[view % 2].clone();
        let bounds = scene.bounds();
        let camera = if view % 5 == 0 {
            grazing(&mut random, &surface, face.0, bounds.radius())
        } else {
            let towards = DVec3::from_array([(); 3].map(|()| random.between(-1.0, 1.0)));
            let eye = bounds.centre() + towards.normalize() * bounds.radius() * 3.0;
            looking(eye, bounds.centre(), 40.0)
        };
        let question = Question::through(&scene, &camera, [128, 96]);
        all.extend(faults(&question, &format!("{shape}, view {view}")));
    }
    assert!(all.is_empty(), "{}:\n{}", all.len(), all.join("\n"));
}

#[test]
fn planes_just_beside_a_face() {
    let mut random = Numbers(13);
    let mut all = Vec::new();
    for (number, off) in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5].into_iter().enumerate() {
        for way in [1.0, -1.0] {
            for shape in ["cube", "sponge", "crank"] {
                let parts = meshes::parts(shape);
                let (at, normal) = largest_faces(&parts[0].mesh, 3)[number % 3];
                let size = parts[0].mesh.bounds().size().length();
                let scene = of_parts(shape, parts, Vec::new());
                for (surface, scene) in cuts(&scene, (at + normal * size * off * way, normal)) {
                    for camera in [scene.camera, grazing(&mut random, &surface, at, size / 2.0)] {
                        let question = Question::through(&scene, &camera, [128, 96]);
                        let what = format!("{shape} {off:e} {way} {:?}", surface.frame().normal);
                        all.extend(faults(&question, &what));
                    }
                }
            }
        }
    }
    assert!(all.is_empty(), "{}:\n{}", all.len(), all.join("\n"));
}

/// Pixels of surface and cap of the truth, after every exact strategy that draws the scene has been found to agree.
fn shown(scene: &Scene) -> [usize; 2] {
    let question = Question::new(scene, [96, 96]);
    let faults = faults(&question, &scene.name);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    let layers = &question.exact.layers;
    [layers.count(Kind::Surface), layers.count(Kind::Cap)]
}

#[test]
fn a_cut_leaves_nothing_without_thickness() {
    // A plane in a face shows what lies on its kept side, as surface; on the other side there is nothing, and no section.
    for (section, is_shown) in [
        ("z=0%", true),
        ("-z=0%", false),
        ("z=100%", false),
        ("-z=100%", true),
    ] {
        let scene = sectioned("cube", &[section]);
        let [surface, cap] = shown(&scene);
        assert_eq!((surface > 0, cap), (is_shown, 0), "{section}");
        let cut = ClipSurface::parse(section, &scene.bounds()).expect("a section");
        let mesh = &scene.parts[0].mesh;
        let slicer = Slicer::new(mesh.positions.clone(), &mesh.triangles);
        let area = slicer.section(&SlicePlane::from(&cut)).area();
        assert!(
            (area - f64::from(u8::from(is_shown))).abs() < 1e-12,
            "{section}: {area}"
        );
    }
    // A box to the corner, and a pocket flush with the top: no lid where the cut ends in a face.
    let cube = || meshes::parts("cube");
    let [whole, _] = shown(&of_parts("whole", cube(), Vec::new()));
    for (name, low, high) in [
        ("corner", DVec3::ZERO, DVec3::splat(0.5)),
        (
            "pocket",
            DVec3::new(-0.2, 0.1, -0.2),
            DVec3::new(0.2, 0.5, 0.2),
        ),
    ] {
        let planes: Vec<ClipSurface> = (DVec3::AXES.into_iter())
            .flat_map(|axis| [(low, -axis), (high, axis)])
            .map(|(at, out)| ClipSurface::plane(at, out))
            .collect();
        let [surface, cap] = shown(&of_parts(name, cube(), planes));
        assert!(
            cap > 100 && surface + cap <= whole,
            "{name}: {surface} surface, {cap} cap, {whole} uncut"
        );
    }
    // What touches a plane from both sides: the product on the kept side stays, the other goes.
    let joined = meshes::joined(&[
        block(DVec3::splat(-0.5), DVec3::new(0.5, 0.5, 0.0)),
        block(DVec3::new(-0.3, -0.3, 0.0), DVec3::new(0.3, 0.3, 0.5)),
    ]);
    for normal in [DVec3::Z, -DVec3::Z] {
        let scene = common::scenes::scene(
            "touching",
            joined.clone(),
            vec![ClipSurface::plane(DVec3::ZERO, normal)],
        );
        let [surface, _] = shown(&scene);
        assert!(surface > 0, "{normal}");
    }
}
