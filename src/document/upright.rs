//! Which way is up in meshes that do not say it, guessed by what they stand on, and from where a camera without angles looks.
//!
//! STL and PLY have no up axis. It is guessed only where nothing but such meshes is drawn and nobody has said it; a scene file says it, or
//! means +Y. Of 3MF it is +Z by its specification, which is taken where nothing but 3MF is drawn.

use std::path::Path;

use super::{Document, Node};
use crate::Result;
use crate::load::{Assets, has_z_up, up_by_habit};
use crate::scene::{Part, Up, standing_up};

/// An axis that was guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GuessedUp {
    /// The axis.
    pub up: Up,
    /// Whether it is the habit of the format, for want of a base to stand on.
    pub is_habit: bool,
}

impl Document {
    /// Puts the axis that is up into a document of meshes alone that do not say it; what was guessed, if anything.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read.
    pub fn guess_up(&mut self, assets: &mut Assets) -> Result<Option<GuessedUp>> {
        let camera = self.root().get("camera");
        // A picture whose own direction up is given needs no axis.
        let is_said = camera.is_some_and(|c| c.get("up").is_some() || c.get("view_up").is_some());
        if is_said || !self.path().as_os_str().is_empty() {
            return Ok(None);
        }
        let is_new = camera.is_none();
        let entries = self.root().get("part").map_or(&[] as &[_], Node::items);
        let meshes: Option<Vec<&Path>> = entries
            .iter()
            .map(|entry| Some(Path::new(entry.get("mesh")?.text()?)))
            .collect();
        let meshes = meshes.unwrap_or_default();
        let habits: Option<Vec<Up>> = meshes.iter().map(|path| up_by_habit(path)).collect();
        let Some(habit) = habits.and_then(|habits| habits.first().copied()) else {
            return Ok(None);
        };
        if !meshes.iter().all(|path| assets.has_mesh(path)) {
            return Ok(None);
        }
        let is_defined = meshes.iter().all(|path| has_z_up(path));
        let mut parts: Vec<Part> = Vec::new();
        for path in meshes {
            parts.extend(assets.mesh(path)?.parts.iter().cloned());
        }
        let up = match is_defined {
            true => Up::PlusZ,
            false => standing_up(&parts, habit),
        };
        self.set("camera.up", up.name())?;
        if is_new {
            self.find_angles()?;
        }
        Ok((!is_defined).then_some(GuessedUp {
            up,
            is_habit: up == habit,
        }))
    }

    /// Lets the angles be found that a camera does not say, as they are where there is none.
    ///
    /// # Errors
    ///
    /// Text that cannot be edited.
    pub fn find_angles(&mut self) -> Result<()> {
        let Some(camera) = self.root().get("camera").cloned() else {
            return Ok(());
        };
        let is_said = |key: &&str| camera.get(key).is_some();
        let places = ["position", "focal_point", "view_up", "view"];
        if places.iter().any(is_said) {
            return Ok(());
        }
        for angle in ["azimuth_deg", "elevation_deg"] {
            if !is_said(&angle) {
                self.set(&format!("camera.{angle}"), "auto")?;
            }
        }
        Ok(())
    }
}
