//! `--defect`: meshes broken on purpose, after all else that makes them and before anything is cut.

use clap::Args;

use super::console::Console;
use crate::Result;
use crate::scene::Scene;
use crate::scene::defects::{Defect, break_parts};

/// What is broken.
#[derive(Args, Clone)]
pub(super) struct DefectArgs {
    /// Break the meshes of all parts, to see who copes: holes, flipped, duplicated or t-junctions (amount: share of the faces,
    /// 5% without it), gaps or soup (a length, or percent of the diagonal of the mesh's box, 1%), overlap (size of the copies that
    /// stick in it, 20%), open (share of the box that is gone, 20%). Further keys: seed, patch, charts, copies, axis. May be
    /// repeated
    #[arg(
        long = "defect",
        value_name = "KIND[:amount=5%,seed=1]",
        value_parser = parse_defect,
        help_heading = "Defects"
    )]
    defects: Vec<Defect>,
}

impl DefectArgs {
    /// Breaks the parts of a scene.
    pub(super) fn apply(&self, scene: &mut Scene) -> Result<Vec<String>> {
        break_parts(&mut scene.parts, &self.defects)
    }

    /// Breaks the parts of a scene, and says what was done to them.
    pub(super) fn apply_and_say(&self, scene: &mut Scene, console: &Console) -> Result<()> {
        let notes = self.apply(scene)?;
        notes.iter().for_each(|note| console.note(note));
        Ok(())
    }
}

fn parse_defect(text: &str) -> Result<Defect, String> {
    // The option names itself.
    text.parse().map_err(|e: crate::Error| match e {
        crate::Error::Input { what, mend, .. } => format!("{what}\n  help: {mend}"),
        other => other.to_string(),
    })
}
