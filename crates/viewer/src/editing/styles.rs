//! The numbers of a style by their paths, and changes of them in a document.
//!
//! A document names a style, or has a table with a base and changes on it. A first change makes a table of the name; when the last one is
//! taken back the name is alone again.

use std::str::FromStr;

use cutaway::Result;
use cutaway::scene::style::{
    GhostKind, HatchAnchor, HatchZoom, OcclusionKind, Paper, Shading, Style, Tint,
};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};
use glam::Vec3;

use crate::editing::removal;

/// Values of a style by their paths in a document, such as `style.strokes.cut`. One colour for all parts excludes the lightness of their
/// hues: only the one in effect is listed.
pub fn values(style: &Style) -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("style.paper", paper(style.paper)),
        ("style.ink", color(style.ink)),
        ("style.shading", word(&Shading::ALL, style.shading)),
        ("style.surface.coat", style.coat.into()),
    ];
    all.extend(tint(
        style.surface,
        [
            "style.surface.color",
            "style.surface.lightness",
            "style.surface.chroma",
            "style.surface.warmth",
        ],
    ));
    all.extend(tint(
        style.cap.tint,
        [
            "style.cap.color",
            "style.cap.lightness",
            "style.cap.chroma",
            "style.cap.warmth",
        ],
    ));
    let hatch = &style.hatch;
    let occlusion = &style.occlusion;
    let ghost = &style.ghost;
    let engraving = &style.engraving;
    let numbers = |of: [f32; 3]| Value::from(of.map(exact).to_vec());
    all.extend([
        ("style.hatch.color", color(hatch.color.unwrap_or(style.ink))),
        ("style.hatch.anchor", word(&HatchAnchor::ALL, hatch.anchor)),
        ("style.hatch.zoom", word(&HatchZoom::ALL, hatch.zoom)),
        (
            "style.occlusion.kind",
            word(&OcclusionKind::ALL, occlusion.kind),
        ),
        ("style.occlusion.slices", i64::from(occlusion.slices).into()),
        ("style.occlusion.steps", i64::from(occlusion.steps).into()),
        ("style.ghost.kind", word(&GhostKind::ALL, ghost.kind)),
        ("style.ghost.color", color(ghost.color.unwrap_or(style.ink))),
        ("style.engraving.across", numbers(engraving.across)),
        (
            "style.engraving.across_dark",
            numbers(engraving.across_dark),
        ),
    ]);
    all.extend(numbers_of(style).map(|(path, value)| (path, exact(value).into())));
    all
}

/// Numbers that every style has.
fn numbers_of(style: &Style) -> impl Iterator<Item = (&'static str, f32)> {
    let (cap, gooch, hatch) = (style.cap, &style.gooch, &style.hatch);
    let (occlusion, ghost, shadow) = (&style.occlusion, &style.ghost, &style.shadow);
    let strokes = &style.strokes;
    [
        ("style.cap.light", cap.light),
        ("style.cap.relief", cap.relief),
        ("style.gooch.blue", gooch.blue),
        ("style.gooch.yellow", gooch.yellow),
        ("style.gooch.of_cool", gooch.of_cool),
        ("style.gooch.of_warm", gooch.of_warm),
        ("style.hatch.width", hatch.width),
        ("style.hatch.alpha", hatch.alpha),
        ("style.hatch.angle_deg", hatch.angle_deg),
        ("style.hatch.per_thickness", hatch.per_thickness),
        ("style.hatch.least", hatch.least),
        ("style.hatch.most", hatch.most),
        ("style.hatch.solid_below", hatch.solid_below),
        ("style.occlusion.radius_percent", occlusion.radius_percent),
        ("style.occlusion.blur_percent", occlusion.blur_percent),
        ("style.occlusion.strength", occlusion.strength),
        ("style.occlusion.surface", occlusion.surface),
        ("style.occlusion.cap", occlusion.cap),
        ("style.occlusion.relief", occlusion.relief),
        ("style.ghost.width", ghost.width),
        ("style.ghost.alpha", ghost.alpha),
        ("style.ghost.glass", ghost.glass),
        ("style.shadow.strength", shadow.strength),
        ("style.shadow.spread_deg", shadow.spread_deg),
        ("style.engraving.spacing", style.engraving.spacing),
        ("style.strokes.outline", strokes.outline),
        ("style.strokes.cut", strokes.cut),
        ("style.strokes.part", strokes.part),
        ("style.strokes.face", strokes.face),
        ("style.strokes.contour", strokes.contour),
        ("style.strokes.crease", strokes.crease),
        ("style.strokes.crease_deg", strokes.crease_deg),
        ("style.strokes.depth_px", strokes.depth_px),
    ]
    .into_iter()
}

