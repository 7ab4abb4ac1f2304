//! Cameras, and the views that they resolve to.

pub(super) mod camera;
mod facing;
pub(super) mod host_view;
pub(super) mod outline;
pub(super) mod up;
pub(super) mod view;
