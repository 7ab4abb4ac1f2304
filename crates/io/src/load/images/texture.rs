//! Textures from image files, with 8 bits per channel and no colour conversion.

use std::io::Cursor;
use std::path::Path;

use cutaway::error::{Error, Result};
use cutaway::scene::{MOST_TEXELS_ALONG, Texture, TextureKind};
use image::{GenericImageView, ImageFormat, ImageReader, Limits};

use crate::load::{Files, input_file};

/// Reads an image as a texture from a host's store.
///
/// # Errors
///
/// Fails if the file is missing, is not a PNG, JPEG, TIFF, BMP, PNM or TGA, or exceeds [`MOST_TEXELS_ALONG`] along a side.
pub fn read_texture_from(path: &Path, kind: TextureKind, store: &dyn Files) -> Result<Texture> {
    let bytes = input_file::read(path, store)?;
    let by_name = ImageFormat::from_path(path).ok();
    texture_of(&bytes, by_name, kind).map_err(|what| {
        let help = format!(
            "give a PNG, JPEG, TIFF, BMP, PNM or TGA of at most {MOST_TEXELS_ALONG} x {MOST_TEXELS_ALONG} pixels"
        );
        Error::file(path, what, help)
    })
}

/// Decodes a texture from the bytes of an image file. The bytes or, failing that, the name identify the format. Errors are messages.
pub(in crate::load) fn texture_of(
    bytes: &[u8],
    by_name: Option<ImageFormat>,
    kind: TextureKind,
) -> Result<Texture, String> {
    let undecodable = |e: &dyn std::fmt::Display| format!("cannot be decoded: {e}");
    let mut reader = ImageReader::new(Cursor::new(bytes));
    // The file name is used if the first bytes do not identify the format.
    if let Some(format) = by_name {
        reader.set_format(format);
    }
    let mut reader = reader.with_guessed_format().map_err(|e| undecodable(&e))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST_TEXELS_ALONG);
    limits.max_image_height = Some(MOST_TEXELS_ALONG);
    reader.limits(limits);
    let picture = reader.decode().map_err(|e| undecodable(&e))?;
    let size = <[u32; 2]>::from(picture.dimensions());
    let rgba = picture.into_rgba8().into_raw();
    Texture::new(size, rgba.as_chunks::<4>().0.to_vec(), kind)
}
