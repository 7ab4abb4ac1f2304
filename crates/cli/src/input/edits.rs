//! `--set`, `--save`, `--force`: change the document of the command line, and save it.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Node, Origin, Value};
use cutaway_io::load::place_of;

use super::stdin;
use crate::writing::output::Output;

#[derive(Args, Clone, Debug, Default)]
pub(crate) struct EditArgs {
    /// Sets a value of the scene, after all other options: `camera.azimuth_deg=20`, `cut.front.surfaces.0.section=z=10%`. The path has the
    /// form of a `[[key]]` path, with names unquoted; the value is TOML, or text without quotes. `cutaway help scene` lists
    /// the paths. Repeatable
    #[arg(long, value_name = "PATH=VALUE", value_parser = parse_setting, help_heading = HEADING)]
    set: Vec<String>,
    /// Writes the scene that results from this command line, which then draws the same picture. Other requests, such as
    /// the strategies of `compare` or a turntable, are not saved. An existing file with other content is kept, except with --force
    #[arg(long, value_name = "FILE.toml", help_heading = HEADING)]
    save: Option<String>,
    /// Allow --save to replace an existing file, even the input scene
    #[arg(long, requires = "save", help_heading = HEADING)]
    force: bool,
}

const HEADING: &str = "Scene";

impl EditArgs {
    /// Sets the values in order.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let is_new = document.root().get("camera").is_none();
        for setting in &self.set {
            let (path, value) = parted(setting, document);
            let origin = Origin::Option(format!("--set {path}").into());
            document.set_node(path, Node::new(Value::read(value)).said(&origin))?;
        }
        if is_new {
            document.find_angles()?;
        }
        Ok(())
    }

    /// Path for the saved document, if any. A file with other content is replaced only with `--force`.
    pub(crate) fn place(&self, document: &Document) -> Result<Option<PathBuf>> {
        let Some(save) = &self.save else {
            return Ok(None);
        };
        stdin::must_not_be_kept(&format!("--save {save}"))?;
        let Output::File(path) = Output::checked("--save", save, &["toml"])? else {
            let help = "give the name of a .toml file: paths in it are relative to its folder";
            let what = "a scene is saved to a file";
            return Err(Error::input("--save -", what, help));
        };
        let place = place_of(&path);
        if !self.force && place.exists() && !holds(&place, &document.moved_to(&path)?) {
            let is_read = same_file::is_same_file(&place, document.path()).unwrap_or(false);
            let what = match is_read {
                true => "it is the input scene, and would be overwritten",
                false => "the file already exists, and it holds something else",
            };
            let help = "save to another file, or add --force to replace it";
            return Err(Error::input(format!("--save {save}"), what, help));
        }
        Ok(Some(path))
    }

    /// Returns true if a file may be replaced.
    pub(crate) fn is_forced(&self) -> bool {
        self.force
    }
}

/// Returns true if a file already holds the document.
fn holds(path: &Path, document: &Document) -> bool {
    fs::read_to_string(path).is_ok_and(|text| text == document.to_string())
}

/// Splits a setting into path and value. Names may contain `=`, as cut names do, so the text is split at the first `=` after a valid path.
fn parted<'a>(text: &'a str, document: &Document) -> (&'a str, &'a str) {
    let divided = || {
        let places = text.match_indices('=').map(|(at, _)| at);
        places.map(|at| (text[..at].trim(), text[at + 1..].trim()))
    };
    let known = divided().find(|(path, _)| document.takes(path));
    known.or_else(|| divided().next()).unwrap_or((text, ""))
}

/// Rejects a text that is not a setting.
fn parse_setting(text: &str) -> Result<String, String> {
    match text.split_once('=') {
        Some((path, _)) if !path.trim().is_empty() => Ok(text.to_owned()),
        _ => Err(
            "it must be a path and a value\n  help: write for example --set camera.azimuth_deg=20"
                .to_owned(),
        ),
    }
}
