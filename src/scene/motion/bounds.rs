//! Bounds of a posed part, computed without posing it.
//!
//! A skin moves every position to a weighted mean of its transforms by the joints, so the mesh stays within the transformed boxes of the
//! positions that each joint influences. Morph targets widen these boxes by the boxes of their displacements, times the targets' weights.
//! The boxes are measured once per mesh and motion; a pose then costs joints times targets. Bounds are never too small; they are too large
//! if a joint rotates its box, or has a small influence on distant positions.
//!
//! There is no such shortcut for deformers: if a pose has one, all positions are posed.

use glam::{DAffine3, DVec3};

use super::{Motion, Pose};
use crate::scene::{Bounds, Mesh};

/// Rounding error of posing and of these bounds, as a share of the largest intermediate value.
const ROUNDING: f64 = 1e-13;

/// Positions influenced by one joint, or by none.
#[derive(Clone, Debug)]
struct Pulled {
    joint: Option<u16>,
    rest: Bounds,
    /// Per target, the bounds of these positions' displacements at weight 1.
    moves: Vec<Bounds>,
}

/// Data for the bounds of a mesh in any pose.
#[derive(Clone, Debug)]
pub(in crate::scene) struct Reach {
    pulled: Vec<Pulled>,
    /// Smallest and largest weight sum of any position.
    weight_sum: [f64; 2],
    /// True if a weight is negative or NaN, so that positions can leave the boxes.
    is_wild: bool,
}

impl Reach {
    /// Measures a mesh.
    pub(in crate::scene) fn of(mesh: &Mesh, motion: Option<&Motion>) -> Self {
        let still = Motion::default();
        let motion = motion.unwrap_or(&still);
        let mut reach = Self {
            pulled: Vec::new(),
            weight_sum: [1.0, 1.0],
            is_wild: false,
        };
        // By joint; the last entry is for positions that no joint influences.
        let joints = motion.pulls.iter().map(|p| usize::from(p.joint) + 1);
        let free = joints.max().unwrap_or(0);
        let mut slot_of = vec![usize::MAX; free + 1];
        for (index, position) in mesh.positions.iter().enumerate() {
            let pulls = motion.pulls_of(index);
            let mut add = |key: usize, joint| {
                let slot = reach.slot(&mut slot_of[key], joint, motion.targets.len());
                let point = Bounds::from_points([*position]);
                slot.rest = slot.rest.union(point);
                for (target, moves) in slot.moves.iter_mut().enumerate() {
                    let by = motion.displacement(target, index);
                    *moves = moves.union(Bounds::from_points([by]));
                }
            };
            if pulls.is_empty() {
                add(free, None);
                continue;
            }
            // A joint influence with weight 0 has no effect.
            for pull in pulls.iter().filter(|p| p.weight.abs() > 0.0) {
                add(usize::from(pull.joint), Some(pull.joint));
            }
            let weights = pulls.iter().map(|p| f64::from(p.weight));
            let sum: f64 = weights.clone().sum();
            reach.weight_sum[0] = reach.weight_sum[0].min(sum);
            reach.weight_sum[1] = reach.weight_sum[1].max(sum);
            // Written so that NaN counts as wild, too.
            let is_tame = weights.clone().all(|w| w >= 0.0) && sum > 0.0;
            reach.is_wild |= !is_tame;
        }
        reach
    }

    fn slot(&mut self, slot: &mut usize, joint: Option<u16>, targets: usize) -> &mut Pulled {
        if *slot == usize::MAX {
            *slot = self.pulled.len();
            self.pulled.push(Pulled {
                joint,
                rest: Bounds::EMPTY,
                moves: vec![Bounds::EMPTY; targets],
            });
        }
        &mut self.pulled[*slot]
    }

    /// Bounds of the mesh in a pose, without the pose's deformers; `None` if the boxes do not bound the mesh.
    pub(in crate::scene) fn posed(&self, pose: &Pose) -> Option<Bounds> {
        if self.is_wild {
            return None;
        }
        let mut all = Bounds::EMPTY;
        for pulled in &self.pulled {
            let mut bounds = pulled.rest;
            for (moves, weight) in pulled.moves.iter().zip(&pose.weights) {
                let ends = Bounds::from_points([moves.min * *weight, moves.max * *weight]);
                bounds.min += ends.min;
                bounds.max += ends.max;
            }
            let joint = pulled.joint.filter(|_| !pose.joints.is_empty());
            let taken = match joint {
                Some(joint) => {
                    let by = pose.joints.get(usize::from(joint));
                    let taken = moved(bounds, by.copied().unwrap_or(DAffine3::IDENTITY));
                    let scaled = self.weight_sum.map(|s| [taken.min * s, taken.max * s]);
                    Bounds::from_points(scaled.into_iter().flatten())
                }
                None => bounds,
            };
            let largest = bounds.min.abs().max(bounds.max.abs());
            all = all.union(widened(taken, largest * ROUNDING));
        }
        let is_finite = all.is_empty() || all.min.is_finite() && all.max.is_finite();
        is_finite.then_some(all)
    }
}

/// The bounds of a transformed box.
fn moved(bounds: Bounds, by: DAffine3) -> Bounds {
    let (centre, half) = (
        (bounds.min + bounds.max) * 0.5,
        (bounds.max - bounds.min) * 0.5,
    );
    let size = by.matrix3.abs();
    let (centre_then, half_then) = (by.transform_point3(centre), size * half);
    let taken = Bounds {
        min: centre_then - half_then,
        max: centre_then + half_then,
    };
    let numbers = size * (centre.abs() + half) + by.translation.abs();
    widened(taken, numbers * ROUNDING)
}

fn widened(bounds: Bounds, by: DVec3) -> Bounds {
    Bounds {
        min: bounds.min - by,
        max: bounds.max + by,
    }
}
