//! A scene packed for upload: data that depends on the scene alone, not on the view or the strategy.

pub(crate) mod cap_materials;
pub(crate) mod classifiers;
pub(crate) mod cutters;
pub(crate) mod ground;
pub(crate) mod heights;
pub(crate) mod model;
pub(crate) mod packed;
pub(crate) mod packed_closing;
pub(crate) mod packed_pose;
pub(crate) mod packed_vertex_paint;
pub(crate) mod preclassified;
pub(crate) mod relief_sky;
pub(crate) mod rest_part;
pub(crate) mod rest_pose;
pub(crate) mod sliced;
pub(crate) mod vertex;
pub(crate) mod vertex_paint;
