//! Images: height maps, textures and TIFF.

mod grey_tiff;
pub(super) mod image;
pub(super) mod texture;
