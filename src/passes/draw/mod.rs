//! From triangles to layers: passes over the mesh with either rasteriser, and the decision about what each pixel shows.

pub(crate) mod layers;
pub(crate) mod pieces;
pub(crate) mod probe;
pub(crate) mod rasterise;
pub(crate) mod resolve;
pub(crate) mod scan;
pub(crate) mod screen;
pub(crate) mod share;
pub(crate) mod sheet;
pub(crate) mod slabs;
pub(crate) mod solid;
pub(crate) mod store;
pub(crate) mod surface;
pub(crate) mod sweep;
