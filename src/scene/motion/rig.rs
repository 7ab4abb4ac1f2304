//! Clips: what a file says about how its parts move.

use glam::DAffine3;

use crate::scene::Part;

/// One animation of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name in the file.
    pub name: String,
    /// Time of its last key.
    pub duration_s: f64,
}

impl Part {
    /// The animations that the part's file has.
    pub fn clips(&self) -> &[Clip] {
        &[]
    }

    /// The part as a clip has it at a time: placed and posed.
    #[must_use]
    pub fn at_time(&self, _clip: usize, _time_s: f64) -> Self {
        self.clone()
    }

    /// Places the part as a whole, in all poses and at all times.
    pub fn place(&mut self, placed: DAffine3) {
        self.world_from_part = placed * self.world_from_part;
    }
}
