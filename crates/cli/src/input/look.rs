//! Options for pictures: renderer, resolution and background.

use super::args::say;
use super::declared::declared;
use crate::renderer_request::RendererRequest;
use clap::Args;
use cutaway::Result;
use cutaway::scene::{Fit, Style};
use cutaway::strategies::{AUTO, DrawOptions, table};
use cutaway_io::document::{Document, Timeline, Value, named_style, style_names};

/// Default style of pictures.
const USUAL_STYLE: &str = "technical";

/// Defaults for settings that the document omits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Defaults {
    /// Style of the picture.
    pub(crate) style: Style,
    /// Extent to which cameras are fitted.
    pub(crate) fit: Fit,
    /// True if the up axis is guessed for meshes that do not state it.
    pub(crate) guesses_up: bool,
}

impl Defaults {
    /// Defaults for pictures that people look at; `Default` gives the defaults for measurements.
    pub(crate) fn of_pictures() -> Result<Self> {
        Ok(Self {
            style: named_style(USUAL_STYLE)?,
            fit: Fit::Kept,
            guesses_up: true,
        })
    }

    /// Returns a timeline with all these defaults.
    pub(crate) fn of(self, timeline: Timeline) -> Result<Timeline> {
        Ok(timeline
            .with_usual_style(self.style)?
            .with_usual_fit(self.fit))
    }
}

/// Appearance options of pictures.
#[derive(Args)]
pub(crate) struct LookArgs {
    #[arg(long, value_name = "NAME", help = strategy_help())]
    strategy: Option<String>,
    /// Draw at N times the resolution along each side and average in linear light, 1 to 4 [default: the scene's, or 2]
    #[arg(
        long,
        value_name = "N",
        value_parser = declared("supersample"),
        help_heading = "Output"
    )]
    supersample: Option<Value>,
    #[arg(long, value_name = "NAME|FILE", help = style_help(), help_heading = "Output")]
    style: Option<String>,
    /// One colour for the surfaces of all parts, #rrggbb or a CSS name, lit by the style [default: the parts' colours]
    #[arg(long, value_name = "COLOUR", value_parser = declared("style.surface.color"), help_heading = "Output")]
    color: Option<Value>,
    /// One colour for all caps [default: the style's]
    #[arg(long, value_name = "COLOUR", value_parser = declared("style.cap.color"), help_heading = "Output")]
    cap_color: Option<Value>,
    /// Background behind the model: paper (the style's colour), gradient, none, or a colour [default: the scene's, or paper]
    #[arg(long, value_name = "WHAT", value_parser = declared("background"), help_heading = "Output")]
    background: Option<Value>,
    /// Show the removed parts as phantom lines, glass or both
    #[arg(
        long,
        value_name = "KIND",
        value_parser = declared("style.ghost.kind"),
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "lines",
        help_heading = "Output"
    )]
    ghost: Option<Value>,
    /// Add a ground below the model that shows the model's shadow, with a strength from 0 to 1
    #[arg(
        long,
        value_name = "STRENGTH",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "0.35",
        value_parser = declared("style.shadow.strength"),
        help_heading = "Output"
    )]
    shadow: Option<Value>,
    /// Make the background transparent; the same as --background none
    #[arg(long, help_heading = "Output", conflicts_with = "background")]
    pub(crate) no_background: bool,
}

fn style_help() -> String {
    format!(
        "How the picture looks: {}, or a file of a style (.toml) [default: that of the scene, or {USUAL_STYLE}]",
        style_names().collect::<Vec<_>>().join(", ")
    )
}

/// The choice of [`AUTO`], for help texts.
pub(crate) const AUTO_IN_WORDS: &str = "raycast+mask (raycast+winding for parts that are not closed) by the rasteriser that suits the \
    adapter";

fn strategy_help() -> String {
    format!(
        "How caps are drawn: {AUTO}, {AUTO_IN_WORDS}; {}; or, on the CPU, exact for the reference, \
         winding for open meshes [default: that of the scene, or {AUTO}]",
        table::names(),
    )
}

impl LookArgs {
    /// Writes the options into a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        RendererRequest::named(self.strategy.as_deref(), DrawOptions::default())?;
        let strategy = self.strategy.as_deref().map(Value::from);
        say(document, "strategy.name", "--strategy", strategy)?;
        say(
            document,
            "supersample",
            "--supersample",
            self.supersample.clone(),
        )?;
        if let Some(style) = &self.style {
            document.set_style(style, "--style")?;
        }
        for (path, option, value) in [
            ("style.surface.color", "--color", &self.color),
            ("style.cap.color", "--cap-color", &self.cap_color),
            ("style.ghost.kind", "--ghost", &self.ghost),
            ("style.shadow.strength", "--shadow", &self.shadow),
        ] {
            if value.is_some() {
                change_style(document)?;
                if path.ends_with("color") {
                    forget_hue(document, path)?;
                }
                say(document, path, option, value.clone())?;
            }
        }
        let (option, background) = match self.no_background {
            true => ("--no-background", Some("transparent".into())),
            false => ("--background", self.background.clone()),
        };
        say(document, "background", option, background)
    }
}

/// Turns a plain style name in the document into a table, so that it can hold changes.
fn change_style(document: &mut Document) -> Result<()> {
    let Some(style) = document.root().get("style").cloned() else {
        return Ok(());
    };
    if matches!(style.value, Value::Text(_)) {
        document.remove("style")?;
        document.set_node("style.base", style)?;
    }
    Ok(())
}

/// Removes changes to a hue, because a single colour replaces it.
fn forget_hue(document: &mut Document, path: &str) -> Result<()> {
    let table = path.trim_end_matches("color");
    ["lightness", "chroma", "warmth"]
        .into_iter()
        .try_for_each(|key| document.remove(&format!("{table}{key}")))
}
