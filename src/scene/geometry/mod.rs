//! Geometry independent of meshes: bounds, convex hulls, exact sums.

pub(super) mod bounds;
pub(super) mod exact_sum;
pub(super) mod fitting;
pub(super) mod hull;
mod hull_sum;
