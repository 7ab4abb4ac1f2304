//! Shader programs as pipelines: their bindings, and when they are created.

pub(super) mod bind;
pub(super) mod pipelines;
pub(super) mod preparation;
pub(super) mod program;
