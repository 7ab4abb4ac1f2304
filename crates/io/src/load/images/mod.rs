//! Images: height maps, textures and TIFF.

pub(super) mod grey_tiff;
pub(super) mod image;
pub(super) mod texture;