/// Makes room for a change of a style: the name of one becomes the base of a table.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn make_room(document: &mut Document, path: &str) -> Result<()> {
    let held = document.root().get("style");
    let name = held.and_then(Node::text).map(str::to_owned);
    match name.filter(|_| path.starts_with("style.")) {
        Some(name) => document.set("style", Value::from([("base", name.into())])),
        None => Ok(()),
    }
}

/// Takes a change of a style back, with the tables that hold nothing after it.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn take_back(document: &mut Document, path: &str) -> Result<()> {
    removal::take_out(document, path)?;
    let Some(style) = document.root().get("style").cloned() else {
        return Ok(());
    };
    match (style.get("base"), &style.value) {
        (Some(base), Value::Table(entries)) if entries.len() == 1 => {
            document.remove("style")?;
            document.set("style", base.value.clone())
        }
        _ => Ok(()),
    }
}

fn tint(
    tint: Tint,
    [one, lightness_of, chroma_of, warmth_of]: [&'static str; 4],
) -> Vec<(&'static str, Value)> {
    match tint {
        Tint::Material => Vec::new(),
        Tint::Color(of) => vec![(one, color(of))],
        Tint::Hue {
            lightness,
            chroma,
            warmth,
        } => vec![
            (lightness_of, exact(lightness).into()),
            (chroma_of, exact(chroma).into()),
            (warmth_of, warmth.map(exact).to_vec().into()),
        ],
    }
}

fn paper(paper: Paper) -> Value {
    match paper {
        Paper::None => "transparent".into(),
        Paper::Gradient => "gradient".into(),
        Paper::Color(of) => color(of),
    }
}

/// A colour as documents have it.
pub fn color(srgb: Vec3) -> Value {
    let byte = |channel: f32| (channel.clamp(0.0, 1.0) * 255.0).round() as u8;
    let [r, g, b] = srgb.to_array().map(byte);
    format!("#{r:02x}{g:02x}{b:02x}").into()
}

fn word<T: Copy + PartialEq>(all: &[(&'static str, T)], one: T) -> Value {
    let found = all.iter().find(|(_, of)| *of == one);
    found.map_or("", |(word, _)| *word).into()
}

/// The number that is written as this one is.
fn exact(value: f32) -> f64 {
    f64::from_str(&value.to_string()).unwrap_or(f64::from(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_io::document::paths::PATHS;
    use cutaway_io::document::{named_style, style_names};
    use cutaway_io::load::Assets;

    #[test]
    fn a_table_of_all_values_is_the_style() {
        for name in style_names() {
            let style = named_style(name).expect(name);
            let mut document =
                Document::parse("s.toml", "[[part]]\nshape = \"cube\"\n").expect("a scene");
            for (path, value) in values(&style) {
                assert!(PATHS.iter().any(|p| p.path == path), "{path}");
                document.set(path, value).expect(path);
            }
            let timeline = document.timeline(&mut Assets::default()).expect(name);
            let mut read = timeline.scene().expect(name).style;
            // Without a colour of its own it is that of ink, which the table says.
            read.hatch.color = read.hatch.color.filter(|_| style.hatch.color.is_some());
            read.ghost.color = read.ghost.color.filter(|_| style.ghost.color.is_some());
            let colors =
                |of: Style| format!("{:?} {:?} {:?} {:?}", of.paper, of.ink, of.surface, of.cap);
            assert_eq!(colors(read), colors(style), "{name}");
            assert_eq!(read, style, "{name}");
        }
    }

    #[test]
    fn every_number_of_a_style_is_shown_by_some_style() {
        let shown: Vec<&str> = style_names()
            .flat_map(|name| values(&named_style(name).expect(name)))
            .map(|(path, _)| path)
            .collect();
        let of_styles = PATHS.iter().filter(|p| p.path.starts_with("style."));
        for path in of_styles.filter(|p| p.path != "style.base") {
            assert!(shown.contains(&path.path), "{}", path.path);
        }
    }

    #[test]
    fn a_change_that_is_taken_back_leaves_the_name() {
        for text in ["style = \"ink\"\n\n", ""] {
            let text = format!("{text}[[part]]\nshape = \"cube\"\n");
            let before = Document::parse("s.toml", &text).expect("a scene");
            let mut document = before.clone();
            for path in ["style.strokes.cut", "style.hatch.width"] {
                make_room(&mut document, path).expect("room");
                document.set(path, 2.5).expect("a number");
            }
            assert_ne!(document, before);
            take_back(&mut document, "style.strokes.cut").expect("taken back");
            assert!(document.get("style.hatch.width").is_ok(), "{document}");
            assert!(document.get("style.strokes").is_err(), "{document}");
            take_back(&mut document, "style.hatch.width").expect("taken back");
            assert_eq!(document, before, "{document}");
        }
    }
}
