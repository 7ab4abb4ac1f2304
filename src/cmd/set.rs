//! `--set`: values of a scene file, from the command line.

use clap::Args;

use crate::scene::document::{Document, Value};
use crate::{Error, Result};

#[derive(Args, Clone, Debug, Default)]
pub(super) struct SetArgs {
    /// Sets a value of the scene file, which stays as it is: `camera.azimuth_deg=20`, `cut.front.surfaces.0.section=z=10%`. The path is
    /// that of a `[[key]]`; the value is TOML, or text without quotes. Repeatable
    #[arg(long, value_name = "PATH=VALUE", value_parser = parse_setting)]
    set: Vec<Setting>,
}

/// A value and where it goes.
#[derive(Clone, Debug)]
struct Setting {
    path: String,
    value: Value,
}

impl SetArgs {
    /// Refuses values where there is no scene file that could hold them.
    pub(super) fn need_no_file(&self) -> Result<()> {
        let Some(first) = self.set.first() else {
            return Ok(());
        };
        Err(Error::input(
            format!("--set {}", first.path),
            "there is no scene file to set it in",
            "name a scene (.toml), or say it by the options for models: see --help",
        ))
    }

    /// Sets them in their order.
    pub(super) fn apply(&self, document: &mut Document) -> Result<()> {
        for Setting { path, value } in &self.set {
            document.set(path, value.clone())?;
        }
        Ok(())
    }
}

fn parse_setting(text: &str) -> Result<Setting, String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => Ok(Setting {
            path: path.trim().to_owned(),
            value: Value::read(value.trim()),
        }),
        _ => Err(
            "it must be a path and a value\n  help: write for example --set camera.azimuth_deg=20"
                .to_owned(),
        ),
    }
}
