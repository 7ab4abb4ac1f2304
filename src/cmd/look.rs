//! Options of pictures: who draws them, how finely, and on what.

use super::args::say;
use crate::Result;
use crate::document::{Document, Value};
use crate::experiment::Renderer;
use crate::strategies::{Strategy, table};
use clap::Args;

/// How pictures are drawn.
#[derive(Args)]
pub(super) struct LookArgs {
    #[arg(long, value_name = "NAME", help = strategy_help())]
    strategy: Option<String>,
    /// Draw N times as fine along each side and average in linear light, 1 to 4 [default: that of the scene, or 2]
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(1..=4),
        help_heading = "Output"
    )]
    supersample: Option<u32>,
    /// Leave what shows no model transparent
    #[arg(long, help_heading = "Output")]
    pub(super) no_background: bool,
}

fn strategy_help() -> String {
    format!(
        "How caps are drawn: {}; or, on the CPU, exact for the reference, winding for open meshes [default: that of the scene, or {}]",
        table::names(),
        Strategy::RAYCAST_MASK
    )
}

impl LookArgs {
    /// Puts them into a document.
    pub(super) fn amend(&self, document: &mut Document) -> Result<()> {
        if let Some(name) = &self.strategy {
            name.parse::<Renderer>()?;
        }
        let strategy = self.strategy.as_deref().map(Value::from);
        say(document, "strategy.name", "--strategy", strategy)?;
        let fineness = self.supersample.map(|n| i64::from(n).into());
        say(document, "supersample", "--supersample", fineness)?;
        let background = self.no_background.then(|| "transparent".into());
        say(document, "background", "--no-background", background)
    }
}
