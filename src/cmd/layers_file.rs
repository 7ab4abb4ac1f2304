//! Layers as OpenEXR: one float channel each for depth, kind, part, clip-surface and the normal.
//!
//! `depth` is in the units of the model and infinite where there is nothing, `kind` is 0 for background, 1 for surface, 2
//! for cap, `part` and `clip_surface` count from 0 in the order of the scene and are -1 where there is none, and
//! `normal.X`, `.Y`, `.Z` is a unit vector in the axes of the model. Numbers are exact: no channel is quantised.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec,
    WritableImage,
};

use crate::layers::{Kind, Layer as Pixel, Layers};
use crate::{Error, Result};

/// The bytes of an EXR file. `scale` is scene units per world unit.
pub(super) fn exr(layers: &Layers, scale: f64) -> Result<Vec<u8>> {
    let channel = |name: &str, value: &dyn Fn(&Pixel) -> f32| {
        let samples: Vec<f32> = layers.pixels.iter().map(value).collect();
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    let or_none = |there: bool, number: f32| if there { number } else { -1.0 };
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = [
        channel("depth", &|p| (p.depth / scale) as f32),
        channel("kind", &|p| f32::from(p.kind as u8)),
        channel("part", &|p| {
            or_none(p.kind != Kind::Background, f32::from(p.part))
        }),
        channel("clip_surface", &|p| {
            or_none(p.kind == Kind::Cap, f32::from(p.clip_surface))
        }),
        channel("normal.X", &|p| p.normal.x),
        channel("normal.Y", &|p| p.normal.y),
        channel("normal.Z", &|p| p.normal.z),
    ]
    .into_iter()
    .collect();
    let [width, height] = layers.size_px.map(|s| s as usize);
    let layer = Layer::new(
        (width, height),
        LayerAttributes::named("layers"),
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|e| {
        let mend = "lower --resolution, or leave --layers out";
        Error::input("--layers", format!("cannot be encoded: {e}"), mend)
    })?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers, read};

    #[test]
    fn every_channel_reads_back_as_it_was() {
        let mut layers = Layers::background([3, 2]);
        layers.pixels[4] = Pixel {
            kind: Kind::Cap,
            part: 7,
            clip_surface: 2,
            depth: 1.5,
            normal: glam::Vec3::new(0.6, 0.0, -0.8),
            ..Pixel::default()
        };
        let bytes = exr(&layers, 0.5).unwrap();
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap();
        let channels = &image.layer_data.channel_data.list;
        let value = |name: &str, pixel: usize| {
            let found = channels.iter().find(|c| c.name.to_string() == name);
            let samples = &found
                .unwrap_or_else(|| panic!("no channel {name}"))
                .sample_data;
            samples.values_as_f32().nth(pixel).unwrap()
        };
        let expected = [
            ("depth", 3.0),
            ("kind", 2.0),
            ("part", 7.0),
            ("clip_surface", 2.0),
            ("normal.X", 0.6),
            ("normal.Y", 0.0),
            ("normal.Z", -0.8),
        ];
        for (name, v) in expected {
            assert_eq!(value(name, 4), v, "{name}");
        }
        assert_eq!(value("depth", 0), f32::INFINITY);
        assert_eq!([value("part", 0), value("clip_surface", 0)], [-1.0; 2]);
        assert_eq!(channels.len(), expected.len());
    }
}
