//! Changes to the document, and updates of the scene.

use cutaway::scene::{PlaneSpec, Viewpoint};
use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Key, Node, cut, section};
use glam::DVec3;

use super::State;
use crate::action::Selection;
use crate::editing::cuts::{self, CutEntry, CutKind, NewCut, PlaneMove};
use crate::editing::regions::{self, RegionMove};
use crate::editing::timeline;
use crate::picture::camera::{self, CameraMove};
use crate::picture::shown::Shown;

impl State {
    /// Applies a fallible edit to the document's pose at the displayed time; on failure nothing
    /// changes.
    pub(super) fn edit(
        &mut self,
        gesture: Option<String>,
        change: impl Fn(&mut Document) -> Result<()>,
    ) -> Result<()> {
        let Some((posed, time_s)) = self.posed.as_ref().zip(self.time_s) else {
            return self.change(gesture, change);
        };
        let mut tried = posed.clone();
        change(&mut tried)?;
        let timeline = self.shown.as_ref().map(|shown| &shown.timeline);
        let keys = timeline.into_iter().flat_map(|timeline| timeline.keys());
        let is_touched = |key: &&Key| tried.get(&key.target).ok() != posed.get(&key.target).ok();
        let touched: Vec<Key> = keys.filter(is_touched).cloned().collect();
        let rest = self.document.clone();
        self.change(gesture, |document| {
            timeline::pose(document, &touched, time_s)?;
            change(document)?;
            timeline::keep(document, &rest, &touched, time_s)
        })
    }

    /// Applies a fallible edit to the document's rest values; on failure nothing changes.
    pub(super) fn change(
        &mut self,
        gesture: Option<String>,
        change: impl FnOnce(&mut Document) -> Result<()>,
    ) -> Result<()> {
        let mut document = self.document.clone();
        change(&mut document)?;
        if document == self.document {
            return Ok(());
        }
        let before = self.document.clone();
        self.show(document, false)?;
        self.history.keep(&before, gesture);
        Ok(())
    }

    /// Switches to another document. If it is new, its scene is prepared from scratch; otherwise the present scene is updated.
    pub(super) fn show(&mut self, document: Document, is_new: bool) -> Result<()> {
        let last = self.shown.as_ref().filter(|_| !is_new);
        let ahead = self.ahead.as_ref().and_then(|ahead| ahead.shown.as_ref());
        let alike = last.or(ahead);
        let mut shown = Shown::open(&document, &mut self.assets, self.time_s, alike)?;
        // Automatic view angles are chosen only once, so that turning a cut does not turn the eye.
        if let (Some(shown), Some(last)) = (&mut shown, last)
            && document.root().get("camera") == self.document.root().get("camera")
        {
            shown.scene.camera = last.scene.camera;
        }
        (self.document, self.shown) = (document, shown);
        // A scene without animation has no time.
        let moves = (self.shown.as_ref()).is_some_and(|shown| shown.timeline.moves());
        self.time_s = self.time_s.filter(|_| moves);
        self.scene_revision += 1;
        self.pose();
        Ok(())
    }

    /// A document with the present eye.
    pub(super) fn seen_from_here(&self, mut document: Document) -> Result<Document> {
        if let Some(camera) = self.document.root().get("camera").cloned() {
            let before = document.clone();
            document.remove("camera")?;
            document.set_node("camera", camera)?;
            // A value that keys animate has to exist in the document, so it is restored.
            for track in timeline::tracks(&before) {
                if document.get(&track.target).is_err()
                    && let Ok(held) = before.get(&track.target)
                {
                    document.set(&track.target, held.value.clone())?;
                }
            }
        }
        Ok(document)
    }

    /// Switches to a document of the history, and keeps the present eye.
    pub(super) fn go_to(&mut self, document: Document) -> Result<()> {
        let document = self.seen_from_here(document)?;
        self.show(document, false)?;
        let count = self.cuts().len();
        if matches!(self.selection, Selection::Cut(index) if index >= count) {
            self.selection = Selection::Scene;
        }
        Ok(())
    }

    pub(super) fn undo(&mut self) -> Result<()> {
        let Some(before) = self.history.undo(&self.document) else {
            return Ok(());
        };
        self.go_to(Document::clone(&before)).inspect_err(|_| {
            // A document that fails to open stays in the history.
            let _ = self.history.redo(&before);
        })
    }

