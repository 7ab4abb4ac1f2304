//! Adds and removes keys, and keeps the pose at the displayed time up to date.

use cutaway::scene::{Bounds, Camera};
use cutaway::{Error, Result};

use super::State;
use crate::editing::timeline;

/// Duration of an animation begun in the window, in seconds.
const FIRST_DURATION_S: f64 = 2.0;

impl State {
    /// Updates the pose to the displayed time.
    pub(super) fn pose(&mut self) {
        self.posed = None;
        let (Some(shown), Some(time_s)) = (&self.shown, self.time_s) else {
            return;
        };
        if shown.timeline.keys().next().is_some() {
            let mut document = self.document.clone();
            let posed = timeline::pose(&mut document, shown.timeline.keys(), time_s);
            self.posed = posed.is_ok().then_some(document);
        }
    }

    /// The model's bounding box and the eye, from which keys take their values.
    fn seen(&self) -> Result<(Bounds, Camera)> {
        let Some(shown) = &self.shown else {
            let help = "open a file: drop it into the window";
            return Err(Error::input("the key", "there is no model to move", help));
        };
        Ok((shown.scene.bounds(), shown.scene.camera))
    }

    /// Adds keys for the selection at some times, with the values at the displayed time.
    fn put_keys(&mut self, times_s: &[f64]) -> Result<()> {
        let (bounds, eye) = self.seen()?;
        let selection = self.selection;
        let mut posed = self.posed().clone();
        timeline::prepare(&mut posed, selection, (&bounds, &eye))?;
        let targets = timeline::targets(&posed, selection, (&bounds, &eye))?;
        self.change(None, |document| {
            // Targets that already have keys are already numbers; their rest values stay as they are.
            if targets
                .iter()
                .any(|(path, _)| !timeline::is_target(document, path))
            {
                timeline::prepare(document, selection, (&bounds, &eye))?;
            }
            for (path, value) in targets {
                for time_s in times_s {
                    timeline::add(document, &path, *time_s, value.clone())?;
                }
            }
            Ok(())
        })
    }

    pub(super) fn add_key(&mut self) -> Result<()> {
        self.put_keys(&[self.time_s.unwrap_or(0.0)])
    }

    pub(super) fn animate(&mut self) -> Result<()> {
        self.put_keys(&[0.0, FIRST_DURATION_S])?;
        self.seek(0.0)
    }

    pub(super) fn remove_key(&mut self, key: [usize; 2]) -> Result<()> {
        self.change(None, |document| timeline::remove(document, key))?;
        // A scene without keys has no time.
        if !self
            .shown
            .as_ref()
            .is_some_and(|shown| shown.timeline.moves())
        {
            self.time_s = None;
            self.pose();
        }
        Ok(())
    }

    /// Displays a time.
    pub(super) fn seek(&mut self, time_s: f64) -> Result<()> {
        if let Some(shown) = &mut self.shown {
            shown.seek(time_s)?;
            self.time_s = Some(time_s);
            self.scene_revision += 1;
            self.pose();
        }
        Ok(())
    }
}
