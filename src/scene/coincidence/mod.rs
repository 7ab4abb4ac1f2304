//! Faces that lie in a clip-surface or coincide with other faces: decided once, by signs, for the reference and all strategies.

pub(super) mod coincide;
pub(super) mod contacts;
pub(super) mod faces_in_plane;
pub(super) mod flat_surface;
pub(super) mod preclassified;
pub(super) mod shared_planes;
