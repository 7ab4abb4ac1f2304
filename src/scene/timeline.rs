//! A scene over time.

use super::{Clip, Scene};
use crate::{Error, Result};

/// A scene that can be asked for at any time.
#[derive(Clone, Debug)]
pub struct Timeline {
    still: Scene,
}

impl Timeline {
    /// A scene in which nothing moves.
    pub fn still(scene: Scene) -> Self {
        Self { still: scene }
    }

    /// A scene whose parts may move.
    pub fn of_scene(scene: Scene) -> Self {
        Self::still(scene)
    }

    /// How long until it has shown all; `None` where nothing moves.
    pub fn duration_s(&self) -> Option<f64> {
        None
    }

    /// Whether anything moves.
    pub fn moves(&self) -> bool {
        self.duration_s().is_some()
    }

    /// The animations to choose from.
    pub fn clips(&self) -> Vec<Clip> {
        Vec::new()
    }

    /// Chooses the animation that is shown, by its name or its number.
    pub fn choose_clip(&mut self, name_or_number: &str) -> Result<()> {
        Err(Error::input(
            format!("clip {name_or_number}"),
            "the scene has no clips",
            "leave it out",
        ))
    }

    /// The scene at a time in seconds.
    pub fn at(&self, _time_s: f64) -> Result<Scene> {
        Ok(self.still.clone())
    }
}
