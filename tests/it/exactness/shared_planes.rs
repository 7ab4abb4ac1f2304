//! Promise: where faces of several parts lie in one plane and face the same way, the part with the priority is shown, then the smaller
//! solid, by every exact strategy and both rasterisers; and the reference is sure of it.

use crate::common;

use std::f64::consts::TAU;

use common::Question;
use common::meshes::block;
use common::numbers::Numbers;
use common::scenes::{looking, of_parts};
use cutaway::Model;
use cutaway::layers::Kind;
use cutaway::scene::{Camera, ClipSurface, Mesh, Part, Scene};
use cutaway::strategies::Method;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// What draws planes exactly by hardware; each is judged by the sub-pixel bits of the adapter.
const HARDWARE: [&str; 5] = [
    "raycast+mask",
    "raycast+stencil",
    "raycast+abuffer",
    "stencil",
    "planar",
];
const COMPUTE: [&str; 3] = [
    "raycast+mask@compute",
    "raycast+abuffer@compute",
    "planar@compute",
];

const SIZE: [u32; 2] = [240, 180];

/// A cylinder of a few flat sides about z, of radius 1/2, between -1/2 and 1/2.
fn cylinder(sides: u32) -> Mesh {
    let ring = |z: f64| {
        (0..sides).map(move |i| {
            let angle = TAU * f64::from(i) / f64::from(sides);
            DVec3::new(0.5 * angle.cos(), 0.5 * angle.sin(), z)
        })
    };
    let middles = [DVec3::Z * -0.5, DVec3::Z * 0.5];
    let (low, high) = (2 * sides, 2 * sides + 1);
    let triangles = (0..sides).flat_map(|i| {
        let next = (i + 1) % sides;
        [
            [i, next, sides + next],
            [i, sides + next, sides + i],
            [low, next, i],
            [high, sides + i, sides + next],
        ]
    });
    Mesh {
        positions: ring(-0.5).chain(ring(0.5)).chain(middles).collect(),
        triangles: triangles.collect(),
        corner_normals: None,
        vertex_paint: None,
    }
}

/// A part of a shape between -1/2 and 1/2: moved, then turned with all others.
fn part(name: &str, mesh: Mesh, priority: i32, placed: DAffine3) -> Part {
    Part {
        priority: Some(priority),
        world_from_part: placed,
        ..Part::new(name, mesh)
    }
}

fn unit_block() -> Mesh {
    block(DVec3::splat(-0.5), DVec3::splat(0.5))
}

/// Draws an assembly by all methods; what is wrong, and how many pixels are undecided and covered.
fn judged(scene: &Scene, camera: &Camera, drawn: Option<Model>) -> (Vec<String>, [usize; 2]) {
    let mut question = Question::through(scene, camera, SIZE);
    if let Some(drawn) = drawn {
        question.model = drawn;
    }
    let faults = HARDWARE.iter().chain(&COMPUTE).filter_map(|name| {
        let judged = question.answer(name.parse::<Method>().expect("a strategy"));
        let is_wrong = judged.comparison.decided_wrong_px > 0;
        is_wrong.then(|| {
            let found = judged.fault_of_exact().unwrap_or_default();
            format!("{}: {name}: {found}", scene.name)
        })
    });
    let faults = faults.collect();
    let exact = &question.exact;
    (faults, [exact.undecided_px(), exact.covered_px()])
}

/// A pin in a plate, flush with its top.
fn flush(priority: i32) -> (Scene, Camera) {
    let plate = part(
        "plate",
        unit_block(),
        0,
        DAffine3::from_scale(DVec3::new(2.0, 1.0, 2.0)),
    );
    let turned = DAffine3::from_scale_rotation_translation(
        DVec3::new(0.7, 1.0, 0.7),
        DQuat::from_rotation_y(20_f64.to_radians()),
        DVec3::new(0.1, 0.0, 0.1),
    );
    let pin = part("pin", unit_block(), priority, turned);
    let cut = ClipSurface::plane(DVec3::Z * 0.4, DVec3::NEG_Z);
    let scene = of_parts("flush", vec![plate, pin], vec![cut]);
    let camera = looking(
        DVec3::new(0.39, -1.91, 0.7),
        DVec3::new(-0.16, 0.31, 0.85),
        55.0,
    );
    (scene, camera)
}

fn must_be_right((faults, [undecided, covered]): (Vec<String>, [usize; 2])) {
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(
        undecided * 1000 < covered,
        "{undecided} of {covered} px are undecided"
    );
}

#[test]
fn a_pin_flush_with_a_plate_is_shown_by_priority() {
    for priority in [1, -1] {
        let (scene, camera) = flush(priority);
        must_be_right(judged(&scene, &camera, None));
        let exact = Question::through(&scene, &camera, SIZE).exact;
        let pins = exact.layers.pixels.iter();
        let shown = pins
            .filter(|l| l.kind == Kind::Surface && l.part == 1)
            .count();
        assert_eq!(shown > 500, priority > 0, "{shown} px of the pin's face");
    }
}

