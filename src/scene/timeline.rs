//! A scene over time.

use super::Scene;
use crate::Result;

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

    /// How long until it has shown all; `None` where nothing moves.
    pub fn duration_s(&self) -> Option<f64> {
        None
    }

    /// The scene at a time in seconds.
    pub fn at(&self, _time_s: f64) -> Result<Scene> {
        Ok(self.still.clone())
    }
}
