//! `[[cut]]`.

use std::path::PathBuf;

use cutaway::scene::describe::Described;

use super::PlacementDesc;

/// A cut as stored in a file. Its surfaces, regions and offsets are read separately.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct CutDesc {
    /// Name that paths use for the cut.
    #[value(example = "front")]
    pub(crate) name: Option<String>,
    /// Applies the cut.
    #[value(example = true)]
    pub(crate) enabled: Option<bool>,
    /// Globs of the parts to cut.
    #[value(example = ["*"])]
    pub(crate) applies_to: Vec<String>,
    /// Globs of the parts to leave uncut.
    #[value(example = ["bolt*"])]
    pub(crate) except: Vec<String>,
    /// Closed mesh whose inside is removed, from a file or a built-in shape.
    #[value(example = "shape:sphere")]
    pub(crate) volume: Option<PathBuf>,
    /// Placement of the volume.
    #[value(flat)]
    pub(crate) placement: PlacementDesc,
    /// Removes everything outside the volume, instead of everything inside.
    #[value(example = true)]
    pub(crate) flip: bool,
}
