//! Reads heights from grey TIFF files. Elevation models use them, often with float or signed samples, which the `image` crate cannot read.
//!
//! Float samples are used unchanged. Integers are divided by the largest value of their type, so that signed integers range from -1 to 1.

use std::io::Cursor;

use cutaway::scene::relief::MAX_TEXELS;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult};

/// Width and height of an image in texels, and its heights row by row.
pub(in crate::load) type GreyHeights = ([u32; 2], Vec<f32>);

/// Decodes the heights of a grey TIFF. Returns `None` for a TIFF in colour. An error is the reason for a decoding failure.
pub(in crate::load) fn read(bytes: &[u8]) -> Result<Option<GreyHeights>, String> {
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions().map_err(|e| e.to_string())?;
    match decoder.colortype().map_err(|e| e.to_string())? {
        // One-bit samples are packed, and the `image` crate unpacks them.
        ColorType::Gray(1) => return Ok(None),
        ColorType::Gray(_) | ColorType::Multiband { num_samples: 1, .. } => {}
        ColorType::Multiband { num_samples, .. } => {
            return Err(format!(
                "it has {num_samples} bands: keep the one with the heights"
            ));
        }
        _ => return Ok(None),
    }
    // The size is checked before decoding, because a few bytes can state any size.
    if u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(format!(
            "{width} x {height} is more than {MAX_TEXELS} texels"
        ));
    }
    let heights = match decoder.read_image().map_err(|e| e.to_string())? {
        DecodingResult::F16(all) => all.into_iter().map(f32::from).collect(),
        DecodingResult::F32(all) => all,
        DecodingResult::F64(all) => all.into_iter().map(|h| h as f32).collect(),
        DecodingResult::U8(all) => shares(&all, u8::MAX.into()),
        DecodingResult::U16(all) => shares(&all, u16::MAX.into()),
        DecodingResult::U32(all) => shares(&all, u32::MAX.into()),
        DecodingResult::I8(all) => shares(&all, i8::MAX.into()),
        DecodingResult::I16(all) => shares(&all, i16::MAX.into()),
        DecodingResult::I32(all) => shares(&all, i32::MAX.into()),
        DecodingResult::U64(all) => all
            .iter()
            .map(|h| (*h as f64 / u64::MAX as f64) as f32)
            .collect(),
        DecodingResult::I64(all) => all
            .iter()
            .map(|h| (*h as f64 / i64::MAX as f64) as f32)
            .collect(),
    };
    Ok(Some(([width, height], heights)))
}

fn shares<T: Copy + Into<f64>>(samples: &[T], greatest: f64) -> Vec<f32> {
    let share = |sample: &T| ((*sample).into() / greatest) as f32;
    samples.iter().map(share).collect()
}
