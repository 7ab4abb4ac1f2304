//! Colours, textures and hatches of surfaces and caps.

pub(super) mod cap_material;
pub(super) mod color;
mod color_names;
pub(super) mod hatch_pattern;
pub(super) mod material;
pub(super) mod texture;
pub(super) mod vertex_paint;
