//! The inputs that move in a run's use case. They determine which clocks are part of a frame's cost.

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
    /// The cut, and possibly the view.
    Cut,
    /// The mesh, and possibly the cut and the view.
    Mesh,
}

/// All values with their names.
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
            Err(entry.fault(format!("`{text}` is not an input that can move"), help))
        }
    }
}
