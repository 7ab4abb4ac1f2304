//! `--close-holes`: closes the unambiguous holes of open meshes, before they are cut.

use clap::Args;
use cutaway::Result;
use cutaway_io::document::{Document, Node, Origin};

/// Option that closes holes.
#[derive(Args, Clone, Copy)]
pub(crate) struct HoleArgs {
    /// Close the planar and the small holes of all parts (at most 12 edges, or a perimeter of half the part's diagonal), and report
    /// them; other holes stay open [default: the scene's setting, or off]
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
