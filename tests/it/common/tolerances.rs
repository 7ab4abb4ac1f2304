//! Every number that a test forgives by, with its reason. Raising one asks for a look at its negative control.

/// Undecided pixels per covered pixel that are always allowed: the share that a reference may not exceed at the sizes that
/// pictures have.
pub(crate) const UNDECIDED_SHARE: f64 = 1e-3;

/// Undecided pixels per pixel on a boundary of the exact image. An outline leaves a band of 2/256 px undecided, so of the
/// pixels along it about 1 in 128; a rim adds the band of each of the faces that meet there. Small pictures are mostly
/// boundary, so the share of the covered area alone grows with 1/size; this part of the bound grows with it.
pub(crate) const UNDECIDED_PER_BOUNDARY_PX: f64 = 1.0 / 64.0;

/// Undecided pixels that one small picture may have by chance: an upright edge can lie along a whole column of samples.
/// Sums over many pictures do without it.
pub(crate) const UNDECIDED_BY_CHANCE_PX: f64 = 60.0;

/// Decided wrong pixels of `grid:128+vds:512` per boundary pixel at 160 x 120. The sprite is off by up to 0.71 of its
/// texels, here 0.15 px to each side of a rim, and the grid by its chord; together they reach one rim sample in eight.
pub(crate) const PAPER_WRONG_PER_BOUNDARY_PX: f64 = 1.0 / 8.0;

/// Decided wrong pixels of `grid:128+mask` per boundary pixel at 160 x 120: the chord of its grid alone moves a rim.
pub(crate) const GRID_WRONG_PER_BOUNDARY_PX: f64 = 1.0 / 8.0;

/// Wrong pixels of `grid:128+vds:512` away from every boundary of kinds and parts: where two faces of one part meet in front of each
/// other the image of kinds has no boundary, but the sprite still errs.
pub(crate) const PAPER_INTERIOR_PX: usize = 3;

/// How far the misclassified share of the depth sprite may be from half of that at half the resolution.
pub(crate) const SPRITE_HALVING: f64 = 0.15;

/// Depths of one cap found in two ways, in scene units: roots are to be right to this, and f32 is to 1e-7.
pub(crate) const SAME_DEPTH: f64 = 1e-5;
