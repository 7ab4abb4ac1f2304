//! Tolerances that apply to all hard cases, each with its reason; tolerances of a single case are in its file. Whoever raises a tolerance
//! must check its negative control.

/// Tolerance factor on found errors that have no theoretical bound: errors may be up to this many times as large and, for failures, as
/// small as 1 / `FACTOR`, because another adapter rounds single pixels differently. Beyond twice as much, the error is a different one.
pub const FACTOR: f64 = 2.0;

/// Largest displacement of a point in a frame, in scene units: the depth and the sprite's rows are rounded to f32,
/// by some ulp of 1 each.
pub const ROUNDING_OF_POINTS: f64 = 1e-5;

/// Share of the pixels along the rims of holes that may be marked or not. A rim leaves a band of 2/256 px open, which contains about
/// 1 in 256 of the pixels on the rim's two sides.
pub const RIM_SHARE: f64 = 1.0 / 64.0;
