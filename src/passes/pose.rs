//! The pose pass: a part that moves is placed on the device, its vertices at rest taken through morph targets, skin, deformers
//! and placement into its range of the vertices of all parts, where every other pass finds them as if they had been uploaded.
//!
//! One pass per part that moves, on the clock of the solid; each has resources of its own, so that a part that stands still is
//! not placed again. What a pose says is multiplied out in f64 here, down to one matrix per joint that goes straight to scene
//! space, or to rest space where deformers follow. Time: in proportion to vertices times targets with a weight and pulls.
//! Memory: what is known of the mesh, 16 bytes a vertex and 12 a position and target, and at each time 48 bytes a joint.
//!
//! Error: a few units in the last place of f32 at the scene's size, times how much the motion stretches; bending and twisting
//! tightly stretches. Cannot: more than [`MOST_DEFORMERS`] deformers in a part, and what shares no axis with the skin cannot be
//! more precise than the part is large, so a skin that carries a part far away before deformers follow loses digits.

use super::Refusal;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::Input;
use super::rest::{FIRST_JOINT, Rest};
use super::sweep::groups_along;
use crate::plan::pack::{self, MOST_DEFORMERS};
use crate::plan::{
    Binding, Clock, Contents, Pass, Plan, Resource, ResourceId, Role, VERTEX_BYTES, Work,
};
use crate::scene::{Axis, Deformer, Part, SceneSpace};
use crate::shader::Shader;

/// A part that the pose pass places.
#[derive(Clone, Debug)]
pub struct Moving {
    pub(super) rest: Arc<Rest>,
    pub(super) packed_pose: PackedPose,
}

/// How a part stands, packed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PackedPose {
    pose: Contents,
    weights: Option<Contents>,
    joints: Option<Contents>,
    deformers: Option<Contents>,
    inflates: bool,
    /// Why the pass cannot place it so, if it cannot.
    refusal: Option<String>,
}

impl PackedPose {
    /// Multiplies out the pose and the placement of a part.
    pub(super) fn of(part: &Part, rest: &Rest, space: &SceneSpace, first_vertex: u32) -> Self {
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
            format!("`{name}` has {count} deformers; the pose pass applies {MOST_DEFORMERS}")
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

/// A deformer in rest space, where lengths are `scale` times as long.
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

/// Places the parts that move and are drawn, as they are or as ghosts, into the vertices of all parts; the reason where one cannot be.
pub(super) fn pose_parts(
    plan: &mut Plan,
    input: &Input<'_>,
    vertices: ResourceId,
) -> Result<(), Refusal> {
    // A ghost shows parts that are not drawn.
    let ghost = input.model.prepared.style.ghost.is_drawn();
    let removed = ghost.then(|| input.relevance.removed_parts());
    let drawn = input.relevance.order.iter().copied();
    for rank in drawn.chain(removed.into_iter().flatten()) {
        let Some(moving) = &input.model.moving[rank] else {
            continue;
        };
        if let Some(reason) = &moving.packed_pose.refusal {
            return Err(Refusal::amount(reason.clone()));
        }
        pose_part(plan, input, rank, moving, vertices);
    }
    Ok(())
}

fn pose_part(
    plan: &mut Plan,
    input: &Input<'_>,
    rank: usize,
    moving: &Moving,
    vertices: ResourceId,
) {
    let Moving { rest, packed_pose } = moving;
    let part = &input.model.prepared.parts[rank];
    let number = part.part;
    let range = &input.model.ranges[rank];
    let first = u64::from(range.base_vertex.unsigned_abs());
    let end = first + u64::from(range.vertex_count);
    let bytes = first * VERTEX_BYTES..end * VERTEX_BYTES;
    // Resources of the part's own, bound under their kind.
    let mut own = |kind: &'static str, role: Role, contents: &Contents| {
        let name = format!("{kind} {number}");
        let resource = Resource::upload(name, role, contents.clone(), Clock::Solid);
        Binding::read(kind, plan.add_resource(resource))
    };
    let mut bindings = vec![
        own("pose", Role::Uniform, &packed_pose.pose),
        own("rest", Role::Storage, &rest.vertices),
        Binding::write("posed", vertices).within(bytes),
    ];
    let mut shader = Shader::from("passes/pose.wgsl");
    let mut how = Vec::new();
    let mut per_position = false;
    shader = match (&rest.displacements, &packed_pose.weights) {
        (Some(displacements), Some(weights)) => {
            per_position = true;
            how.push("morph targets");
            bindings.push(own("displacements", Role::Storage, displacements));
            bindings.push(own("weights", Role::Storage, weights));
            shader.with("lib/morph/targets.wgsl")
        }
        _ => shader.with("lib/morph/none.wgsl"),
    };
    shader = match (&rest.pulls, &packed_pose.joints) {
        (Some(pulls), Some(joints)) => {
            per_position = true;
            how.push("its skin");
            bindings.push(own("pulls", Role::Storage, pulls));
            bindings.push(own("joints", Role::Storage, joints));
            shader.with("lib/skin/linear.wgsl")
        }
        _ => shader.with("lib/skin/none.wgsl"),
    };
    shader = match (&packed_pose.deformers, &rest.outward) {
        (None, _) => shader.with("lib/deform/none.wgsl"),
        (Some(deformers), outward) => {
            how.push("deformers");
            bindings.push(own("deformers", Role::Uniform, deformers));
            match outward.as_ref().filter(|_| packed_pose.inflates) {
                Some(outward) => {
                    per_position = true;
                    bindings.push(own("outward", Role::Storage, outward));
                    shader.with("lib/deform/mesh.wgsl")
                }
                None => shader.with("lib/deform/space.wgsl"),
            }
        }
    };
    if per_position {
        let contents = &rest.position_of_vertex;
        bindings.push(own("position_of_vertex", Role::Storage, contents));
    }
    how.push("its placement");
    let pass = Pass::new(
        format!("place {number}"),
        format!(
            "`{}` moves: {} take it from rest to the scene",
            part.name,
            how.join(", ")
        ),
        shader,
        bindings,
        Work::Compute {
            groups: groups_along(rest.vertex_count),
        },
    );
    plan.add_pass(pass.on(Clock::Solid));
}
