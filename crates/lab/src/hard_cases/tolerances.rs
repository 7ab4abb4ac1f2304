//! Tolerances of all hard cases, each with its reason; those of single cases are in their files. Whoever raises one must check its
//! negative control.

/// Tolerance factor on found errors without a theoretical bound: up to this many times as large, and for failures down to 1 / `FACTOR`,
/// as another adapter rounds differently at single pixels. Twice as much is a different error.
pub const FACTOR: f64 = 2.0;

/// Largest displacement of a point of a frame, in scene units: rounding of depth and of the sprite's rows in f32,
/// some ulp of 1 each.
pub const ROUNDING_OF_POINTS: f64 = 1e-5;

/// Pixels along the rims of holes that may be marked or not: a rim leaves a band of 2/256 px open, so of the pixels on its two sides
/// about 1 in 256.
pub const RIM_SHARE: f64 = 1.0 / 64.0;
