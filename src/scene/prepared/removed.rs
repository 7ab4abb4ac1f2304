//! Parts that a cut removes entirely: whether closed or open, they have no surface and no cap, in the reference and in all strategies.
//!
//! In an open part, crossings along a ray do not separate inside from outside; but a part wholly on the removed side has no point in
//! a clip-surface, so it has no cap there.
//!
//! Cost: reads the vertices of a part until one is kept: few for a part that is cut.
//!
//! Cannot: read vertices that a device computes; the box of the part is tested instead, which may miss a part that is removed.

use glam::DVec3;

use super::{PreparedCut, PreparedPart, PreparedSurface};

/// Returns true if some cut removes the whole part.
pub(super) fn is_removed(
    part: &PreparedPart,
    cuts: &[PreparedCut],
    surfaces: &[PreparedSurface],
) -> bool {
    part.cuts.iter().any(|cut| {
        let mut numbers = cuts[*cut].surfaces.iter().peekable();
        numbers.peek().is_some() && numbers.all(|s| is_beyond(part, &surfaces[*s]))
    })
}

/// Returns true if the whole part is on the removed side of a clip-surface.
fn is_beyond(part: &PreparedPart, surface: &PreparedSurface) -> bool {
    if surface.volume.is_some() {
        return false;
    }
    let [_, highest] = surface.slab();
    let height = |p: DVec3| (p - surface.origin).dot(surface.frame.normal) + highest;
    let tolerance = part.plane_tolerance;
    let corners = part.bounds.corners().map(height);
    // A part without thickness may be a face in the surface.
    if corners.iter().all(|h| *h >= -tolerance) {
        return false;
    }
    let is_within = |h: f64| h <= tolerance;
    if corners.into_iter().all(is_within) {
        return true;
    }
    let mut heights = part.positions.iter().map(|p| height(p.as_dvec3()));
    let first = heights.next();
    first.is_some_and(is_within)
        && heights.all(is_within)
        && part
            .positions
            .iter()
            .any(|p| height(p.as_dvec3()) < -tolerance)
}
