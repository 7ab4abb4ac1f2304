//! Generated meshes: built-in shapes, and defects put into meshes on purpose.

pub mod defects;
pub mod shapes;
