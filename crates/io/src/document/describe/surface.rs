//! Entries of `surfaces`, and reliefs on faces.

use cutaway::scene::describe::Described;
use cutaway::scene::relief::Placement;
use glam::DVec3;

/// A relief on faces.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct ReliefUse {
    /// Name of the relief.
    #[value(example = "ragged")]
    pub(crate) relief: Option<String>,
    /// Placement of the relief.
    #[value(flat)]
    pub(crate) placement: Placement,
}

/// A clip-surface as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct SurfaceDesc {
    /// Plane in short form; its normal points to the kept side.
    #[value(example = "z=50%")]
    pub(crate) section: Option<String>,
    /// Normal of the plane, as an alternative to `section`.
    #[value(example = [0, 0, 1])]
    pub(crate) normal: Option<DVec3>,
    /// Point on the plane.
    #[value(unit = "units", example = [0, 0, 0])]
    pub(crate) origin: Option<DVec3>,
    /// Rotation of the plane and its relief about the normal; positive angles turn U towards V.
    #[value(unit = "degrees", example = 30)]
    pub(crate) spin_deg: f64,
    /// Vector U of the plane, in the parametrisation of the paper.
    #[value(unit = "units", example = [1, 0, 0])]
    pub(crate) u: Option<DVec3>,
    /// Vector V of the plane; the side to which U x V points is kept.
    #[value(unit = "units", example = [0, 1, 0])]
    pub(crate) v: Option<DVec3>,
    /// Number of repeats along U and along V, and the height of the relief.
    #[value(example = [4, 4, 0.1])]
    pub(crate) scale: Option<DVec3>,
    /// Relief on the surface.
    #[value(flat)]
    pub(crate) ruffle: ReliefUse,
    /// Keeps the other side.
    #[value(example = true)]
    pub(crate) flip: bool,
}
