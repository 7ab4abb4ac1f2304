//! Output of results: files that are whole or not there, and never in the place of an input.

pub(crate) mod layers_file;
pub(crate) mod output;
pub(crate) mod places;
pub(crate) mod results;
