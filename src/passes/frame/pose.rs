//! The pose pass: poses a moving part on the device. It takes the part's rest-pose vertices through morph targets, skin, deformers
//! and placement, and writes them to the part's range of the shared vertex buffer, where other passes read them like uploaded ones.
//!
//! One pass per moving part, on the clock of the solid; each has separate resources, so that a part that stands still is
//! not posed again. Its pose is multiplied out beforehand ([`PackedPose`](crate::passes::pack::packed_pose::PackedPose)).
//! Time: proportional to vertices times weighted morph targets and joint influences.
//! Memory: constant mesh data, 16 bytes per vertex and 12 per position and target, and 48 bytes per joint for each pose.
//!
//! Error: a few units in the last place of f32 at the scene's size, times the stretch of the motion; tight bends and twists
//! stretch. Cannot: more than [`MOST_DEFORMERS`](crate::plan::pack::MOST_DEFORMERS) deformers per part. Vertices without a common
//! axis with the skin have no more precision than the part's size allows; a skin that carries a part far away first loses digits.

use super::dispatch::groups_along;
use super::input::Input;
use super::refusal::Refusal;
use crate::passes::pack::packed_pose::Moving;
use crate::plan::{
    Binding, BufferRole, Clock, Contents, Pass, Plan, Resource, ResourceId, VERTEX_BYTES, Work,
};
use crate::shader::Shader;

/// Poses the moving parts that are drawn, as they are or as ghosts, into the shared vertex buffer; returns the reason if one cannot be.
pub(crate) fn pose_parts(
    plan: &mut Plan,
    input: &Input<'_>,
    vertices: ResourceId,
) -> Result<(), Refusal> {
    // A ghost shows parts that are not drawn themselves.
    let ghost = input.model.prepared.style.ghost.is_drawn();
    let removed = ghost.then(|| input.active_cuts.removed_parts());
    let drawn = input.active_cuts.order.iter().copied();
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
    // The part's own resources, bound under the name of their kind.
    let mut own = |kind: &'static str, role: BufferRole, contents: &Contents| {
        let name = format!("{kind} {number}");
        let resource = Resource::upload(name, role, contents.clone(), Clock::Solid);
        Binding::read(kind, plan.add_resource(resource))
    };
    let mut bindings = vec![
        own("pose", BufferRole::Uniform, &packed_pose.pose),
        own("rest", BufferRole::Storage, &rest.vertices),
        Binding::write("posed", vertices).within(bytes),
    ];
    let mut shader = Shader::from("passes/pose.wgsl");
    let mut how = Vec::new();
    let mut per_position = false;
    shader = match (&rest.displacements, &packed_pose.weights) {
        (Some(displacements), Some(weights)) => {
            per_position = true;
            how.push("morph targets");
            bindings.push(own("displacements", BufferRole::Storage, displacements));
            bindings.push(own("weights", BufferRole::Storage, weights));
            shader.with("lib/morph/targets.wgsl")
        }
        _ => shader.with("lib/morph/none.wgsl"),
    };
    shader = match (&rest.pulls, &packed_pose.joints) {
        (Some(pulls), Some(joints)) => {
            per_position = true;
            how.push("its skin");
            bindings.push(own("pulls", BufferRole::Storage, pulls));
            bindings.push(own("joints", BufferRole::Storage, joints));
            shader.with("lib/skin/linear.wgsl")
        }
        _ => shader.with("lib/skin/none.wgsl"),
    };
    shader = match (&packed_pose.deformers, &rest.outward) {
        (None, _) => shader.with("lib/deform/none.wgsl"),
        (Some(deformers), outward) => {
            how.push("deformers");
            bindings.push(own("deformers", BufferRole::Uniform, deformers));
            match outward.as_ref().filter(|_| packed_pose.inflates) {
                Some(outward) => {
                    per_position = true;
                    bindings.push(own("outward", BufferRole::Storage, outward));
                    shader.with("lib/deform/mesh.wgsl")
                }
                None => shader.with("lib/deform/space.wgsl"),
            }
        }
    };
    if per_position {
        let contents = &rest.position_of_vertex;
        bindings.push(own("position_of_vertex", BufferRole::Storage, contents));
    }
    how.push("its placement");
    let pass = Pass::new(
        format!("place {number}"),
        format!(
            "`{}` moves: {} take it from rest pose to the scene",
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
