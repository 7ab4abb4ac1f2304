//! Which way is up in meshes that do not say it, guessed by what they stand on, and from where a camera without angles looks.
//!
//! STL and PLY have no up axis. It is guessed only where nothing but such meshes is drawn and nobody has said it. Of 3MF it is +Z by its
//! specification, which is taken where nothing but 3MF is drawn. A scene file that does not say it means +Y, whatever its meshes are: a
//! better guess than today's must not turn its picture. What would be guessed there is found all the same, for the user to be told.

use std::path::PathBuf;

use super::{Document, Node};
use crate::Result;
use crate::load::{Assets, has_z_up, up_by_habit};
use crate::scene::{Part, Up, standing_up};

/// An axis that was guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GuessedUp {
    /// The axis.
    pub up: Up,
    /// What speaks for it.
    pub reason: UpReason,
    /// Whether the document has it now. A scene file stays as it is, and means +Y.
    pub is_set: bool,
}

/// What speaks for an axis to be up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpReason {
    /// The specification of the format.
    Specification,
    /// A flat base to stand on.
    Base,
    /// The habit of the format, for want of a base.
    Habit,
}

impl Document {
    /// Puts the axis that is up into a document of meshes alone that do not say it, unless it is a file; what was found, if anything. Of a
    /// file that is an axis other than the one that it means.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read.
    pub fn guess_up(&mut self, assets: &mut Assets) -> Result<Option<GuessedUp>> {
        let camera = self.root().get("camera");
        // A picture whose own direction up is given needs no axis.
        let is_said = camera.is_some_and(|c| c.get("up").is_some() || c.get("view_up").is_some());
        if is_said {
            return Ok(None);
        }
        let is_new = camera.is_none();
        let entries = self.root().get("part").map_or(&[] as &[_], Node::items);
        // What an entry turns stands on something else than its file does.
        let is_turned = |entry: &Node| {
            ["rotate_deg", "matrix"]
                .iter()
                .any(|k| entry.get(k).is_some())
        };
        let meshes: Option<Vec<PathBuf>> = entries
            .iter()
            .map(|entry| {
                let mesh = entry.get("mesh").filter(|_| !is_turned(entry))?;
                Some(self.folder().join(mesh.text()?))
            })
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
        for path in &meshes {
            parts.extend(assets.mesh(path)?.parts.iter().cloned());
        }
        let (up, reason) = match (is_defined, standing_up(&parts, habit)) {
            (true, _) => (Up::PlusZ, UpReason::Specification),
            (false, up) if up == habit => (up, UpReason::Habit),
            (false, up) => (up, UpReason::Base),
        };
        let is_set = self.path().as_os_str().is_empty();
        if is_set {
            self.set("camera.up", up.name())?;
            if is_new {
                self.find_angles()?;
            }
        }
        let guessed = GuessedUp { up, reason, is_set };
        Ok(Some(guessed).filter(|_| is_set || up != Up::default()))
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
