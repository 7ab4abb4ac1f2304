//! `--close-holes`: open meshes closed where that is no guess, before they are cut.

use clap::Args;
use cutaway::Result;
use cutaway_io::document::{Document, Node, Origin};

/// Option that closes holes.
#[derive(Args, Clone, Copy)]
pub(crate) struct HoleArgs {
    /// Close the planar holes of all parts and the small ones, of 12 edges at most or half of the part's diagonal around, and say
    /// which; what is neither stays open [default: as the scene says, or not]
    #[arg(long)]
    close_holes: bool,
}

impl HoleArgs {
    /// Closes the holes of all parts of a document.
    pub(crate) fn amend(self, document: &mut Document) -> Result<()> {
        if !self.close_holes {
            return Ok(());
        }
        let node = Node::new(true).said(&Origin::Option("--close-holes".into()));
        document.set_in_each("part", "close_holes", &node)
    }
}
