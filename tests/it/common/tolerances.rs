//! Every number that a test forgives by, with its reason. Raising one asks for a look at its negative control.
//!
//! What an adapter may do worse that has fewer sub-pixel bits than 8 is here too, and nowhere else: what hangs on how far vertices are
//! moved grows with [`coarseness`](super::coarseness), and [`holds_lower_bounds`] says where an error must be seen.

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

/// Depth of a cap that is drawn as triangles, beside its plane, in scene units at 64 px: vertices move by up to 1/512 px along each axis,
/// of which a pixel is 0.04 units long, along a slope of less than 2.
pub(crate) const FLAT_CAP_DEPTH: f64 = 1e-4;

/// Smooth normals beside those of exact, at 160 px, where triangles are some 7 px wide and normals 16 degrees apart at their corners:
/// 1/512 px along each axis.
pub(crate) const CORNER_NORMAL: f64 = 1e-3;

/// Depth of a cutter's walls, in edge lengths of a pixel, whatever their slope.
pub(crate) const CUTTER_DEPTH_PX: f64 = 0.02;

/// Pixels of 4,096 in which a million triangles differ by rasteriser.
pub(crate) const MILLION_TRIANGLES_PX: f64 = 2.0;

/// Pixels that leak through slivers that vertices leave which round off an edge.
pub(crate) const ROUNDED_SLIVERS_PX: f64 = 2.0;

/// What is allowed in addition with fewer bits than 8: the bounds above were found with 8, and single samples were found a quarter beyond
/// what follows from them. Twice that is let pass.
pub(crate) fn coarse_room() -> f64 {
    if holds_lower_bounds() { 1.0 } else { 1.5 }
}

/// Whether errors of tessellations and images, and depths of needles, are held to bounds from below, or from view to view. With fewer bits
/// exact is sure of fewer pixels along outlines, which is where these errors are, and a needle is narrower than a step.
pub(crate) fn holds_lower_bounds() -> bool {
    super::coarseness() <= 1.0
}
