//! Lengths of a style: their unit and their largest value.

/// Unit of lengths.
pub(super) const MIL: &str = "1/1000 of the height";

/// Largest line width, in that unit.
pub(super) const WIDEST: f64 = 20.0;
