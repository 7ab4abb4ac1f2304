//! Up axis of meshes whose format does not define one, guessed from their base, and the viewpoint of a camera without angles.
//!
//! STL and PLY have no up axis. The axis is guessed only if all drawn meshes have these formats and no axis is given. 3MF specifies +Z,
//! which applies only if all drawn meshes are 3MF. A scene file without an up axis always means +Y, so that a better guess in future does
//! not turn its picture. For a scene file the guess is also computed, but only reported to the user.

use std::path::PathBuf;

use cutaway::Result;
use cutaway::scene::{Part, Up, standing_up};

use super::{Document, Node};
use crate::load::{Assets, has_z_up, up_by_habit};

/// An up axis that was guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GuessedUp {
    /// The axis.
    pub up: Up,
    /// Reason for the guess.
    pub reason: UpReason,
}

/// Reason why an axis was chosen as up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpReason {
    /// The format specifies the axis.
    Specification,
    /// The meshes have a flat base to stand on.
    Base,
    /// There is no flat base, so the convention of the format is used.
    Habit,
}

impl Document {
    /// Sets and returns the guessed up axis. Does nothing if the document is a file, gives an axis or has parts that are not meshes.
    ///
    /// # Errors
    ///
    /// Fails if a mesh cannot be read.
    pub fn guess_up(&mut self, assets: &mut Assets) -> Result<Option<GuessedUp>> {
        if !self.path().as_os_str().is_empty() {
            return Ok(None);
        }
        let guessed = self.likely_up(assets)?;
        if let Some(GuessedUp { up, .. }) = guessed {
            let is_new = self.root().get("camera").is_none();
            self.set("camera.up", up.name())?;
            if is_new {
                self.find_angles()?;
            }
        }
        Ok(guessed)
    }

    /// Guesses the up axis, unless the document gives an axis or has parts that are not meshes.
    ///
    /// # Errors
    ///
    /// Fails if a mesh cannot be read.
    pub fn likely_up(&self, assets: &mut Assets) -> Result<Option<GuessedUp>> {
        let camera = self.root().get("camera");
        // A camera with its own up direction needs no guess.
        if camera.is_some_and(|c| c.get("up").is_some() || c.get("view_up").is_some()) {
            return Ok(None);
        }
        let entries = self.root().get("part").map_or(&[] as &[_], Node::items);
        // A rotated entry stands on a different base than the mesh in its file.
        let is_turned = |entry: &Node| {
            let mut turns = ["rotate_deg", "matrix"].iter();
            turns.any(|key| entry.get(key).is_some())
        };
        let mesh = |entry: &Node| {
            let mesh = entry.get("mesh").filter(|_| !is_turned(entry))?;
            Some(self.folder().join(mesh.text()?))
        };
        let meshes: Vec<PathBuf> = entries
            .iter()
            .map(mesh)
            .collect::<Option<_>>()
            .unwrap_or_default();
        let habits: Option<Vec<Up>> = meshes.iter().map(|path| up_by_habit(path)).collect();
        let Some(habit) = habits.and_then(|habits| habits.first().copied()) else {
            return Ok(None);
        };
        if !meshes.iter().all(|path| assets.has_mesh(path)) {
            return Ok(None);
        }
        if meshes.iter().all(|path| has_z_up(path)) {
            return Ok(Some(GuessedUp {
                up: Up::PlusZ,
                reason: UpReason::Specification,
            }));
        }
        let mut parts: Vec<Part> = Vec::new();
        for path in &meshes {
            parts.extend(assets.mesh(path)?.parts.iter().cloned());
        }
        let up = standing_up(&parts, habit);
        let reason = match up == habit {
            true => UpReason::Habit,
            false => UpReason::Base,
        };
        Ok(Some(GuessedUp { up, reason }))
    }

    /// Makes all camera angles that the document does not give automatic, as in a document without a camera.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot be edited.
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
