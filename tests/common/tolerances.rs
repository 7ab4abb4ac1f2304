//! Every number that a test forgives by, with its reason. Raising one asks for a look at its negative control.

/// Undecided pixels per covered pixel that are always allowed: the share that a reference may not exceed at the sizes that
/// pictures have.
pub(crate) const UNDECIDED_SHARE: f64 = 1e-3;

/// Undecided pixels per pixel on a boundary of the exact image. An outline leaves a band of 2/256 px undecided, so of the
/// pixels along it about 1 in 128; cap rims add the band of the two faces that meet there. Small pictures are mostly
/// boundary, so the share of the covered area alone grows with 1/size; this part of the bound grows with it.
pub(crate) const UNDECIDED_PER_BOUNDARY_PX: f64 = 1.0 / 32.0;

/// Undecided pixels that a picture may have whatever its size: a bound under a few pixels would test luck.
pub(crate) const UNDECIDED_FLOOR_PX: f64 = 4.0;

/// How far the misclassified share of the depth sprite may be from half of that at half the resolution.
pub(crate) const SPRITE_HALVING: f64 = 0.15;
