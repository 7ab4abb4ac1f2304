//! Up axis of meshes that do not define it, guessed from their base, and the viewpoint of a camera without angles.
//!
//! STL and PLY have no up axis. It is guessed only if all meshes drawn are of these formats and no axis is given. For 3MF it is +Z by the
//! specification, which applies only if all meshes drawn are 3MF. A scene file without an up axis means +Y, whatever its meshes are: a
//! future, better guess must not turn its picture. The guess is also computed for such a file, but only reported to the user.

use std::path::PathBuf;

use cutaway::Result;
use cutaway::scene::{Part, Up, standing_up};

use super::{Document, Node};
use crate::load::{Assets, has_z_up, up_by_habit};

/// An axis that was guessed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GuessedUp {
    /// The axis.
    pub up: Up,
    /// Reason for the guess.
    pub reason: UpReason,
}

/// Reason for an axis to be up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UpReason {
    /// The specification of the format.
    Specification,
    /// A flat base to stand on.
    Base,
    /// The convention of the format, used if there is no flat base.
    Habit,
}

impl Document {
    /// Sets the guessed up axis in a document of meshes only that gives no axis, unless it is a file. Returns the guess, if any.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read.
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

    /// The likely up axis of a document of meshes only that gives no axis.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read.
    pub fn likely_up(&self, assets: &mut Assets) -> Result<Option<GuessedUp>> {
        let camera = self.root().get("camera");
        // A camera with its own up direction needs no guess.
        if camera.is_some_and(|c| c.get("up").is_some() || c.get("view_up").is_some()) {
            return Ok(None);
        }
        let entries = self.root().get("part").map_or(&[] as &[_], Node::items);
        // A rotated entry stands on another base than its file does.
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

    /// Makes angles that the camera does not give automatic, as in a document without a camera.
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
