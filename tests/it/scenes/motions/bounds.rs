//! Bounds of posed parts hold every posed position and are not much too large; motions that make no sense panic nowhere.

use std::sync::Arc;

use cutaway::Part;
use cutaway::scene::{Bounds, JointWeight, Mesh, Motion, MotionDefect};
use glam::{DAffine3, DMat3, DVec3};

use super::document::{bending_bar, morphing_cube};
use super::real::moments;

/// Bounds may be so many times as large as they need to be, on meshes that people make.
const LARGER: f64 = 3.0;

/// What of a posed part is outside its bounds.
fn outside(part: &Part, bounds: Bounds) -> usize {
    let mesh = part.posed_mesh();
    let is_out = |p: &&DVec3| !(p.cmpge(bounds.min).all() && p.cmple(bounds.max).all());
    mesh.positions.iter().filter(is_out).count()
}

#[test]
fn bounds_hold_the_models() {
    let mut largest = (0.0, "");
    for (name, clip, time_s, parts) in moments() {
        for part in &parts {
            let bounds = part.posed_bounds();
            assert_eq!(outside(part, bounds), 0, "{name}, clip {clip}, {time_s} s");
            let needed = part.posed_mesh().bounds().size().length();
            let share = bounds.size().length() / needed;
            assert!(
                share < LARGER,
                "{name}, {} at {time_s} s: {share}",
                part.name
            );
            if share > largest.0 {
                largest = (share, name);
            }
        }
    }
    println!(
        "bounds are at most {} times as large: {}",
        largest.0, largest.1
    );
}

#[test]
fn bounds_of_small_documents_are_tight() {
    for (document, most) in [(bending_bar(), 1.2), (morphing_cube(), 1.0 + 1e-9)] {
        let part = document.load().parts[0].clone();
        for time_s in [0.0, 0.3, 1.0] {
            let now = part.at_time(0, time_s);
            let (bounds, needed) = (now.posed_bounds(), now.posed_mesh().bounds());
            assert_eq!(outside(&now, bounds), 0);
            let share = bounds.size().length() / needed.size().length();
            assert!(share <= most, "{share} at {time_s} s");
        }
    }
    // What is planted: the bounds of another time.
    let part = bending_bar().load().parts[0].clone();
    let (early, late) = (part.at_time(0, 0.2), part.at_time(0, 1.0));
    assert!(outside(&late, early.posed_bounds()) > 0);
    assert!(outside(&late, late.mesh.bounds()) > 0);
}

/// Numbers that repeat from run to run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % end
    }

    /// From -1 to 1.
    fn number(&mut self) -> f64 {
        self.below(2_000_001) as f64 / 1e6 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

/// A part with a motion and a pose by chance, well-formed.
fn by_chance(dice: &mut Dice) -> Part {
    let vertices = 3 + dice.below(20);
    let positions: Vec<DVec3> = (0..vertices).map(|_| dice.vector() * 10.0).collect();
    let mesh = Mesh {
        positions,
        triangles: vec![[0, 1, 2]],
        corner_normals: None,
        vertex_paint: None,
    };
    let mut motion = Motion::default();
    for _ in 0..dice.below(4) {
        let target = (0..vertices).map(|_| dice.vector()).collect();
        motion.targets.push(target);
    }
    let joints = dice.below(5);
    if joints > 0 {
        motion.first_pull.push(0);
        for _ in 0..vertices {
            let pulls = 1 + dice.below(3);
            let raw: Vec<f64> = (0..pulls).map(|_| dice.number().abs() + 0.01).collect();
            let sum: f64 = raw.iter().sum();
            motion.pulls.extend(raw.iter().map(|w| JointWeight {
                joint: dice.below(joints) as u16,
                weight: (w / sum) as f32,
            }));
            motion.first_pull.push(motion.pulls.len() as u32);
        }
    }
    assert_eq!(motion.defect(vertices), None, "well-formed");
    let mut part = Part::new("chance", mesh);
    part.pose.weights = motion.targets.iter().map(|_| 2.0 * dice.number()).collect();
    part.pose.joints = (0..joints)
        .map(|_| DAffine3 {
            matrix3: DMat3::from_cols(dice.vector(), dice.vector(), dice.vector()),
            translation: dice.vector() * 100.0,
        })
        .collect();
    part.motion = Some(Arc::new(motion));
    part
}

#[test]
fn bounds_hold_whatever_moves() {
    let mut dice = Dice(1);
    for round in 0..2000 {
        let part = by_chance(&mut dice);
        assert_eq!(outside(&part, part.posed_bounds()), 0, "round {round}");
    }
}

#[test]
fn motions_that_make_no_sense_panic_nowhere() {
    let mut dice = Dice(2);
    let mut found = [0; 4];
    for round in 0..2000 {
        let mut part = by_chance(&mut dice);
        let mut motion = Arc::unwrap_or_clone(part.motion.take().unwrap());
        match dice.below(9) {
            0 => motion.targets.iter_mut().for_each(|t| t.truncate(1)),
            1 => motion.pulls.truncate(2),
            2 => motion.first_pull.truncate(2),
            3 => motion.first_pull.reverse(),
            4 => motion.pulls.iter_mut().for_each(|p| p.joint += 3),
            5 => motion.pulls.iter_mut().for_each(|p| p.weight = -p.weight),
            6 => motion.pulls.iter_mut().for_each(|p| p.weight *= 1.5),
            7 => motion.first_pull.iter_mut().for_each(|f| *f = u32::MAX),
            _ => part.pose.weights.push(1.0),
        }
        match motion.defect(part.mesh.positions.len()) {
            Some(MotionDefect::Target { .. }) => found[0] += 1,
            Some(MotionDefect::Pulls { .. }) => found[1] += 1,
            Some(MotionDefect::Weights { .. }) => found[2] += 1,
            _ => found[3] += 1,
        }
        part.motion = Some(Arc::new(motion));
        assert_eq!(outside(&part, part.posed_bounds()), 0, "round {round}");
    }
    assert!(found.iter().all(|n| *n > 50), "{found:?}");
    // Numbers that are none end in positions that are none, not in a panic.
    let mut part = by_chance(&mut Dice(3));
    part.pose.weights = vec![f64::NAN; 9];
    part.pose.joints = vec![DAffine3::NAN; 9];
    let _ = (part.posed_mesh(), part.posed_bounds());
    let mut bad = Motion {
        targets: vec![vec![DVec3::NAN; 3]],
        ..Motion::default()
    };
    let wanted = MotionDefect::NotFinite {
        target: 0,
        position: 0,
    };
    assert_eq!(bad.defect(3), Some(wanted));
    bad.targets.clear();
    assert_eq!(bad.defect(3), None);
}

#[test]
fn a_joint_that_the_pose_lacks_stays() {
    let part = bending_bar().load().parts[0].at_time(0, 1.0);
    let mut short = part.clone();
    short.pose.joints.truncate(1);
    let mesh = short.posed_mesh();
    for (posed, bound) in mesh.positions.iter().zip(&part.mesh.positions) {
        assert!(posed.distance(*bound) < 1e-6, "{posed} is not {bound}");
    }
}
