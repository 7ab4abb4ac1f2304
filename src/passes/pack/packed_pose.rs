//! Poses of moving parts, packed for the pose pass: a pose is multiplied out here in f64, down to one matrix per joint that
//! maps directly to scene space, or to rest space if deformers follow.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::rest_part::{FIRST_JOINT, RestPart};
use crate::plan::Contents;
use crate::plan::pack::{self, MOST_DEFORMERS};
use crate::scene::{Axis, Deformer, Part, SceneSpace};

/// A part that the pose pass places.
#[derive(Clone, Debug)]
pub struct Moving {
    pub(crate) rest: Arc<RestPart>,
    pub(crate) packed_pose: PackedPose,
}

/// Pose of a part, packed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PackedPose {
    pub(crate) pose: Contents,
    pub(crate) weights: Option<Contents>,
    pub(crate) joints: Option<Contents>,
    pub(crate) deformers: Option<Contents>,
    pub(crate) inflates: bool,
    /// Reason why the pass cannot place the part, if it cannot.
    pub(crate) refusal: Option<String>,
}

impl PackedPose {
    /// Multiplies out the pose and the placement of a part.
    pub(crate) fn of(part: &Part, rest: &RestPart, space: &SceneSpace, first_vertex: u32) -> Self {
        let pose = &part.pose;
        let scene_from_part = space.from_world() * part.world_from_part;
        let deforms = !pose.deformers.is_empty();
        let (from_joints, last) = if deforms {
            let part_from_rest = rest.part_from_rest();
            (rest.rest_from_part(), scene_from_part * part_from_rest)
        } else {
            (scene_from_part, DAffine3::IDENTITY)
        };
        let is_skinned = rest.pulls.is_some() && !pose.joints.is_empty();
        let joints = is_skinned.then(|| {
            let part_from_rest = rest.part_from_rest();
            let origin = DAffine3 {
                matrix3: glam::DMat3::ZERO,
                translation: from_joints.translation,
            };
            let posed = pose
                .joints
                .iter()
                .map(|j| from_joints * *j * part_from_rest);
            let all = [from_joints * part_from_rest, origin]
                .into_iter()
                .chain(posed);
            Contents::from_values(&all.flat_map(rows).collect::<Vec<_>>())
        });
        let placement = if is_skinned || deforms {
            last
        } else {
            scene_from_part * rest.part_from_rest()
        };
        let targets = rest.displacements.as_ref().map_or(0, Contents::len) as usize
            / (rest.position_count as usize * 12).max(1);
        let weights: Vec<[u32; 2]> = (pose.weights.iter().take(targets).zip(0..))
            .filter(|(weight, _)| weight.abs() > 0.0)
            .map(|(weight, target)| [target, (*weight as f32).to_bits()])
            .collect();
        let table: Vec<pack::Deformer> = (pose.deformers.iter())
            .map(|d| deformer(d, &rest.rest_from_part(), rest.scale()))
            .collect();
        let refusal = (table.len() > MOST_DEFORMERS).then(|| {
            let (name, count) = (&part.name, table.len());
            format!("`{name}` has {count} deformers; the limit is {MOST_DEFORMERS}")
        });
        let mirrors = part.world_from_part.matrix3.determinant() < 0.0;
        let packed_pose = pack::Pose {
            scene_from_rest: rows(placement),
            first_vertex,
            vertex_count: rest.vertex_count,
            position_count: rest.position_count,
            weight_count: weights.len() as u32,
            deformer_count: table.len().min(MOST_DEFORMERS) as u32,
            joint_count: FIRST_JOINT + pose.joints.len() as u32,
            hand: if mirrors { -1.0 } else { 1.0 },
            padding: 0,
        };
        Self {
            pose: Contents::from_values(&[packed_pose]),
            inflates: rest.outward.is_some() && table.iter().any(|d| d.kind == pack::INFLATE),
            weights: (!weights.is_empty()).then(|| Contents::from_values(&weights)),
            joints,
            deformers: deforms.then(|| {
                let mut table = table;
                table.resize(MOST_DEFORMERS, bytemuck::Zeroable::zeroed());
                Contents::from_values(&table)
            }),
            refusal,
        }
    }
}

fn rows(map: DAffine3) -> [[f32; 4]; 3] {
    [0, 1, 2].map(|i| {
        let row = map.matrix3.row(i).extend(map.translation[i]);
        row.as_vec4().to_array()
    })
}

/// A deformer in rest space, where lengths are scaled by `scale`.
fn deformer(of: &Deformer, rest_from_part: &DAffine3, scale: f64) -> pack::Deformer {
    let row = |v: DVec3| v.as_vec3().extend(0.0).to_array();
    let about = |axis: &Axis, kind: u32| pack::Deformer {
        centre: row(rest_from_part.transform_point3(axis.centre)),
        along: row(axis.along),
        across: row(axis.across),
        kind,
        ..bytemuck::Zeroable::zeroed()
    };
    match *of {
        Deformer::Twist {
            axis,
            turn_per_unit,
        } => pack::Deformer {
            amount: (turn_per_unit / scale) as f32,
            ..about(&axis, pack::TWIST)
        },
        Deformer::Bend {
            axis,
            turn_per_unit,
        } => pack::Deformer {
            amount: (turn_per_unit / scale) as f32,
            ..about(&axis, pack::BEND)
        },
        Deformer::Wave {
            axis,
            amplitude,
            period,
            phase,
        } => pack::Deformer {
            amount: (amplitude * scale) as f32,
            turn_per_unit: (std::f64::consts::TAU / (period * scale)) as f32,
            phase: phase.rem_euclid(std::f64::consts::TAU) as f32,
            ..about(&axis, pack::WAVE)
        },
        Deformer::Inflate { by } => pack::Deformer {
            kind: pack::INFLATE,
            amount: (by * scale) as f32,
            ..bytemuck::Zeroable::zeroed()
        },
    }
}
