//! CPU cost of the window's frames. Frames that drew a picture and frames that drew none are listed separately.
//!
//! Times are wall-clock times from the frame's start until it is handed to egui; the work of egui and of the device is not included.
//! Cost: three clock reads per frame.

use std::fmt;

use cutaway_lab::experiment::Samples;

/// One frame, in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameCost {
    /// Time to carry out actions and prepare the scene.
    pub scene_ms: f64,
    /// Time to record and submit the pictures' passes; `None` if no picture was drawn.
    pub picture_ms: Option<f64>,
    /// Time of the whole frame, including the panels.
    pub whole_ms: f64,
}

/// Costs of all frames recorded so far.
#[derive(Clone, Debug, Default)]
pub struct Profile(Vec<FrameCost>);

impl Profile {
    /// Adds a frame.
    pub fn add(&mut self, frame: FrameCost) {
        self.0.push(frame);
    }

    /// The frames recorded so far.
    pub fn frames(&self) -> &[FrameCost] {
        &self.0
    }
}

/// A line per kind of frame: the count, and the median and maximum times.
impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = |values: Vec<f64>| {
            let [_, most] = Samples::new(values.clone()).range();
            format!("{:.2} ms (most {most:.2})", Samples::new(values).median)
        };
        for (name, drew) in [("that drew a picture", true), ("that drew none", false)] {
            let frames = || self.0.iter().filter(|f| f.picture_ms.is_some() == drew);
            let of = |ms: fn(&FrameCost) -> f64| line(frames().map(ms).collect());
            write!(
                f,
                "{} frames {name}: CPU {}",
                frames().count(),
                of(|f| f.whole_ms)
            )?;
            write!(f, ", of it the scene {}", of(|f| f.scene_ms))?;
            match drew {
                true => writeln!(f, ", the picture {}", of(|f| f.picture_ms.unwrap_or(0.0)))?,
                false => writeln!(f)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_told_by_whether_they_drew() {
        let mut profile = Profile::default();
        for (picture_ms, whole_ms) in [(None, 1.0), (Some(2.0), 5.0), (None, 3.0), (None, 2.0)] {
            profile.add(FrameCost {
                scene_ms: 0.5,
                picture_ms,
                whole_ms,
            });
        }
        let said = profile.to_string();
        assert!(
            said.contains("1 frames that drew a picture: CPU 5.00 ms"),
            "{said}"
        );
        assert!(
            said.contains("3 frames that drew none: CPU 2.00 ms (most 3.00)"),
            "{said}"
        );
    }
}
