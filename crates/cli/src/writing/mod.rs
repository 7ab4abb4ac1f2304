//! Output of results: files are written completely or not at all, and never replace an input.

pub(crate) mod layers_file;
pub(crate) mod output;
pub(crate) mod places;
pub(crate) mod results;
