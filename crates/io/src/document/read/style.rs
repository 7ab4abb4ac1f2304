//! `style = "NAME"` or `[style]`: a base and changes on it.
//!
//! A base is one of the styles that come with the program, or a file of one, opened when the document is. Numbers of `[style]` may move.

use std::path::Path;

use cutaway::error::{Error, Result, did_you_mean};
use cutaway::scene::style::{
    Engraving, Ghost, GhostKind, Hatch, HatchAnchor, HatchZoom, Occlusion, OcclusionKind, Paper,
    Shading, Style, Tint,
};

use super::opening::{Opening, missing};
use super::reader::{Entry, Table};
use super::settings::color;
use super::table::with_table;
use crate::document::Keys;
use crate::load::Assets;

static KEYS: Keys = Keys::below("style");
static STROKES: Keys = Keys::below("style.strokes");
static SURFACE: Keys = Keys::below("style.surface");
static CAP: Keys = Keys::below("style.cap");
static HATCH: Keys = Keys::below("style.hatch");
static GOOCH: Keys = Keys::below("style.gooch");
static OCCLUSION: Keys = Keys::below("style.occlusion");
static GHOST: Keys = Keys::below("style.ghost");
static SHADOW: Keys = Keys::below("style.shadow");
static ENGRAVING: Keys = Keys::below("style.engraving");

/// Built-in styles of the program, in addition to `lit`, which is the default of the library.
const STYLES: [(&str, &str); 8] = [
    ("technical", include_str!("../styles/technical.toml")),
    ("drafting", include_str!("../styles/drafting.toml")),
    ("gooch", include_str!("../styles/gooch.toml")),
    ("toon", include_str!("../styles/toon.toml")),
    ("ink", include_str!("../styles/ink.toml")),
    ("blueprint", include_str!("../styles/blueprint.toml")),
    ("clay", include_str!("../styles/clay.toml")),
    ("vivid", include_str!("../styles/vivid.toml")),
];

/// Names of the styles that come with the program.
pub fn style_names() -> impl Iterator<Item = &'static str> {
    ["lit"].into_iter().chain(STYLES.map(|(name, _)| name))
}

/// A style that comes with the program.
///
/// # Errors
///
/// A name that none has.
pub fn named_style(name: &str) -> Result<Style> {
    if name == "lit" {
        return Ok(Style::default());
    }
    match STYLES.iter().find(|(known, _)| *known == name) {
        Some((name, text)) => of_text(Path::new(&format!("{name}.toml")), text),
        None => {
            let help = format!(
                "{}, or name a file: my.toml",
                did_you_mean(name, style_names())
            );
            Err(Error::input(
                format!("style `{name}`"),
                "there is no such style",
                help,
            ))
        }
    }
}

fn of_text(path: &Path, text: &str) -> Result<Style> {
    with_table(path, text, KEYS.all(), |table| {
        let mut style = match table.get("base") {
            Some(base) => named_style(base.text()?).map_err(|e| base.place(e))?,
            None => Style::default(),
        };
        amend(&mut style, table)?;
        Ok(style)
    })
}

/// Returns true if a base is a file.
pub(in crate::document) fn is_file(base: &str) -> bool {
    base.ends_with(".toml")
}

/// The base of a document, if it names one.
pub(super) fn open(root: &Table<'_>, opening: &mut Opening<'_>) -> Result<Option<Style>> {
    let Some(base) = base(root)? else {
        return Ok(None);
    };
    let name = base.text()?;
    if !is_file(name) {
        return named_style(name).map(Some).map_err(|e| base.place(e));
    }
    let path = opening.folder.join(name);
    let bytes = opening.assets.store().read(&path).map_err(|e| {
        let help = "name a file of a style, or a style that there is: cutaway render --help";
        base.fault(format_args!("{} cannot be read: {e}", path.display()), help)
    })?;
    let text = String::from_utf8(bytes.into_owned()).map_err(|_| {
        base.fault(
            format_args!("{} is no text", path.display()),
            "write it as UTF-8",
        )
    })?;
    let style = of_text(&path, &text)?;
    opening.files.insert(path);
    Ok(Some(style))
}

/// Checks what can be checked before a file is opened.
pub(super) fn check(root: &Table<'_>, folder: &Path, assets: &Assets) -> Result<()> {
    if let Some(base) = base(root)? {
        let name = base.text()?;
        if !is_file(name) {
            named_style(name).map_err(|e| base.place(e))?;
        } else if !assets.store().is_file(&folder.join(name)) {
            return Err(missing(&base, &folder.join(name)));
        }
    }
    read(root, Style::default()).map(|_| ())
}

/// The name of the base, if there is one.
fn base<'a>(root: &Table<'a>) -> Result<Option<Entry<'a>>> {
    match root.get("style") {
        Some(entry) if entry.is_text() => Ok(Some(entry)),
        Some(entry) => Ok(entry.table(KEYS.all())?.get("base")),
        None => Ok(None),
    }
}

