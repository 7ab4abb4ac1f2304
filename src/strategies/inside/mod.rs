//! Inside tests.

pub mod abuffer;
pub mod kbuffer;
pub mod ldi;
pub mod mask;
pub mod stencil;
pub mod vds;
