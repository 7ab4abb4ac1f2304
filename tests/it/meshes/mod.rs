//! Meshes: read, mended, split, cut.

pub(crate) mod compressed;
pub(crate) mod defects;
pub(crate) mod files;
pub(crate) mod foreign_files;
pub(crate) mod halves;
pub(crate) mod holes;
pub(crate) mod hostile_meshes;
pub(crate) mod real_caps;
pub(crate) mod real_cuts;
pub(crate) mod real_meshes;
pub(crate) mod real_motions;
pub(crate) mod shapes;
pub(crate) mod slice;
pub(crate) mod split;
pub(crate) mod threemf;
