//! Inside tests.

pub mod mask;
pub mod stencil;
pub mod vds;
