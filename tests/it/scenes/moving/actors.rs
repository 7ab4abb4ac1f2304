//! Parts that move: a bar on two joints, a ball that morphs, a bar with deformers.

use std::sync::Arc;

use cutaway::scene::{Axis, Deformer, JointWeight, Mesh, Motion, Part, Pose};
use glam::{DAffine3, DQuat, DVec3};

use super::common::meshes::{moved, shape};

/// A bar along y from -1 to 1, fine enough to bend.
fn bar() -> Mesh {
    let cube = shape("cube?divisions=6");
    moved(&cube, DAffine3::from_scale(DVec3::new(0.5, 2.0, 0.4)))
}

/// The share of the upper joint at a height.
fn upper(y: f64) -> f32 {
    (0.5 + y * 0.8).clamp(0.0, 1.0) as f32
}

/// Pulls of two joints, blended over the middle. The ends are pulled by one joint each, and weights need not sum to one exactly.
fn pulls(mesh: &Mesh) -> (Vec<u32>, Vec<JointWeight>) {
    let (mut first, mut pulls) = (vec![0], Vec::new());
    for p in &mesh.positions {
        let weight = upper(p.y);
        for (joint, weight) in [(0, 1.0 - weight), (1, weight)] {
            if weight > 0.0 {
                pulls.push(JointWeight { joint, weight });
            }
        }
        first.push(pulls.len() as u32);
    }
    (first, pulls)
}

/// A turn about a point.
fn turn(about: DVec3, axis: DVec3, degrees: f64) -> DAffine3 {
    DAffine3::from_translation(about)
        * DAffine3::from_quat(DQuat::from_axis_angle(axis, degrees.to_radians()))
        * DAffine3::from_translation(-about)
}

/// The bar, its upper half turned.
pub(super) fn bent_bar(degrees: f64) -> Part {
    let mesh = bar();
    let (first_pull, pulls) = pulls(&mesh);
    let mut part = Part::new("bar", mesh);
    part.motion = Some(Arc::new(Motion {
        first_pull,
        pulls,
        ..Motion::default()
    }));
    bend(&mut part, degrees);
    part
}

/// Turns the upper joint of a bar.
pub(super) fn bend(part: &mut Part, degrees: f64) {
    let tilt = DVec3::new(0.6, 0.0, 0.8);
    part.pose.joints = vec![
        turn(DVec3::ZERO, DVec3::Y, degrees * 0.25),
        turn(DVec3::Y * 0.1, tilt, degrees),
    ];
}

/// The bar half as long and half as thick, for two joints pull each of its vertices to and fro: each joint takes it far out of that.
pub(super) fn torn_bar() -> Part {
    let mesh = bar();
    let mut part = Part::new("bar", mesh);
    let positions = part.mesh.positions.len() as u32;
    let pull = |joint| JointWeight { joint, weight: 0.5 };
    part.motion = Some(Arc::new(Motion {
        first_pull: (0..=positions).map(|p| 2 * p).collect(),
        pulls: (0..positions).flat_map(|_| [pull(0), pull(1)]).collect(),
        ..Motion::default()
    }));
    part.pose.joints = [60.0, -60.0].map(|d| turn(DVec3::ZERO, DVec3::X, d)).into();
    part
}

/// A ball with two targets: one makes it an egg, one makes waves.
pub(super) fn morphing_ball(weights: [f64; 2]) -> Part {
    let mesh = shape("sphere?radius=0.6&subdivisions=3");
    let egg = |p: &DVec3| DVec3::Y * (0.6 * p.y.max(0.0));
    let wave = |p: &DVec3| *p * (0.2 * (9.0 * p.x).sin() * (7.0 * p.z).cos());
    let targets = vec![
        mesh.positions.iter().map(egg).collect(),
        mesh.positions.iter().map(wave).collect(),
    ];
    let mut part = Part::new("ball", mesh);
    part.motion = Some(Arc::new(Motion {
        targets,
        ..Motion::default()
    }));
    part.pose.weights = weights.to_vec();
    part
}

