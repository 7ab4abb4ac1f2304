//! Inputs that move in the use case of a run: they select the clocks that count in every frame.

use cutaway::Result;
use cutaway::error::did_you_mean;
use cutaway_io::document::reader::Entry;
use serde::{Deserialize, Serialize};

/// Moving inputs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Moves {
    /// Only the view.
    #[default]
    View,
    /// The cut, and maybe the view.
    Cut,
    /// The mesh, and maybe the rest.
    Mesh,
}

/// All, by name.
const NAMED: [(&str, Moves); 3] = [
    ("view", Moves::View),
    ("cut", Moves::Cut),
    ("mesh", Moves::Mesh),
];

/// Reads a value by its name.
pub(super) fn read(entry: &Entry<'_>) -> Result<Moves> {
    let text = entry.text()?;
    match NAMED.iter().find(|(name, _)| *name == text) {
        Some((_, moves)) => Ok(*moves),
        None => {
            let help = did_you_mean(text, NAMED.map(|(name, _)| name));
            Err(entry.fault(format!("`{text}` is not something that moves"), help))
        }
    }
}
