//! `[roles]`.

use cutaway::scene::describe::Described;

/// Roles that parts get from globs on their names, or from their visibility from outside.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct RolesDesc {
    /// Makes parts interior if they are not visible from outside; roles = "auto" is the short form.
    #[value(fixed, example = true)]
    pub(crate) auto: bool,
    /// Globs of parts that are never cut.
    #[value(example = ["*core*"])]
    pub(crate) interior: Vec<String>,
    /// Globs of parts that are cut.
    #[value(example = ["housing*"])]
    pub(crate) exterior: Vec<String>,
    /// Globs of parts that are never cut, but are hidden if they lie entirely in the removed region.
    #[value(example = ["bolt*", "shaft*"])]
    pub(crate) whole: Vec<String>,
}
