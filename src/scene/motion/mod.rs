//! Motion of a part's vertices: morph targets, a skin and deformers, and the pose at one time.
//!
//! A [`Motion`] is the constant data per position of the part's mesh; a [`Pose`] is the small rest that changes from
//! time to time, in f64. Two paths apply a pose: [`Part::posed_mesh`] in f64 on the CPU, which the exact reference uses,
//! and the pose pass of a frame in f32 on the GPU. They share the numbers of the pose and nothing else.
//!
//! The files of parts bring a rig with them: nodes, skins and clips, which give a pose for a time ([`Part::at_time`]).
//!
//! [`Part::posed_mesh`]: super::Part::posed_mesh
//! [`Part::at_time`]: super::Part::at_time
//!
//! The order is fixed: rest, plus weighted targets, then the blend of the joints (linear blend skinning), then deformers in
//! their order; all in part space. The placement of the part follows. Normals go with the cofactors of what was applied.

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
pub use driver::{Bound, RigAttachment};
pub use rig::Clip;
#[doc(hidden)]
pub use rig::{Moment, NodeTracks, NodeTransform, Rig, RigNode, RigSkin};
#[doc(hidden)]
pub use track::{Track, Way};
#[doc(hidden)]
pub use vertex_motion::is_same_motion;
pub use vertex_motion::{JointWeight, Motion, Pose};

pub(super) use bounds::Reach;
pub(super) use pose::posed;
