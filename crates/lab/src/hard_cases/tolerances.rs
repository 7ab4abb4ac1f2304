//! Numbers that all hard cases forgive by, each with its reason; those of single cases are in their files. Raising one asks for a look at its
//! negative control.

/// What was found of an error that theory gives no number for may be so many times as much, and that of a failure so many times less:
/// another adapter rounds otherwise at single pixels. Twice as much is another error.
pub const FACTOR: f64 = 2.0;

/// How far a point of a frame may be beside where it is, in scene units: rounding of depth and of the sprite's rows in f32,
/// some ulp of 1 each.
pub const ROUNDING_OF_POINTS: f64 = 1e-5;

/// Pixels along the rims of holes that may be marked or not: a rim leaves a band of 2/256 px open, so of the pixels on its two sides
/// about 1 in 256.
pub const RIM_SHARE: f64 = 1.0 / 64.0;