/// The style of a document on its base, at the time of its numbers.
pub(super) fn read(root: &Table<'_>, base: Style) -> Result<Style> {
    let mut style = base;
    if let Some(entry) = root.get("style").filter(|entry| !entry.is_text()) {
        amend(&mut style, &entry.table(KEYS.all())?)?;
    }
    if let Some(background) = root.get("background")
        && !(background.is_text() && background.text()? == "paper")
    {
        style.paper = paper(&background)?;
    }
    Ok(style)
}

fn paper(entry: &Entry<'_>) -> Result<Paper> {
    match entry.text()? {
        "transparent" | "none" => Ok(Paper::None),
        "gradient" => Ok(Paper::Gradient),
        _ => color(entry).map(Paper::Color),
    }
}

fn amend(style: &mut Style, table: &Table<'_>) -> Result<()> {
    if let Some(entry) = table.get("paper") {
        style.paper = paper(&entry)?;
    }
    if let Some(entry) = table.get("ink") {
        style.ink = color(&entry)?;
    }
    if let Some(entry) = table.get("shading") {
        style.shading = entry.choice(&Shading::ALL)?;
    }
    if let Some(entry) = table.get("surface") {
        let table = entry.table(SURFACE.all())?;
        let before = style.surface;
        tint(&mut style.surface, &table)?;
        let coat = table.get("coat").map(|coat| coat.flag()).transpose()?;
        style.coat = coat.unwrap_or(style.coat && style.surface == before);
    }
    if let Some(entry) = table.get("cap") {
        let table = entry.table(CAP.all())?;
        tint(&mut style.cap.tint, &table)?;
        set(&mut style.cap.light, &table, "light", 1.0)?;
        set(&mut style.cap.relief, &table, "relief", 1.0)?;
    }
    if let Some(entry) = table.get("gooch") {
        let table = entry.table(GOOCH.all())?;
        let gooch = &mut style.gooch;
        for (slot, key) in [
            (&mut gooch.blue, "blue"),
            (&mut gooch.yellow, "yellow"),
            (&mut gooch.of_cool, "of_cool"),
            (&mut gooch.of_warm, "of_warm"),
        ] {
            set(slot, &table, key, 1.0)?;
        }
    }
    if let Some(entry) = table.get("hatch") {
        hatch(&mut style.hatch, &entry.table(HATCH.all())?)?;
    }
    if let Some(entry) = table.get("occlusion") {
        occlusion(&mut style.occlusion, &entry.table(OCCLUSION.all())?)?;
    }
    if let Some(entry) = table.get("ghost") {
        ghost(&mut style.ghost, &entry.table(GHOST.all())?)?;
    }
    if let Some(entry) = table.get("shadow") {
        let table = entry.table(SHADOW.all())?;
        set(&mut style.shadow.strength, &table, "strength", 1.0)?;
        set(&mut style.shadow.spread_deg, &table, "spread_deg", 70.0)?;
    }
    if let Some(entry) = table.get("engraving") {
        engraving(&mut style.engraving, &entry.table(ENGRAVING.all())?)?;
    }
    if let Some(entry) = table.get("strokes") {
        let table = entry.table(STROKES.all())?;
        let strokes = &mut style.strokes;
        for (slot, key, most) in [
            (&mut strokes.outline, "outline", WIDEST),
            (&mut strokes.cut, "cut", WIDEST),
            (&mut strokes.part, "part", WIDEST),
            (&mut strokes.face, "face", WIDEST),
            (&mut strokes.contour, "contour", WIDEST),
            (&mut strokes.crease, "crease", WIDEST),
            (&mut strokes.crease_deg, "crease_deg", 180.0),
            (&mut strokes.depth_px, "depth_px", 1e6),
        ] {
            set(slot, &table, key, most)?;
        }
        // Less would take the rounding of normals for folds.
        strokes.crease_deg = strokes.crease_deg.max(1.0);
    }
    Ok(())
}

fn hatch(hatch: &mut Hatch, table: &Table<'_>) -> Result<()> {
    if let Some(entry) = table.get("color") {
        hatch.color = Some(color(&entry)?);
    }
    if let Some(entry) = table.get("anchor") {
        hatch.anchor = entry.choice(&HatchAnchor::ALL)?;
    }
    if let Some(entry) = table.get("zoom") {
        hatch.zoom = entry.choice(&HatchZoom::ALL)?;
    }
    if let Some(entry) = table.get("angle_deg") {
        hatch.angle_deg = entry.number()? as f32;
    }
    for (slot, key, most) in [
        (&mut hatch.width, "width", WIDEST),
        (&mut hatch.alpha, "alpha", 1.0),
        (&mut hatch.per_thickness, "per_thickness", 10.0),
        (&mut hatch.least, "least", 1000.0),
        (&mut hatch.most, "most", 1000.0),
        (&mut hatch.solid_below, "solid_below", 1000.0),
    ] {
        set(slot, table, key, most)?;
    }
    if !(hatch.least >= 0.1 && hatch.most >= hatch.least) {
        let help = "write for example `least = 5.2, most = 9.5`";
        let what = "its least distance must be 0.1 or more, and the greatest no less";
        return Err(table.entry.fault(what, help));
    }
    Ok(())
}