    pub(super) fn redo(&mut self) -> Result<()> {
        let Some(after) = self.history.redo(&self.document) else {
            return Ok(());
        };
        self.go_to(Document::clone(&after)).inspect_err(|_| {
            let _ = self.history.undo(&after);
        })
    }

    /// Moves the selected cut's plane, or adds one, through a point.
    pub(super) fn cut_through(&mut self, point: DVec3, normal: DVec3) -> Result<()> {
        if let Selection::Cut(_) = self.selection {
            return self.move_plane(PlaneMove::Through(point, normal));
        }
        let spec = PlaneSpec::through(point, normal)?.turned(normal, &self.bounds())?;
        self.edit(None, |document| {
            document.add_cut(cut([section(&spec.to_string())]).name("plane"))
        })?;
        self.selection = Selection::Cut(self.cuts().len() - 1);
        Ok(())
    }

    pub(super) fn add(&mut self, new: NewCut) -> Result<()> {
        let Some(shown) = &self.shown else {
            return Err(no_model());
        };
        let forward = shown.view([64, 64]).forward;
        let up = shown.scene.camera.up;
        let name = match new {
            NewCut::Plane(_) => "plane",
            NewCut::Relief(_) => "relief",
            NewCut::Box => "box",
            NewCut::Wedge => "wedge",
            NewCut::Cutout => "cutout",
            NewCut::Breakaway => "breakaway",
        };
        self.edit(None, |document| {
            document.add_cut(new.draft(forward, up).name(name))
        })?;
        self.selection = Selection::Cut(self.cuts().len() - 1);
        Ok(())
    }

    pub(super) fn duplicate(&mut self, index: usize) -> Result<()> {
        let copy = self.document.get(&format!("cut.{index}"))?.clone();
        let count = self.cuts().len();
        let names: Vec<String> = self.cuts().into_iter().map(|c| c.name).collect();
        self.edit(None, |document| {
            document.push("cut", Node::new(copy.value.clone()))?;
            let name = &names[index];
            let mut numbered = (2..).map(|n| format!("{name}_{n}"));
            let free = numbered.find(|n| !names.contains(n));
            let free = free.unwrap_or_default();
            document.set(&format!("cut.{count}.name"), free)
        })?;
        self.selection = Selection::Cut(count);
        Ok(())
    }

    pub(super) fn move_plane(&mut self, by: PlaneMove) -> Result<()> {
        let Selection::Cut(index) = self.selection else {
            let help = "select a cut with a plane, or add one";
            return Err(Error::input("the plane", "no cut is selected", help));
        };
        let bounds = self.bounds();
        let gesture = match by {
            PlaneMove::Along(_) | PlaneMove::To(_) | PlaneMove::Turn(_) | PlaneMove::Tilt(..) => {
                Some(format!("plane {index}"))
            }
            _ => None,
        };
        self.edit(gesture, |document| {
            cuts::move_plane(document, index, by, &bounds)
        })
    }

    pub(super) fn move_region(&mut self, by: RegionMove) -> Result<()> {
        let Selection::Cut(index) = self.selection else {
            let help = "select a cut with a box or a wedge, or add one";
            return Err(Error::input("the region", "no cut is selected", help));
        };
        let bounds = self.bounds();
        self.edit(Some(format!("region {index}")), |document| {
            regions::move_region(document, index, by, &bounds)
        })
    }

    pub(super) fn move_camera(&mut self, by: CameraMove) -> Result<()> {
        let Some(shown) = &mut self.shown else {
            return Ok(());
        };
        let mut moved = shown.scene.camera;
        if !matches!(moved.viewpoint, Viewpoint::Explicit { .. }) {
            let [azimuth_deg, elevation_deg] = camera::angles(&moved);
            moved.viewpoint = Viewpoint::Orbit {
                azimuth_deg,
                elevation_deg,
            };
        }
        camera::move_camera(&mut moved, by);
        // Rounded as in the document, so that both cameras are equal.
        camera::round(&mut moved);
        camera::write(&moved, &mut self.document)?;
        shown.scene.camera = moved;
        self.scene_revision += 1;
        let opens_to_the_eye =
            |cut: &CutEntry| matches!(cut.kind, CutKind::Cutout | CutKind::Breakaway);
        if self.cuts().iter().any(opens_to_the_eye) {
            return self.show(self.document.clone(), false);
        }
        Ok(())
    }
}

fn no_model() -> Error {
    Error::input(
        "the cut",
        "there is no model to be cut",
        "open a file: drop it into the window",
    )
}
