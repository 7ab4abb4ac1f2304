//! Drivers connect a part to its file's rig and pose the part for a time in a clip.
//!
//! In its rest pose a part is a plain mesh: a skin or morph targets that bend it in this pose are applied on loading. At a time
//! in a clip it is the bound mesh and a [`Pose`], so that the mesh stays the same over time and only a few matrices change.
//! Part space is the same in the rest pose and at all times: the mesh's space if its node or a single joint places it as a
//! whole, otherwise the space in which the rest pose was computed. Deformers therefore have the same meaning at all times.
//!
//! A part that a clip does not move stays in its rest pose, so only moving parts are posed. If a clip gives a part positions
//! that are not finite, the part stays in its rest pose.

use std::sync::{Arc, OnceLock};

use glam::DAffine3;

use super::bounds::Reach;
use super::rig::{Clip, Moment, Rig};
use super::{Motion, pose};
use crate::scene::memo::is_same;
use crate::scene::{Mesh, Pose};

/// A mesh in its bind pose, and its motion data.
#[derive(Debug)]
pub struct BoundMesh {
    pub(crate) mesh: Arc<Mesh>,
    pub(crate) motion: Option<Arc<Motion>>,
    /// Measured on first use.
    reach: OnceLock<Reach>,
}

impl BoundMesh {
    #[doc(hidden)]
    pub fn new(mesh: Mesh, motion: Motion) -> Self {
        Self {
            mesh: Arc::new(mesh),
            motion: (motion != Motion::default()).then(|| Arc::new(motion)),
            reach: OnceLock::new(),
        }
    }

    /// Bounds data of the bound mesh; `None` if the arguments are not the bound mesh and motion themselves.
    fn reach_of(&self, mesh: &Arc<Mesh>, motion: Option<&Arc<Motion>>) -> Option<&Reach> {
        let same_mesh = Arc::ptr_eq(&self.mesh, mesh);
        let same_motion = is_same(self.motion.as_ref(), motion);
        (same_mesh && same_motion).then(|| {
            self.reach
                .get_or_init(|| Reach::of(&self.mesh, self.motion.as_deref()))
        })
    }
}

/// The node or joints that a part is attached to.
#[derive(Clone, Debug)]
pub enum RigAttachment {
    /// The part as a whole is attached to its node.
    Node,
    /// The part as a whole is attached to one joint of a skin.
    Joint { skin: usize, joint: usize },
    /// Each vertex is attached to joints of a skin. If `with_node`, the node is appended as an extra joint, for vertices
    /// without joint influences.
    Skin { skin: usize, with_node: bool },
}

/// A part's attachment to its file's rig.
#[derive(Clone, Debug)]
pub struct Driver {
    rig: Arc<Rig>,
    node: usize,
    hold: RigAttachment,
    bound: Arc<BoundMesh>,
    rest_weights: Vec<f64>,
    /// The mesh in its rest pose.
    rest_mesh: Arc<Mesh>,
    /// Placement in the rest pose: from part space to the file's world.
    file_from_part: DAffine3,
    /// The user's placement of the file's world.
    placed: DAffine3,
}

impl Driver {
    /// Attaches a bound mesh to a node. `rest_weights` are its morph-target weights in the rest pose.
    #[doc(hidden)]
    pub fn new(
        rig: &Arc<Rig>,
        node: usize,
        hold: RigAttachment,
        bound: &Arc<BoundMesh>,
        rest_weights: Vec<f64>,
    ) -> Self {
        let mut driver = Self {
            rig: Arc::clone(rig),
            node,
            hold,
            bound: Arc::clone(bound),
            rest_weights,
            rest_mesh: Arc::clone(&bound.mesh),
            file_from_part: DAffine3::IDENTITY,
            placed: DAffine3::IDENTITY,
        };
        driver.rest();
        driver
    }

    /// Computes the part's placement and mesh in the rest pose.
    fn rest(&mut self) {
        let mut pose = Pose {
            weights: self.rest_weights.clone(),
            ..Pose::default()
        };
        match self.hold {
            RigAttachment::Node => self.file_from_part = self.rig.world(self.node, None),
            RigAttachment::Joint { skin, joint } => {
                self.file_from_part = self.rig.joint(skin, joint, None);
            }
            RigAttachment::Skin { .. } => match self.common_place() {
                Some(place) => self.file_from_part = place,
                None => pose.joints = self.joints(None),
            },
        }
        if let Some(motion) = self.bound.motion.as_deref().filter(|_| !pose.is_rest()) {
            self.rest_mesh = Arc::new(pose::posed(&self.bound.mesh, motion, &pose));
        }
    }

    /// The transform that all joints in use share in the rest pose; `None` if they differ or it has no inverse.
    fn common_place(&self) -> Option<DAffine3> {
        let joints = self.file_joints(None);
        let motion = self.bound.motion.as_deref()?;
        let mut used = (motion.pulls.iter()).map(|pull| joints.get(usize::from(pull.joint)));
        let first = used.next().flatten()?;
        let all_alike = used.all(|joint| joint.is_some_and(|joint| alike(joint, first)));
        (all_alike && first.inverse().is_finite()).then_some(*first)
    }

    /// Transforms of the bound mesh by the joints of the skin, in the file's world.
    fn file_joints(&self, moment: Option<Moment>) -> Vec<DAffine3> {
        let RigAttachment::Skin { skin, with_node } = self.hold else {
            return Vec::new();
        };
        let mut joints = self.rig.palette(skin, moment);
        if with_node {
            joints.push(self.rig.world(self.node, moment));
        }
        joints
    }

