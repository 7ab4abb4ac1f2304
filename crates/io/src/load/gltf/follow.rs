//! What moves the vertices of a glTF mesh: joint weights, which are repaired if necessary, and morph targets.
//!
//! Weights that do not sum to 1, are negative or are not finite are repaired, with a note. So are vertices whose weights are all zero (they
//! follow their first joint, as in other readers), vertices without joints (they follow the node), and morph targets that do not fit (they
//! are ignored). A joint that the skin lacks is an error, because its position is unknown.

use cutaway::error::Diagnostic;
use cutaway::scene::motion::{JointWeight, Motion};
use cutaway::scene::weld::thousands;
use glam::DVec3;
use gltf::Primitive;

use super::quantized::triples;
use super::skin::Pulls;

/// Largest deviation of a weight sum from 1 that is considered rounding.
const WHOLE: f64 = 1e-3;

/// Assembles a motion, primitive by primitive.
#[derive(Debug, Default)]
pub(super) struct Followers {
    pub(super) motion: Motion,
    /// Number of joints in the skin, or `None` if there is no skin.
    joints: Option<u16>,
    unwhole: usize,
    weightless: usize,
    unpulled: usize,
}

impl Followers {
    pub(super) fn new(joints: Option<usize>) -> Self {
        let mut followers = Self {
            joints: joints.and_then(|j| u16::try_from(j).ok()),
            ..Self::default()
        };
        if followers.joints.is_some() {
            followers.motion.first_pull.push(0);
        }
        followers
    }

    /// Adds the joint influences on the next `vertices` vertices. `pulls` is empty if a primitive has none.
    pub(super) fn pull(&mut self, pulls: &[Pulls], vertices: usize) -> Result<(), String> {
        let Some(joints) = self.joints else {
            return Ok(());
        };
        for vertex in 0..vertices {
            let pulls = pulls.get(vertex).map_or(&[][..], Vec::as_slice);
            let mut whole = Vec::with_capacity(pulls.len());
            let mut is_odd = false;
            for (joint, weight) in pulls {
                let weight = f64::from(*weight);
                if weight > 0.0 && weight.is_finite() {
                    whole.push((*joint, weight));
                } else {
                    // A weight of zero only pads a set. Any other weight here is a mistake.
                    is_odd |= weight.abs() > 0.0 || weight.is_nan();
                }
            }
            if let (true, Some((first, _))) = (whole.is_empty(), pulls.first()) {
                self.weightless += 1;
                is_odd = false;
                whole.push((*first, 1.0));
            }
            if let Some((joint, _)) = whole.iter().find(|(joint, _)| *joint >= joints) {
                return Err(format!(
                    "vertex {vertex} follows joint {joint}, but its skin has only {joints}"
                ));
            }
            whole.sort_by_key(|(joint, _)| *joint);
            whole.dedup_by(|next, kept| {
                let same = next.0 == kept.0;
                if same {
                    kept.1 += next.1;
                }
                same
            });
            let sum: f64 = whole.iter().map(|(_, weight)| weight).sum();
            if whole.is_empty() {
                self.unpulled += 1;
                whole.push((joints, 1.0));
            } else {
                let is_whole = (sum - 1.0).abs() <= WHOLE && !is_odd;
                self.unwhole += usize::from(!is_whole);
                whole.iter_mut().for_each(|(_, weight)| *weight /= sum);
            }
            let pulls = whole.iter().map(|(joint, weight)| JointWeight {
                joint: *joint,
                weight: *weight as f32,
            });
            self.motion.pulls.extend(pulls);
            self.motion.first_pull.push(self.motion.pulls.len() as u32);
        }
        Ok(())
    }

    /// Adds the morph targets of a primitive whose vertices are the last `vertices` of `all`.
    pub(super) fn morph(
        &mut self,
        primitive: &Primitive<'_>,
        vertices: usize,
        all: usize,
        buffers: &[Vec<u8>],
        notes: &mut Vec<Diagnostic>,
    ) -> Result<(), String> {
        let targets = &mut self.motion.targets;
        for (index, target) in primitive.morph_targets().enumerate() {
            if targets.len() <= index {
                targets.push(Vec::new());
            }
            let Some(accessor) = target.positions() else {
                continue;
            };
            let number = accessor.index();
            let by: Vec<[f32; 3]> =
                triples(accessor, buffers).map_err(|why| format!("morph target {index}: {why}"))?;
            let fault = if by.len() != vertices {
                Some(format!("{} positions for {vertices} vertices", by.len()))
            } else if by.iter().flatten().any(|c| !c.is_finite()) {
                Some("a displacement that is not finite".to_owned())
            } else {
                None
            };
            if let Some(fault) = fault {
                notes.push(Diagnostic::note(
                    "morph-target-left-out",
                    format!("left out morph target {index} (accessor {number}): it has {fault}"),
                ));
                continue;
            }
            let moves = &mut targets[index];
            moves.resize(all - vertices, DVec3::ZERO);
            moves.extend(by.into_iter().map(|d| DVec3::from(d.map(f64::from))));
        }
        Ok(())
    }

    /// Returns the motion of all vertices, and adds the repairs to `notes`.
    pub(super) fn finish(mut self, vertices: usize, notes: &mut Vec<Diagnostic>) -> Motion {
        for target in &mut self.motion.targets {
            target.resize(vertices, DVec3::ZERO);
        }
        if self.unwhole > 0 {
            notes.push(Diagnostic::note(
                "weights-scaled",
                format!(
                    "the weights of {} vertices did not sum to 1 and were scaled",
                    thousands(self.unwhole)
                ),
            ));
        }
        if self.weightless > 0 {
            notes.push(Diagnostic::note("weights-zero", format!(
                "{} vertices have no weight that is greater than zero and follow their first joint",
                thousands(self.weightless)
            )));
        }
        if self.unpulled > 0 {
            notes.push(Diagnostic::note(
                "no-joint",
                format!(
                    "{} vertices have no joint and follow the node",
                    thousands(self.unpulled)
                ),
            ));
        }
        self.motion
    }
}
