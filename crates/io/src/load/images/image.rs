//! Offset maps from image files.
//!
//! Heights are data, not colours. Integer samples are divided by their largest possible value but not linearised, so the sRGB curve of a
//! PNG has no effect. Colour is converted to luma (Rec. 709 weights), and alpha is ignored. Float samples (EXR, TIFF with 16, 32 or 64
//! bits) are used unchanged. The top row of the image is at `t = 0`, so `V` points down in the picture.

use std::io::Cursor;
use std::path::Path;

use cutaway::error::{Error, Result};
use cutaway::scene::OffsetMap;
use cutaway::scene::relief::MAX_TEXELS;
use exr::prelude::{ReadChannels, ReadLayers};
use image::{DynamicImage, ImageFormat, ImageReader};

use super::grey_tiff;
use crate::load::{Disk, Files, input_file};

const FORMATS: &str = "give a PNG, JPEG, TIFF, BMP, PNM, TGA or EXR file";

/// Reads an image from disk as heights.
pub fn read_offset_map(path: &Path) -> Result<OffsetMap> {
    read_offset_map_from(path, &Disk)
}

/// Reads an image as heights from a host's store.
///
/// # Errors
///
/// Fails like [`read_offset_map`] if the file is missing or is not a height image.
pub fn read_offset_map_from(path: &Path, store: &dyn Files) -> Result<OffsetMap> {
    let bytes = input_file::read(path, store)?;
    let undecodable = |e: String| Error::file(path, format!("cannot be decoded: {e}"), FORMATS);
    let extension = path.extension().unwrap_or_default();
    let (size, texels) = if extension.eq_ignore_ascii_case("exr") {
        read_exr(path, &bytes)?
    } else {
        let mut reader = ImageReader::new(Cursor::new(&*bytes));
        // The file name is used if the first bytes do not identify the format.
        if let Ok(by_name) = ImageFormat::from_path(path) {
            reader.set_format(by_name);
        }
        let reader = reader
            .with_guessed_format()
            .map_err(|e| undecodable(e.to_string()))?;
        let grey = match reader.format() {
            Some(ImageFormat::Tiff) => grey_tiff::read(&bytes).map_err(undecodable)?,
            _ => None,
        };
        match grey {
            Some(map) => map,
            None => {
                let picture = reader.decode().map_err(|e| undecodable(e.to_string()))?;
                ([picture.width(), picture.height()], heights(&picture))
            }
        }
    };
    if u64::from(size[0]) * u64::from(size[1]) > MAX_TEXELS {
        let what = format!("{} x {} is more than {MAX_TEXELS} texels", size[0], size[1]);
        return Err(Error::file(
            path,
            what,
            "scale the image down, for example to 4096 x 4096",
        ));
    }
    OffsetMap::new(size, texels).map_err(|what| {
        let help = "heights must be finite: replace such pixels, for example by 0";
        Error::file(path, what, help)
    })
}

fn heights(picture: &DynamicImage) -> Vec<f32> {
    match picture {
        DynamicImage::ImageLuma8(i) => luma(i.as_raw(), 1, 255),
        DynamicImage::ImageLumaA8(i) => luma(i.as_raw(), 2, 255),
        DynamicImage::ImageRgb8(i) => luma(i.as_raw(), 3, 255),
        DynamicImage::ImageRgba8(i) => luma(i.as_raw(), 4, 255),
        DynamicImage::ImageLuma16(i) => luma(i.as_raw(), 1, 65_535),
        DynamicImage::ImageLumaA16(i) => luma(i.as_raw(), 2, 65_535),
        DynamicImage::ImageRgb16(i) => luma(i.as_raw(), 3, 65_535),
        DynamicImage::ImageRgba16(i) => luma(i.as_raw(), 4, 65_535),
        // Float images use the same weights, but are not divided.
        other => other
            .to_rgb32f()
            .pixels()
            .map(|p| {
                let [r, g, b] = p.0.map(f64::from);
                let grey = r == g && g == b;
                (if grey {
                    r
                } else {
                    0.2126 * r + 0.7152 * g + 0.0722 * b
                }) as f32
            })
            .collect(),
    }
}

/// Luma divided by the largest value. With integer weights and a single division at the end, a grey pixel has the same height whether it is
/// stored as grey or as RGB.
fn luma<T: Copy + Into<u64>>(samples: &[T], channels: usize, greatest: u64) -> Vec<f32> {
    samples
        .chunks_exact(channels)
        .map(|p| {
            let weighted = match p {
                [r, g, b] | [r, g, b, _] => {
                    2126 * (*r).into() + 7152 * (*g).into() + 722 * (*b).into()
                }
                _ => 10_000 * p[0].into(),
            };
            (weighted as f64 / (10_000 * greatest) as f64) as f32
        })
        .collect()
}

/// Reads channel Y of the first layer or, if there is none, its channel R or its only channel.
fn read_exr(path: &Path, bytes: &[u8]) -> Result<([u32; 2], Vec<f32>)> {
    let image = exr::image::read::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| Error::file(path, format!("is not a readable EXR: {e}"), FORMATS))?;
    let layer = image.layer_data;
    let channels = &layer.channel_data.list;
    let named = |name: &str| channels.iter().find(|c| c.name.eq_case_insensitive(name));
    let only = || match channels.as_slice() {
        [one] => Some(one),
        _ => None,
    };
    let Some(channel) = named("Y").or_else(|| named("R")).or_else(only) else {
        let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
        let what = format!(
            "none of the channels {} is recognized as the height",
            names.join(", ")
        );
        return Err(Error::file(
            path,
            what,
            "name the height channel Y or R, or keep only one",
        ));
    };
    let size =
        [layer.size.width(), layer.size.height()].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
    Ok((size, channel.sample_data.values_as_f32().collect()))
}