    /// Transforms of the bound mesh by the joints of the skin, in part space.
    fn joints(&self, moment: Option<Moment>) -> Vec<DAffine3> {
        let part_from_file = self.file_from_part.inverse();
        let joints = self.file_joints(moment).into_iter();
        joints.map(|joint| part_from_file * joint).collect()
    }

    /// The mesh in its bind pose, with its motion data.
    pub(crate) fn bound(&self) -> &Arc<BoundMesh> {
        &self.bound
    }

    /// The mesh in its rest pose, which is shown without a clip.
    pub(crate) fn rest_mesh(&self) -> &Arc<Mesh> {
        &self.rest_mesh
    }

    /// The driver for a fragment of the mesh, given in bind and rest pose: the fragment moves as it did in the whole mesh.
    pub(crate) fn of_piece(&self, bound: &Arc<BoundMesh>, rest_mesh: &Arc<Mesh>) -> Self {
        Self {
            bound: Arc::clone(bound),
            rest_mesh: Arc::clone(rest_mesh),
            ..self.clone()
        }
    }

    /// The mesh in its rest pose, and its placement.
    #[doc(hidden)]
    pub fn at_rest(&self) -> (Arc<Mesh>, DAffine3) {
        (
            Arc::clone(&self.rest_mesh),
            self.placed * self.file_from_part,
        )
    }

    /// Returns true if the mesh and its placement are finite in the rest pose.
    #[doc(hidden)]
    pub fn is_finite(&self) -> bool {
        let is_bound = Arc::ptr_eq(&self.rest_mesh, &self.bound.mesh);
        let positions = &self.rest_mesh.positions;
        self.file_from_part.is_finite() && (is_bound || positions.iter().all(|p| p.is_finite()))
    }

    /// Bounds data of the file's mesh; `None` if the arguments are not the file's mesh and motion themselves.
    pub(in crate::scene) fn reach_of(
        &self,
        mesh: &Arc<Mesh>,
        motion: Option<&Arc<Motion>>,
    ) -> Option<&Reach> {
        self.bound.reach_of(mesh, motion)
    }

    /// The animations of the file.
    pub(in crate::scene) fn clips(&self) -> &[Clip] {
        self.rig.clips()
    }

    /// Places the file's world, after any earlier placement.
    pub(in crate::scene) fn place(&mut self, placed: DAffine3) {
        self.placed = placed * self.placed;
    }

    /// Returns true if the file has anything that could move the part.
    #[doc(hidden)]
    pub fn is_needed(&self) -> bool {
        !self.rig.clips().is_empty() || self.bound.motion.is_some()
    }

    /// State of a part at a moment.
    pub(in crate::scene) fn at(&self, moment: Moment) -> Driven {
        let (mesh, world_from_part) = self.at_rest();
        let mut driven = Driven {
            mesh,
            world_from_part,
            motion: None,
            weights: Vec::new(),
            joints: Vec::new(),
        };
        let moment = Moment {
            // NaN becomes 0, too.
            time_s: moment.time_s.max(0.0),
            ..moment
        };
        let file_from_part = match self.hold {
            RigAttachment::Node => self.rig.world(self.node, Some(moment)),
            RigAttachment::Joint { skin, joint } => self.rig.joint(skin, joint, Some(moment)),
            RigAttachment::Skin { .. } => self.file_from_part,
        };
        if file_from_part.is_finite() {
            driven.world_from_part = self.placed * file_from_part;
        }
        let Some(motion) = &self.bound.motion else {
            return driven;
        };
        let weights = self.rig.weights(self.node, moment);
        let joints_move = match self.hold {
            RigAttachment::Skin { skin, with_node } => {
                self.rig.moves_skin(moment.clip, skin)
                    || with_node && self.rig.moves(moment.clip, self.node)
            }
            RigAttachment::Node | RigAttachment::Joint { .. } => false,
        };
        if !joints_move && weights.is_none() {
            return driven;
        }
        let weights = weights.unwrap_or_else(|| self.rest_weights.clone());
        let joints = self.joints(Some(moment));
        let is_finite =
            joints.iter().all(|j| j.is_finite()) && weights.iter().all(|w| w.is_finite());
        if is_finite {
            driven.mesh = Arc::clone(&self.bound.mesh);
            driven.motion = Some(Arc::clone(motion));
            (driven.weights, driven.joints) = (weights, joints);
        }
        driven
    }
}

/// State of a part at a moment, computed by a driver.
pub(in crate::scene) struct Driven {
    pub(in crate::scene) mesh: Arc<Mesh>,
    pub(in crate::scene) world_from_part: DAffine3,
    /// Motion of the mesh; `None` in the rest pose.
    pub(in crate::scene) motion: Option<Arc<Motion>>,
    /// Weights of its morph targets; empty in the rest pose.
    pub(in crate::scene) weights: Vec<f64>,
    /// Joints of its skin in part space; empty in the rest pose.
    pub(in crate::scene) joints: Vec<DAffine3>,
}

/// Joints whose matrices differ by less than this, relative to the largest entry, move the mesh as one.
const SAME_MATRIX: f64 = 1e-5;

fn alike(a: &DAffine3, b: &DAffine3) -> bool {
    let (a, b) = (a.to_cols_array(), b.to_cols_array());
    let largest = a.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    a.iter()
        .zip(b)
        .all(|(a, b)| (a - b).abs() <= SAME_MATRIX * largest)
}
