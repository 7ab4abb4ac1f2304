//! Keys that place the mesh of a part or the volume of a cut.

use cutaway::scene::describe::{Described, Factors, OrWord};
use glam::DVec3;

use super::ByHand;

/// Placement by scale, rotation and translation, applied in this order, or by a matrix.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct PlacementDesc {
    /// Translation, applied last.
    #[value(unit = "units", example = [0, 0, 1])]
    pub(crate) translate: DVec3,
    /// Rotation about x, then y, then z.
    #[value(unit = "degrees", example = [0, 90, 0])]
    pub(crate) rotate_deg: DVec3,
    /// Scale, applied first.
    #[value(example = 0.5)]
    pub(crate) scale: Option<Factors>,
    /// Point that scale and rotation leave fixed, by default the origin.
    #[value(words = ["centre"], unit = "units", example = [0, 0, 0])]
    pub(crate) pivot: Option<OrWord<DVec3>>,
    /// Matrix with 4 rows of 4 numbers, which replaces translation, rotation, scale and pivot.
    #[value(example = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])]
    pub(crate) matrix: ByHand,
}
