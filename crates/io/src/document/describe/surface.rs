//! Entries of `surfaces`, and the relief of a face.

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
    /// Plane whose normal points to the kept side.
    #[value(example = "z=50%")]
    pub(crate) section: Option<String>,
    /// Normal of a plane, instead of a section.
    #[value(example = [0, 0, 1])]
    pub(crate) normal: Option<DVec3>,
    /// Point on the plane.
    #[value(unit = "units", example = [0, 0, 0])]
    pub(crate) origin: Option<DVec3>,
    /// Rotation of the plane and its relief about the normal, from U towards V.
    #[value(unit = "degrees", example = 30)]
    pub(crate) spin_deg: f64,
    /// Vector U of the paper's parametrisation.
    #[value(unit = "units", example = [1, 0, 0])]
    pub(crate) u: Option<DVec3>,
    /// Vector V; the side of U x V is kept.
    #[value(unit = "units", example = [0, 1, 0])]
    pub(crate) v: Option<DVec3>,
    /// Repeats along U and V, and height.
    #[value(example = [4, 4, 0.1])]
    pub(crate) scale: Option<DVec3>,
    /// Relief on the surface.
    #[value(flat)]
    pub(crate) ruffle: ReliefUse,
    /// Keeps the other side.
    #[value(example = true)]
    pub(crate) flip: bool,
}
