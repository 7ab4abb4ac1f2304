//! The scene of a document, prepared for drawing.
//!
//! Opening costs reading the files, which the assets then cache. After that a change costs rebuilding the document's tree and everything
//! that depends on the change. Unchanged data is recognised by its address.

use std::sync::Arc;

use cutaway::scene::{Fit, View};
use cutaway::{Result, Scene};
use cutaway_io::Document;
use cutaway_io::document::{Timeline, Value, named_style};
use cutaway_io::load::Assets;
use cutaway_lab::experiment::SceneAtTime;

/// Default style, as for exported pictures.
pub const USUAL_STYLE: &str = "technical";

/// A scene at one time. A clone shares large data.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The scene over time.
    pub timeline: Arc<Timeline>,
    /// The scene at the displayed time, with the active camera.
    pub scene: Scene,
    /// The same scene, prepared for drawing.
    pub at: Arc<SceneAtTime>,
}

impl Shown {
    /// Opens a document's scene at a given time, or else at the document's own time; `None` if it has no parts. Data in common with the
    /// last scene is reused.
    ///
    /// # Errors
    ///
    /// The errors of [`Document::timeline`].
    pub fn open(
        document: &Document,
        assets: &mut Assets,
        time_s: Option<f64>,
        last: Option<&Self>,
    ) -> Result<Option<Self>> {
        let parts = document.root().get("part");
        let none = Value::List(Vec::new());
        if parts.is_none_or(|parts| parts.value == none) {
            return Ok(None);
        }
        let timeline = document.timeline(assets)?;
        // The view is fitted to the whole model, not to what the cuts keep, so that it does not move while a cut is dragged.
        let timeline = timeline
            .with_usual_style(named_style(USUAL_STYLE)?)?
            .with_usual_fit(Fit::All);
        let scene = match time_s.filter(|_| timeline.moves()) {
            Some(time_s) => timeline.at(time_s)?,
            None => timeline.scene()?,
        };
        let at = match last {
            Some(last) => last.at.updated(&scene),
            // Hatches depend on the parts' positions at the beginning, as in exported pictures.
            None if timeline.moves() => SceneAtTime::new(&timeline.at(0.0)?).updated(&scene),
            None => SceneAtTime::new(&scene),
        };
        Ok(Some(Self {
            timeline: Arc::new(timeline),
            scene,
            at: Arc::new(at),
        }))
    }

    /// Switches to another time in the same document.
    ///
    /// # Errors
    ///
    /// The errors of [`Timeline::at`].
    pub fn seek(&mut self, time_s: f64) -> Result<()> {
        let camera = self.scene.camera;
        self.scene = self.timeline.at(time_s)?;
        if !self.moves_camera() {
            self.scene.camera = camera;
        }
        self.at = Arc::new(self.at.updated(&self.scene));
        Ok(())
    }

    /// Prepares the scene again, as for an exported picture; while something moves, hatches keep their initial layout.
    ///
    /// # Errors
    ///
    /// The errors of [`Timeline::at`].
    pub fn classify(&mut self) -> Result<()> {
        let at = match self.timeline.moves() {
            true => {
                let first = Scene {
                    camera: self.scene.camera,
                    ..self.timeline.at(0.0)?
                };
                self.at.anew(&first).updated(&self.scene)
            }
            false => self.at.anew(&self.scene),
        };
        self.at = Arc::new(at);
        Ok(())
    }

    /// Returns true if the camera has keys.
    fn moves_camera(&self) -> bool {
        let mut keys = self.timeline.keys();
        keys.any(|key| key.target.starts_with("camera."))
    }

    /// The view of a picture with a size in pixels.
    pub fn view(&self, size_px: [u32; 2]) -> View {
        self.at.model.prepared.view_of(&self.scene.camera, size_px)
    }
}
