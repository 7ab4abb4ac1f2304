//! `[[cut]]`.

use std::path::PathBuf;

use cutaway::scene::describe::Described;

use super::PlacementDesc;

/// A cut as stored in a file, without its surfaces, regions and offsets.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct CutDesc {
    /// Name in paths.
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
    /// Closed mesh that cuts: a file, or a shape.
    #[value(example = "shape:sphere")]
    pub(crate) volume: Option<PathBuf>,
    /// Placement of the volume.
    #[value(flat)]
    pub(crate) placement: PlacementDesc,
    /// Removes what is outside the volume.
    #[value(example = true)]
    pub(crate) flip: bool,
}
