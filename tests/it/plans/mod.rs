//! Plans, and the shaders that they run.

pub(crate) mod auto;
pub(crate) mod controls;
pub(crate) mod height_filter;
pub(crate) mod plan;
pub(crate) mod shaders;
pub(crate) mod strategies;
pub(crate) mod words;
