//! Strategies draw what exact says, and exact is right.

pub(crate) mod adaptive;
pub(crate) mod agree;
pub(crate) mod cuts;
pub(crate) mod cutters;
pub(crate) mod doubled_faces;
pub(crate) mod exact;
pub(crate) mod face_cuts;
pub(crate) mod hard_cases;
pub(crate) mod interference;
pub(crate) mod lists;
pub(crate) mod planar;
pub(crate) mod rasteriser;
pub(crate) mod shared_planes;
pub(crate) mod sheets;
pub(crate) mod winding;
