//! The scene of a document, prepared for drawing.
//!
//! Opening costs reading the files, once: assets cache them. After that a change costs rebuilding the document's tree and everything
//! that depends on the change, because unchanged data keeps its address.

use std::sync::Arc;

use cutaway::scene::{Fit, View};
use cutaway::{Result, Scene};
use cutaway_io::Document;
use cutaway_io::document::{Timeline, Value, named_style};
use cutaway_io::load::Assets;
use cutaway_lab::experiment::SceneAtTime;

/// Default style, as for exported pictures.
pub const USUAL_STYLE: &str = "technical";

/// A scene at a time. A clone shares large data.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The scene over time.
    pub timeline: Arc<Timeline>,
    /// The scene at that time, with the active camera.
    pub scene: Scene,
    /// The prepared scene.
    pub at: Arc<SceneAtTime>,
}

impl Shown {
    /// Opens a document's scene at a given time, or at the document's own; `None` if it has no parts. Data in common with the
    /// last scene is reused.
    ///
    /// # Errors
    ///
    /// Those of [`Document::timeline`].
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
        // The view stays where it is while a cut is dragged: it is not fitted to what the cut keeps.
        let timeline = timeline
            .with_usual_style(named_style(USUAL_STYLE)?)?
            .with_usual_fit(Fit::All);
        let scene = match time_s.filter(|_| timeline.moves()) {
            Some(time_s) => timeline.at(time_s)?,
            None => timeline.scene()?,
        };
        let at = match last {
            Some(last) => last.at.updated(&scene),
            // Hatches depend on the positions of parts at the beginning, as in exported pictures.
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
    /// Those of [`Timeline::at`].
    pub fn seek(&mut self, time_s: f64) -> Result<()> {
        let camera = self.scene.camera;
        self.scene = self.timeline.at(time_s)?;
        if !self.moves_camera() {
            self.scene.camera = camera;
        }
        self.at = Arc::new(self.at.updated(&self.scene));
        Ok(())
    }

    /// Prepares the scene as for an exported picture; while something moves, hatches keep their initial layout.
    ///
    /// # Errors
    ///
    /// Those of [`Timeline::at`].
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

    /// View of a picture of a size in pixels.
    pub fn view(&self, size_px: [u32; 2]) -> View {
        self.at.model.prepared.view_of(&self.scene.camera, size_px)
    }
}
