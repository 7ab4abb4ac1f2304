//! `--split`: splits parts into their connected components, before all other processing.

use clap::Args;
use cutaway::Result;
use cutaway_io::document::{Document, Node, Origin};

/// Division of meshes into parts.
#[derive(Args, Clone, Copy)]
pub(crate) struct SplitArgs {
    /// Make each connected body a separate part, NAME/1, NAME/2 and so on: a gearbox in one STL file gets a colour and a hatch for each
    /// wheel. Cavities stay with the body around them [default: the scene's setting, or off]
    #[arg(long)]
    split: bool,
}

impl SplitArgs {
    /// Splits all parts of a document.
    pub(crate) fn amend(self, document: &mut Document) -> Result<()> {
        if !self.split {
            return Ok(());
        }
        let node = Node::new(true).said(&Origin::Option("--split".into()));
        document.set_in_each("part", "split", &node)
    }
}