fn occlusion(occlusion: &mut Occlusion, table: &Table<'_>) -> Result<()> {
    if let Some(entry) = table.get("kind") {
        occlusion.kind = entry.choice(&OcclusionKind::ALL)?;
    }
    for (slot, key, most) in [
        (&mut occlusion.slices, "slices", 32),
        (&mut occlusion.steps, "steps", 64),
    ] {
        if let Some(entry) = table.get(key) {
            let count: u32 = entry.whole()?;
            if !(1..=most).contains(&count) {
                let help = format!("write for example `{key} = {slot}`");
                return Err(entry.fault(format_args!("it must be from 1 to {most}"), help));
            }
            *slot = count;
        }
    }
    for (slot, key, most) in [
        (&mut occlusion.radius_percent, "radius_percent", 100.0),
        (&mut occlusion.blur_percent, "blur_percent", 10.0),
        (&mut occlusion.strength, "strength", 100.0),
        (&mut occlusion.surface, "surface", 1.0),
        (&mut occlusion.cap, "cap", 1.0),
        (&mut occlusion.relief, "relief", 1.0),
    ] {
        set(slot, table, key, most)?;
    }
    Ok(())
}

fn ghost(ghost: &mut Ghost, table: &Table<'_>) -> Result<()> {
    if let Some(entry) = table.get("kind") {
        ghost.kind = entry.choice(&GhostKind::ALL)?;
    }
    if let Some(entry) = table.get("color") {
        ghost.color = Some(color(&entry)?);
    }
    for (slot, key, most) in [
        (&mut ghost.width, "width", WIDEST),
        (&mut ghost.alpha, "alpha", 1.0),
        (&mut ghost.glass, "glass", 1.0),
    ] {
        set(slot, table, key, most)?;
    }
    Ok(())
}

fn engraving(engraving: &mut Engraving, table: &Table<'_>) -> Result<()> {
    set(&mut engraving.spacing, table, "spacing", 1000.0)?;
    if let Some(entry) = table.get("spacing").filter(|_| engraving.spacing < 1.0) {
        let help = "write for example `spacing = 6.7`";
        return Err(entry.fault("lines would be finer than any picture", help));
    }
    for (slot, key) in [
        (&mut engraving.across, "across"),
        (&mut engraving.across_dark, "across_dark"),
    ] {
        if let Some(entry) = table.get(key) {
            *slot = entry.vector::<3>()?.map(|x| x as f32);
            if slot.iter().all(|x| *x == 0.0) {
                return Err(entry.fault(
                    "it has no direction",
                    format!("write for example `{key} = [1, 0, 0]`"),
                ));
            }
        }
    }
    Ok(())
}

/// The greatest width of a stroke, in thousandths of the height.
const WIDEST: f32 = 20.0;

/// Sets a number between 0 and a greatest one, if the table has it.
fn set(slot: &mut f32, table: &Table<'_>, key: &str, most: f32) -> Result<()> {
    let Some(entry) = table.get(key) else {
        return Ok(());
    };
    let value = entry.number()? as f32;
    if !(0.0..=most).contains(&value) {
        let help = format!("write for example `{key} = {slot}`");
        return Err(entry.fault(format_args!("it must be from 0 to {most}"), help));
    }
    *slot = value;
    Ok(())
}

/// One colour, or hues of which the lightness and the chroma are set: what comes last in the order of bases counts.
fn tint(tint: &mut Tint, table: &Table<'_>) -> Result<()> {
    let has_hue = ["lightness", "chroma", "warmth"]
        .iter()
        .find_map(|key| table.get(key));
    if let (Some(_), Some(hue)) = (table.get("color"), &has_hue) {
        let help = "keep the colour, or lightness, chroma and warmth";
        return Err(hue.fault("there is one colour for all parts", help));
    }
    if let Some(entry) = table.get("color") {
        *tint = Tint::Color(color(&entry)?);
    }
    if has_hue.is_none() {
        return Ok(());
    }
    let (mut lightness, mut chroma, mut warmth) = match *tint {
        Tint::Hue {
            lightness,
            chroma,
            warmth,
        } => (lightness, chroma, warmth),
        Tint::Material | Tint::Color(_) => (0.8, 0.03, [0.0; 2]),
    };
    set(&mut lightness, table, "lightness", 1.0)?;
    set(&mut chroma, table, "chroma", 0.4)?;
    if let Some(entry) = table.get("warmth") {
        warmth = entry.vector::<2>()?.map(|w| w as f32);
    }
    *tint = Tint::Hue {
        lightness,
        chroma,
        warmth,
    };
    Ok(())
}
