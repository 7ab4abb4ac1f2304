//! `style = "NAME"` or `[style]`: a base style and changes to it.
//!
//! The base is a built-in style, or a style file that is opened with the document. Numbers in `[style]` may be animated.

use std::path::Path;

use cutaway::error::{Error, Result, did_you_mean};
use cutaway::scene::describe::OrWord;
use cutaway::scene::style::{Hue, Style};

use super::described::{self, keys_of};
use super::opening::{LoadContext, missing};
use super::reader::{Entry, Table};
use super::table::with_table;
use crate::document::{Keys, Settings};
use crate::load::Assets;

static KEYS: Keys = Keys::below("style");

/// Built-in styles of the program, apart from `lit`, which is the library's default style.
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

/// Names of the built-in styles.
pub fn style_names() -> impl Iterator<Item = &'static str> {
    ["lit"].into_iter().chain(STYLES.map(|(name, _)| name))
}

/// Returns a built-in style.
///
/// # Errors
///
/// Fails if the name is unknown.
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

/// Returns true if a base is a file name.
pub(in crate::document) fn is_file(base: &str) -> bool {
    base.ends_with(".toml")
}

/// Opens the base style of a document, if the document names one.
pub(super) fn open(root: &Table<'_>, opening: &mut LoadContext<'_>) -> Result<Option<Style>> {
    let Some(base) = base(root)? else {
        return Ok(None);
    };
    let name = base.text()?;
    if !is_file(name) {
        return named_style(name).map(Some).map_err(|e| base.place(e));
    }
    let path = opening.folder.join(name);
    let bytes = opening.assets.store().read(&path).map_err(|e| {
        let help = "name a style file or a built-in style: cutaway render --help";
        base.fault(format_args!("{} cannot be read: {e}", path.display()), help)
    })?;
    let text = String::from_utf8(bytes.into_owned()).map_err(|_| {
        base.fault(
            format_args!("{} is not text", path.display()),
            "save it as text in UTF-8",
        )
    })?;
    let style = of_text(&path, &text)?;
    opening.files.insert(path);
    Ok(Some(style))
}

/// Checks everything that can be checked without opening a file.
pub(super) fn check(
    root: &Table<'_>,
    settings: &Settings,
    (folder, assets): (&Path, &Assets),
) -> Result<()> {
    if let Some(base) = base(root)? {
        let name = base.text()?;
        if !is_file(name) {
            named_style(name).map_err(|e| base.place(e))?;
        } else if !assets.store().is_file(&folder.join(name)) {
            return Err(missing(&base, &folder.join(name)));
        }
    }
    read(root, Style::default(), settings).map(|_| ())
}

/// The value that names the base style, if there is one.
fn base<'a>(root: &Table<'a>) -> Result<Option<Entry<'a>>> {
    match root.get("style") {
        Some(entry) if entry.is_text() => Ok(Some(entry)),
        Some(entry) => Ok(entry.table(KEYS.all())?.get("base")),
        None => Ok(None),
    }
}

/// The document's style, which is its base style with the changes applied at the current time.
pub(super) fn read(root: &Table<'_>, base: Style, settings: &Settings) -> Result<Style> {
    let mut style = base;
    if let Some(entry) = root.get("style").filter(|entry| !entry.is_text()) {
        amend(&mut style, &entry.table(KEYS.all())?)?;
    }
    if let Some(OrWord::Value(background)) = &settings.background {
        style.paper = *background;
    }
    Ok(style)
}

fn amend(style: &mut Style, table: &Table<'_>) -> Result<()> {
    let before = style.surface.tint;
    described::amend(style, table)?;
    let below = |key: &str| table.get(key).map(|e| e.open_table()).transpose();
    let [surface, cap, hatch, engraving] = [
        below("surface")?,
        below("cap")?,
        below("hatch")?,
        below("engraving")?,
    ];
    let has_vertex_paint = surface.as_ref().is_some_and(|s| s.get("coat").is_some());
    if style.surface.tint != before && !has_vertex_paint {
        style.surface.vertex_paint = false;
    }
    for tinted in surface.iter().chain(&cap) {
        one_tint(tinted)?;
    }
    if let Some(hatch) = hatch.filter(|_| style.hatch.most < style.hatch.least) {
        let help = "write for example `least = 5.2, most = 9.5`";
        let what = "its least distance is greater than its greatest distance";
        return Err(hatch.entry.fault(what, help));
    }
    for (key, direction) in [
        ("across", style.engraving.across),
        ("across_dark", style.engraving.across_dark),
    ] {
        let entry = engraving.as_ref().and_then(|e| e.get(key));
        if let Some(entry) = entry.filter(|_| direction == [0.0; 3]) {
            let help = format!("write for example `{key} = [1, 0, 0]`");
            return Err(entry.fault("it has no direction", help));
        }
    }
    Ok(())
}

/// Refuses a fixed colour together with lightness, chroma or warmth.
fn one_tint(table: &Table<'_>) -> Result<()> {
    let of_hue = keys_of(Hue::FIELDS);
    match of_hue.iter().find_map(|key| table.get(key)) {
        Some(hue) if table.get("color").is_some() => {
            let help = "keep the colour, or lightness, chroma and warmth";
            Err(hue.fault("`color` already sets one colour for all parts", help))
        }
        _ => Ok(()),
    }
}
