//! Inside tests.

pub mod mask;
pub mod vds;