/// The bar with a skin and a target.
pub(super) fn both(degrees: f64, weight: f64) -> Part {
    let mut part = bent_bar(degrees);
    let swell = |p: &DVec3| DVec3::new(p.x, 0.0, p.z) * (0.8 * (1.0 - p.y * p.y));
    let mut motion = Motion::clone(part.motion.as_ref().expect("a bar has a motion"));
    motion.targets = vec![part.mesh.positions.iter().map(swell).collect()];
    part.motion = Some(Arc::new(motion));
    part.pose.weights = vec![weight];
    part
}

fn axis() -> Axis {
    Axis {
        centre: DVec3::new(0.05, -0.2, 0.1),
        along: DVec3::Y,
        across: DVec3::new(0.8, 0.0, 0.6),
    }
}

/// One deformer of each kind.
pub(super) fn deformers() -> [(&'static str, Vec<Deformer>); 5] {
    let (axis, turn_per_unit) = (axis(), 1.3);
    let twist = Deformer::Twist {
        axis,
        turn_per_unit,
    };
    let bend = Deformer::Bend {
        axis,
        turn_per_unit: -0.9,
    };
    let wave = Deformer::Wave {
        axis,
        amplitude: 0.15,
        period: 1.1,
        phase: 7.0,
    };
    let inflate = Deformer::Inflate { by: 0.12 };
    [
        ("twist", vec![twist]),
        ("bend", vec![bend]),
        ("wave", vec![wave]),
        ("inflate", vec![inflate]),
        ("all", vec![inflate, twist, wave, bend, inflate]),
    ]
}

/// The bar with deformers, on its joints or not.
pub(super) fn deformed_bar(deformers: Vec<Deformer>, degrees: Option<f64>) -> Part {
    let mut part = match degrees {
        Some(degrees) => bent_bar(degrees),
        None => Part::new("bar", bar()),
    };
    part.deform(deformers);
    part
}

/// A part that stands still.
pub(super) fn still(name: &str, at: DVec3) -> Part {
    let mut part = Part::new(name, shape("torus?segments=40&sides=20"));
    part.world_from_part = DAffine3::from_scale_rotation_translation(
        DVec3::splat(0.4),
        DQuat::from_rotation_x(0.4),
        at,
    );
    part
}

/// Where the definition has a position, and a normal there, both in part space.
pub(super) fn defined(part: &Part, position: usize, normal: DVec3) -> (DVec3, DVec3) {
    let still = Motion::default();
    let motion = part.motion.as_deref().unwrap_or(&still);
    let Pose {
        weights,
        joints,
        deformers,
    } = &part.pose;
    let rest = part.mesh.positions[position];
    let moved = motion.targets.iter().zip(weights);
    let mut point = moved.fold(rest, |p, (target, w)| p + target[position] * *w);
    let mut normal = normal;
    let mut outward = motion.outward.get(position).copied().unwrap_or_default();
    let pulls = motion.pulls_of(position);
    if !pulls.is_empty() && !joints.is_empty() {
        let to = |p: DVec3| {
            let pulled = pulls.iter().map(|pull| {
                let joint = &joints[usize::from(pull.joint)];
                joint.transform_point3(p) * f64::from(pull.weight)
            });
            pulled.sum::<DVec3>()
        };
        let [o, x, y, z] = [point, point + DVec3::X, point + DVec3::Y, point + DVec3::Z].map(to);
        let by = |n: DVec3| {
            let [x, y, z] = [x - o, y - o, z - o];
            y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z
        };
        (point, normal, outward) = (o, by(normal), by(outward));
    }
    for deformer in deformers {
        let (to, turned) = deformer.apply(point, normal);
        let (of_outward, out) = deformer.apply(point, outward);
        let inflates = matches!(deformer, Deformer::Inflate { .. });
        point = if inflates { of_outward } else { to };
        (normal, outward) = (turned, out);
    }
    (point, normal)
}
