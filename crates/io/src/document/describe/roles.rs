//! `[roles]`.

use cutaway::scene::describe::Described;

/// Roles of parts by globs, or by visibility from outside.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct RolesDesc {
    /// Makes parts interior if they are not visible from outside; short form: roles = "auto".
    #[value(fixed, example = true)]
    pub(crate) auto: bool,
    /// Globs of parts that are never cut.
    #[value(example = ["*core*"])]
    pub(crate) interior: Vec<String>,
    /// Globs of parts that are cut.
    #[value(example = ["housing*"])]
    pub(crate) exterior: Vec<String>,
    /// Globs of parts that are never cut, but hidden where they are removed entirely.
    #[value(example = ["bolt*", "shaft*"])]
    pub(crate) whole: Vec<String>,
}