#[test]
fn a_pin_that_a_cut_gives_back_is_shown_by_priority() {
    let (scene, camera) = flush(1);
    let mut before = scene.clone();
    before.cuts[0].surfaces[0].origin.z = -0.6;
    let without = Model::new(&before);
    let mut parts = without.prepared.parts.iter();
    assert!(parts.any(|p| p.is_removed), "the cut leaves something");
    must_be_right(judged(&scene, &camera, Some(without.updated(&scene))));
}

#[test]
fn boxes_that_share_sides_are_shown_by_priority() {
    let at = |name: &str, z: f64, priority: i32| {
        part(
            name,
            unit_block(),
            priority,
            DAffine3::from_translation(DVec3::Z * z),
        )
    };
    let boxes = vec![at("p0", 0.0, 0), at("p1", 1.0, -1), at("p2", 0.5, -2)];
    let cut = ClipSurface::plane(DVec3::new(0.2, 0.1, 0.3), DVec3::new(-1.0, -0.4, 0.2));
    for cuts in [vec![cut], Vec::new()] {
        let scene = of_parts("touching", boxes.clone(), cuts);
        let camera = looking(DVec3::new(2.5, 1.7, 2.2), DVec3::Z * 0.5, 40.0);
        must_be_right(judged(&scene, &camera, None));
    }
}

#[test]
fn the_check_finds_a_pin_that_is_drawn_with_another_priority() {
    let (scene, camera) = flush(1);
    let (other, _) = flush(-1);
    let (faults, _) = judged(&scene, &camera, Some(Model::new(&other)));
    assert!(faults.len() >= COMPUTE.len(), "{}", faults.join("\n"));
}

/// An assembly of two or three boxes and cylinders, in one of the ways that parts meet.
fn assembly(random: &mut Numbers, number: usize) -> (Scene, Camera) {
    let turn = DMat3::from_quat(
        DQuat::from_rotation_z(random.between(0.0, TAU))
            * DQuat::from_rotation_x(random.between(0.0, TAU))
            * DQuat::from_rotation_y(random.between(0.0, TAU)),
    );
    let away = DVec3::new(1.0, 1.0, 1.0).map(|_| random.between(-3.0, 3.0));
    let turned = DAffine3::from_mat3_translation(turn, away);
    let mut shape = |name: &str, size: DVec3, at: DVec3, spin: f64| {
        let mesh = match random.between(0.0, 1.0) < 0.5 {
            true => unit_block(),
            false => cylinder(5 + (random.between(0.0, 12.0) as u32)),
        };
        let spin = DQuat::from_rotation_z(spin);
        let own = DAffine3::from_scale_rotation_translation(size, spin, at);
        part(name, mesh, random.between(-2.0, 3.0) as i32, turned * own)
    };
    let base = DVec3::new(2.0, 2.0, 1.0);
    let lower = shape("lower", base, DVec3::ZERO, 0.0);
    let small = DVec3::new(0.9, 0.7, 0.6);
    let way = [
        "flush",
        "touching",
        "nested",
        "interpenetrating",
        "through",
        "same",
    ][number % 6];
    let (size, at) = match way {
        // The tops are in one plane.
        "flush" => (small, DVec3::new(0.1, 0.2, 0.2)),
        // Stands on the other.
        "touching" => (small, DVec3::new(0.1, 0.2, 0.8)),
        "nested" => (small, DVec3::new(0.1, -0.1, 0.05)),
        "interpenetrating" => (small, DVec3::new(0.3, 0.1, 0.45)),
        // Both ends are flush.
        "through" => (DVec3::new(0.9, 0.7, 1.0), DVec3::new(-0.1, 0.1, 0.0)),
        _ => (base, DVec3::new(0.0, 0.0, 0.5)),
    };
    let spin = match way {
        "same" => 0.0,
        _ => 0.3,
    };
    let mut parts = vec![lower, shape("upper", size, at, spin)];
    if number.is_multiple_of(4) {
        parts.push(shape(
            "third",
            size * 0.8,
            at + DVec3::Z * 0.1 * size.z,
            0.0,
        ));
    }
    let mut direction = || DVec3::ZERO.map(|_| random.between(-1.0, 1.0)).normalize();
    let (normal, from) = (direction(), direction());
    let cut = ClipSurface::plane(away + turn * DVec3::new(0.1, 0.15, 0.1), normal);
    let cuts = match number % 5 {
        0 => Vec::new(),
        _ => vec![cut],
    };
    let scene = of_parts(&format!("{way} {number}"), parts, cuts);
    (scene, looking(away + from * 5.0, away, 35.0))
}

#[test]
fn random_assemblies_are_shown_by_priority() {
    let mut random = Numbers(34);
    let (mut all, mut total) = (Vec::new(), [0; 2]);
    for number in 0..60 {
        let (scene, camera) = assembly(&mut random, number);
        let (faults, counts) = judged(&scene, &camera, None);
        all.extend(faults);
        if counts[0] * 200 > counts[1] {
            all.push(format!(
                "{}: {counts:?} px undecided and covered",
                scene.name
            ));
        }
        total = [total[0] + counts[0], total[1] + counts[1]];
    }
    all.push(format!("{total:?} px undecided and covered"));
    println!("{}", all.join("\n"));
    all.pop();
    must_be_right((all, total));
}
