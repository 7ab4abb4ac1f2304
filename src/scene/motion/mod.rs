//! Motion of a part's vertices: morph targets, a skin and deformers, and poses.
//!
//! A [`Motion`] is the constant data per position of the part's mesh; a [`Pose`] is the small amount of data that changes
//! over time, in f64. Two paths apply a pose: [`Part::posed_mesh`] in f64 on the CPU, which the exact reference uses,
//! and a frame's pose pass in f32 on the GPU. They share the pose's numbers and nothing else.
//!
//! Files may contain a rig for their parts: nodes, skins and clips, which determine the pose at a time ([`Part::at_time`]).
//!
//! [`Part::posed_mesh`]: super::Part::posed_mesh
//! [`Part::at_time`]: super::Part::at_time
//!
//! The order is fixed: rest position plus weighted targets, then linear blend skinning by the joints, then deformers in
//! order; all in part space. The part's placement follows. Normals are transformed by the cofactors of these maps.

mod bounds;
mod defect;
mod deform;
mod deformed;
mod driver;
mod outward;
mod pose;
mod rig;
mod track;
mod vertex_motion;

pub use defect::MotionDefect;
pub use deform::{Axis, Deformer};
pub use driver::Driver;
#[doc(hidden)]
pub use driver::{BoundMesh, RigAttachment};
pub use rig::Clip;
#[doc(hidden)]
pub use rig::{Moment, NodeTracks, NodeTransform, Rig, RigNode, RigSkin};
#[doc(hidden)]
pub use track::{Track, Way};
#[doc(hidden)]
pub use vertex_motion::{JointWeight, Motion, Pose};

pub(super) use bounds::Reach;
pub(super) use pose::posed;
