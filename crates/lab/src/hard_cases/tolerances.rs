//! Numbers that all hard cases forgive by, each with its reason; those of single cases are in their files. Raising one asks for a look at its
//! negative control.

/// Factor on found errors that theory gives no number for: up to this many times as large, and for failures down to 1 / `FACTOR`:
/// another adapter rounds otherwise at single pixels. Twice as much is another error.
pub const FACTOR: f64 = 2.0;

/// Largest displacement of a point of a frame, in scene units: rounding of depth and of the sprite's rows in f32,
/// some ulp of 1 each.
pub const ROUNDING_OF_POINTS: f64 = 1e-5;

/// Pixels along the rims of holes that may be marked or not: a rim leaves a band of 2/256 px open, so of the pixels on its two sides
/// about 1 in 256.
pub const RIM_SHARE: f64 = 1.0 / 64.0;
