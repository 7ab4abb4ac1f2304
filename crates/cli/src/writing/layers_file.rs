//! Layers as OpenEXR: one float channel each for depth, kind, part, clip-surface, the normal and whether the pixel may be wrong.
//!
//! `depth` is in model units and infinite for background, `kind` is 0 for background, 1 for surface, 2
//! for cap, `part` and `clip_surface` count from 0 in scene order and are -1 for none,
//! `normal.X`, `.Y`, `.Z` is a unit vector in the model's axes, and `unreliable` is 1 if the pixel may be wrong
//! ([`may_be_wrong`](cutaway_lab::compare::may_be_wrong)). No channel is quantised.
//!
//! A style with strokes, hatches or occlusion adds channels. `stroke` and `hatch` are the share of the pixel that strokes and hatch lines
//! cover. `cap.U` and `cap.V` are the pixel's position on the plane of its hatch, to the right and up. `occlusion` is the share of the
//! light that remains.
//!
//! Attributes explain the values: `parts` lists the part names by number, `clip_surfaces` lists, for each clip-surface, the name of
//! its cut, `units` lists the units of the channels, and `camera.*` describes the viewpoint, in model space.

use std::io::Cursor;

use cutaway::layers::{Kind, Layer as Pixel, Layers};
use cutaway::scene::{Prepared, Scene, View};
use cutaway::session::StyleChannels;
use cutaway::{Error, Result};
use exr::prelude::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage,
};
use glam::DVec3;

/// Input for the file.
pub(crate) struct LayersSource<'a> {
    pub(crate) scene: &'a Scene,
    /// The scene in scene space.
    pub(crate) prepared: &'a Prepared,
    /// Camera of the frame.
    pub(crate) view: &'a View,
    /// For each pixel in order, true if its layers may be wrong.
    pub(crate) may_be_wrong: &'a [bool],
    /// Additional channels drawn by the style.
    pub(crate) drawn: &'a StyleChannels,
}

impl LayersSource<'_> {
    /// Attributes by name.
    fn attributes(&self) -> Vec<(&'static str, AttributeValue)> {
        let text = |t: &str| AttributeValue::Text(Text::new_or_none(t).unwrap_or_default());
        let texts = |all: Vec<&str>| {
            let all = all
                .into_iter()
                .map(|t| Text::new_or_none(t).unwrap_or_default());
            AttributeValue::TextVector(all.collect())
        };
        let vector = |v: DVec3| AttributeValue::FloatVec3((v.x as f32, v.y as f32, v.z as f32));
        let (prepared, view) = (self.prepared, self.view);
        let position = view.eye / prepared.scale + prepared.centre_in_world;
        let surfaces = prepared.surfaces.iter();
        let (projection, opening) = if view.orthographic {
            let height = 2.0 * view.half_height / prepared.scale;
            ("orthographic", ("camera.height", height))
        } else {
            let fov_y = 2.0 * view.half_height.atan();
            ("perspective", ("camera.fov_y_deg", fov_y.to_degrees()))
        };
        let all = vec![
            ("scene", text(&self.scene.name)),
            (
                "parts",
                texts(self.scene.parts.iter().map(|p| p.name.as_str()).collect()),
            ),
            (
                "clip_surfaces",
                texts(
                    surfaces
                        .map(|s| prepared.cuts[s.cut].name.as_str())
                        .collect(),
                ),
            ),
            (
                "units",
                text(
                    "depth: units of the model, along camera.forward; normal: axes of the model; angles: degrees; cap: units of the model",
                ),
            ),
            ("camera.position", vector(position)),
            ("camera.forward", vector(view.forward)),
            ("camera.up", vector(view.up)),
            ("camera.projection", text(projection)),
            (opening.0, AttributeValue::F32(opening.1 as f32)),
            (
                "camera.near",
                AttributeValue::F32((view.near / prepared.scale) as f32),
            ),
        ];
        // Empty lists are left out, because the format does not allow them.
        let is_there = |(_, value): &(_, AttributeValue)| !matches!(value, AttributeValue::TextVector(v) if v.is_empty());
        all.into_iter().filter(is_there).collect()
    }
}

