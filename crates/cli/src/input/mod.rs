//! Input of a command line: the scene that results from its arguments, and how to draw it.

pub(crate) mod args;
pub(crate) mod camera;
pub(crate) mod declared;
pub(crate) mod defects;
pub(crate) mod edits;
pub(crate) mod holes;
pub(crate) mod look;
pub(crate) mod roles;
pub(crate) mod sections;
pub(crate) mod shard;
pub(crate) mod split;
pub(crate) mod stdin;
pub(crate) mod subject;
pub(crate) mod unit;
pub(crate) mod when;
