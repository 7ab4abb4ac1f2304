//! The command.

pub(crate) mod animate;
pub(crate) mod cli;
pub(crate) mod compare;
pub(crate) mod export;
pub(crate) mod full_disk;
pub(crate) mod memory;
pub(crate) mod refusals;
pub(crate) mod section;
pub(crate) mod stdin;
pub(crate) mod supersample;