/// The bytes of an EXR file.
pub(crate) fn exr(layers: &Layers, about: &LayersSource<'_>) -> Result<Vec<u8>> {
    let scale = about.prepared.scale;
    let channel = |name: &str, value: &dyn Fn(&Pixel) -> f32| {
        let samples: Vec<f32> = layers.pixels.iter().map(value).collect();
        AnyChannel::new(name, FlatSamples::F32(samples))
    };
    let unreliable = about.may_be_wrong.iter().map(|w| f32::from(u8::from(*w)));
    let unreliable: Vec<f32> = unreliable.collect();
    let or_none = |there: bool, number: f32| if there { number } else { -1.0 };
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = [
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
        AnyChannel::new("unreliable", FlatSamples::F32(unreliable)),
    ]
    .into_iter()
    .collect();
    let drawn = about.drawn;
    let on_cap = |axis: usize| {
        let places = drawn.cap_uv.iter();
        places
            .map(|uv| (f64::from(uv[axis]) / scale) as f32)
            .collect()
    };
    for (name, samples) in [
        ("stroke", drawn.stroke.clone()),
        ("hatch", drawn.hatch.clone()),
        ("cap.U", on_cap(0)),
        ("cap.V", on_cap(1)),
        ("occlusion", drawn.visibility.clone()),
    ] {
        if !samples.is_empty() {
            channels.push(AnyChannel::new(name, FlatSamples::F32(samples)));
        }
    }
    let [width, height] = layers.size_px.map(|s| s as usize);
    let mut attributes = LayerAttributes::named("layers");
    let named = about.attributes().into_iter();
    attributes
        .other
        .extend(named.map(|(name, value)| (Text::from(name), value)));
    let layer = Layer::new(
        (width, height),
        attributes,
        Encoding::FAST_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut bytes = Cursor::new(Vec::new());
    let written = Image::from_layer(layer).write().to_buffered(&mut bytes);
    written.map_err(|e| {
        let help = "lower --resolution, or leave --layers out";
        Error::input("--layers", format!("cannot be encoded: {e}"), help)
    })?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_lab::hard_cases::scenes;
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
        let mut scene = scenes::sectioned("shells", &["-z=0"]);
        scene.camera = scenes::parallel(DVec3::new(1.0, 2.0, 8.0), DVec3::new(1.0, 2.0, 0.0), 6.0);
        let prepared = Prepared::new(&scene);
        let scale = prepared.scale;
        let mut may_be_wrong = vec![false; 6];
        may_be_wrong[4] = true;
        let drawn = StyleChannels {
            hatch: vec![0.25; 6],
            cap_uv: vec![[1.0, -2.0]; 6],
            ..StyleChannels::default()
        };
        let about = LayersSource {
            scene: &scene,
            prepared: &prepared,
            view: &prepared.view([3, 2]),
            may_be_wrong: &may_be_wrong,
            drawn: &drawn,
        };
        let bytes = exr(&layers, &about).unwrap();
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
            ("depth", (1.5 / scale) as f32),
            ("kind", 2.0),
            ("part", 7.0),
            ("clip_surface", 2.0),
            ("normal.X", 0.6),
            ("normal.Y", 0.0),
            ("normal.Z", -0.8),
            ("unreliable", 1.0),
            ("hatch", 0.25),
            ("cap.U", (1.0 / scale) as f32),
            ("cap.V", (-2.0 / scale) as f32),
        ];
        for (name, v) in expected {
            assert_eq!(value(name, 4), v, "{name}");
        }
        assert_eq!(value("depth", 0), f32::INFINITY);
        assert_eq!([value("part", 0), value("clip_surface", 0)], [-1.0; 2]);
        assert_eq!(value("unreliable", 0), 0.0);
        assert_eq!(channels.len(), expected.len());

        let attributes = &image.layer_data.attributes.other;
        let attribute = |name: &str| {
            let found = attributes.get(&Text::from(name));
            found
                .unwrap_or_else(|| panic!("no attribute {name}"))
                .clone()
        };
        let AttributeValue::TextVector(parts) = attribute("parts") else {
            panic!("names are a list");
        };
        let parts: Vec<String> = parts.iter().map(ToString::to_string).collect();
        let names: Vec<&str> = scene.parts.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(parts, names);
        let AttributeValue::FloatVec3((x, y, z)) = attribute("camera.position") else {
            panic!("a position is a vector");
        };
        let off = [x - 1.0, y - 2.0, z - 8.0].map(f32::abs);
        assert!(off.iter().all(|d| *d < 1e-5), "{off:?}");
        assert_eq!(
            attribute("camera.forward"),
            AttributeValue::FloatVec3((0.0, 0.0, -1.0))
        );
        assert_eq!(
            attribute("camera.projection"),
            AttributeValue::Text("orthographic".into())
        );
        let AttributeValue::F32(height) = attribute("camera.height") else {
            panic!("a height is a number");
        };
        assert!((height - 6.0).abs() < 1e-5, "{height}");
        assert!(
            matches!(attribute("units"), AttributeValue::Text(_)),
            "units"
        );
    }
}
