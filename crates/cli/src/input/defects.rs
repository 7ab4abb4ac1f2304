//! `--defect`: breaks meshes on purpose, after all other processing and before any cut.

use clap::Args;
use cutaway::Result;
use cutaway_io::document::{Document, defect};

/// Defects to put into the meshes.
#[derive(Args, Clone)]
pub(crate) struct DefectArgs {
    /// Break the meshes of all parts to test robustness: holes, flipped, duplicated or t-junctions (amount: share of the faces,
    /// default 5%), gaps or soup (a length, or percent of the diagonal of the mesh's box, default 1%), overlap (size of the copies that
    /// intersect it, default 20%), open (removed share of the box, default 20%). Further keys: seed, patch, charts, copies, axis. May be
    /// repeated
    #[arg(
        long = "defect",
        value_name = "KIND[:amount=5%,seed=1]",
        help_heading = "Defects"
    )]
    defects: Vec<String>,
}

impl DefectArgs {
    /// Breaks all parts of a document.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        for words in &self.defects {
            document.push_in_each("part", "defects", &defect(words)?)?;
        }
        Ok(())
    }
}
