//! State of the window: a document with its history, its scene, two slots and a selection. Actions change it.
//!
//! The state does not depend on a window: tests apply actions and read the document. A refused action changes nothing, and is reported
//! as a notice ([`State::notices`]).
//!
//! Cost of an action that changes the scene: one rebuild of the document's tree, and [`Shown::open`].

mod ahead;
mod edits;
mod intake;
mod keys;
mod writing;

use std::path::PathBuf;
use std::sync::Arc;

use cutaway::Result;
use cutaway::scene::{Bounds, Fit};
use cutaway_io::Document;
use cutaway_io::load::Assets;

use crate::action::{Action, Selection};
use crate::editing::command::{self, ExportSettings};
use crate::editing::cuts::{self, CutEntry, PlaneMove};
use crate::editing::history::History;
use crate::editing::{parts, removal, styles, timeline};
use crate::picture::camera;
use crate::picture::shown::Shown;
use crate::picture::slot::{Painter, SlotLayout, SlotSide};
use crate::storage::files::FileStorage;
use ahead::Ahead;
use cutaway::error::Diagnostic;

pub use ahead::StateRevision;

/// State of the window. A clone shares large data.
#[derive(Clone, Debug)]
pub struct State {
    document: Document,
    /// The document's pose at the displayed time; `None` if no keys animate a value.
    posed: Option<Document>,
    /// The document as last read or saved.
    saved: Document,
    history: History,
    assets: Assets,
    store: Arc<dyn FileStorage>,
    shown: Option<Shown>,
    /// Counts changes to the scene and the eye.
    scene_revision: u64,
    /// Counts changes to the slots' renderers and layout.
    slots_revision: u64,
    /// Counts actions.
    acted: u64,
    /// Data read and prepared in the background for the current action.
    ahead: Option<Ahead>,
    time_s: Option<f64>,
    selection: Selection,
    slots: [Painter; 2],
    layout: SlotLayout,
    wipe: f32,
    shows_errors: bool,
    shows_open_edges: bool,
    notices: Vec<Diagnostic>,
    /// Files that were opened or saved since they were last taken.
    opened: Vec<PathBuf>,
}

impl State {
    /// Opens a document from disk; `assets` cache the files read so far.
    ///
    /// # Errors
    ///
    /// A document that cannot be opened.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(document: Document, assets: Assets) -> Result<Self> {
        Self::open_from(Arc::new(cutaway_io::load::Disk), document, assets)
    }

    /// As [`State::open`], with another file storage.
    ///
    /// # Errors
    ///
    /// The same errors as [`State::open`].
    pub fn open_from(
        store: Arc<dyn FileStorage>,
        document: Document,
        assets: Assets,
    ) -> Result<Self> {
        Self::open_like(store, document, assets, None)
    }

    /// As [`State::open_from`], but data in common with another scene is reused.
    fn open_like(
        store: Arc<dyn FileStorage>,
        mut document: Document,
        mut assets: Assets,
        alike: Option<&Shown>,
    ) -> Result<Self> {
        document.guess_up(&mut assets)?;
        let shown = Shown::open(&document, &mut assets, None, alike)?;
        // Changes that command-line options make to a scene file count as unsaved changes.
        let is_file = !document.path().as_os_str().is_empty();
        let read = is_file.then(|| Document::read_from(document.path(), &*store).ok());
        let mut state = Self {
            saved: read.flatten().unwrap_or_else(|| document.clone()),
            document,
            posed: None,
            history: History::default(),
            assets,
            store,
            shown,
            scene_revision: 0,
            slots_revision: 0,
            acted: 0,
            ahead: None,
            time_s: None,
            selection: Selection::Scene,
            slots: [Painter::Auto; 2],
            layout: SlotLayout::Single,
            wipe: 0.5,
            shows_errors: false,
            shows_open_edges: false,
            notices: Vec::new(),
            opened: Vec::new(),
        };
        state.opened = intake::files_of(&state.document);
        state.take_settings()?;
        state.pose();
        Ok(state)
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Storage of the document's files.
    pub fn store(&self) -> &Arc<dyn FileStorage> {
        &self.store
    }

    /// The document with animated values at the displayed time.
    pub fn posed(&self) -> &Document {
        self.posed.as_ref().unwrap_or(&self.document)
    }

    /// Returns true if the document differs from its file.
    pub fn is_changed(&self) -> bool {
        self.document != self.saved
    }

    /// The prepared scene; `None` if the document has no parts.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Revision number that changes whenever the picture has to be redrawn.
    pub fn revision(&self) -> u64 {
        self.scene_revision + self.slots_revision
    }

    /// Revision number that changes whenever solids, cuts or the eye may have changed.
    pub fn scene_revision(&self) -> u64 {
        self.scene_revision
    }

    /// Whether there is a step to undo, and whether there is a step to redo.
    pub fn can_undo_redo(&self) -> [bool; 2] {
        self.history.reaches()
    }

    /// Subject of the panels.
    pub fn selection(&self) -> Selection {
        self.selection
    }

    /// Renderer of a slot.
    pub fn painter(&self, side: SlotSide) -> Painter {
        self.slots[side.index()]
    }

    /// Layout of the slots.
    pub fn layout(&self) -> SlotLayout {
        self.layout
    }

    /// Position of the line between the slots, as a fraction of the width from the left.
    pub fn wipe(&self) -> f32 {
        self.wipe
    }

    /// Returns true if errors are shown over the slots.
    pub fn shows_errors(&self) -> bool {
        self.shows_errors
    }

    /// Returns true if the open edges of meshes are shown over the picture.
    pub fn shows_open_edges(&self) -> bool {
        self.shows_open_edges
    }

    /// The displayed time in seconds; `None` for a scene without animation.
    pub fn time_s(&self) -> Option<f64> {
        self.time_s
    }

    /// Takes the notices that were added since the last call.
    pub fn notices(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.notices)
    }

    /// Files opened or saved since the last call.
    pub fn take_opened(&mut self) -> Vec<PathBuf> {
        std::mem::take(&mut self.opened)
    }

    /// Adds a notice for the user.
    pub fn tell(&mut self, notice: impl Into<Diagnostic>) {
        self.notices.push(notice.into());
    }

    /// The cuts of the document.
    pub fn cuts(&self) -> Vec<CutEntry> {
        cuts::cuts(&self.document)
    }

    /// The model's bounding box; empty if there is no model.
    pub fn bounds(&self) -> Bounds {
        (self.shown.as_ref()).map_or(Bounds::EMPTY, |shown| shown.scene.bounds())
    }

    /// The document of the visible picture, with the present eye, the displayed time, and the first slot's renderer. Keys that
    /// move the eye are removed.
    ///
    /// # Errors
    ///
    /// A document that cannot be changed.
    pub fn as_seen(&self) -> Result<Document> {
        let mut document = self.as_moving()?;
        timeline::remove_below(&mut document, "camera")?;
        Ok(document)
    }

    /// As [`State::as_seen`], but the keys that move the eye are kept.
    ///
    /// # Errors
    ///
    /// A document that cannot be changed.
    pub fn as_moving(&self) -> Result<Document> {
        let mut document = self.document.clone();
        if let Some(shown) = &self.shown {
            camera::write(&shown.scene.camera, &mut document)?;
            if shown.scene.camera.fit == Fit::All {
                document.set("camera.fit", "all")?;
            }
        }
        self.with_settings(document)
    }

    /// A document with the displayed time and the first slot's renderer.
    fn with_settings(&self, mut document: Document) -> Result<Document> {
        if let Some(time_s) = self.time_s {
            document.set("time_s", time_s)?;
        }
        let painter = self.painter(SlotSide::A);
        match painter {
            Painter::Auto => document.remove("strategy.name")?,
            named => document.set("strategy.name", named.to_string())?,
        }
        Ok(document)
    }

    /// The command that draws exactly this picture.
    ///
    /// # Errors
    ///
    /// The same errors as [`command::words`].
    pub fn command(&self, size_px: [u32; 2]) -> Result<String> {
        let document = self.as_seen()?;
        let picture = ExportSettings {
            painter: self.painter(SlotSide::A),
            size_px,
        };
        let words = command::words(&document, &self.saved, picture)?;
        Ok(command::quoted(&words))
    }

    /// Prepares the scene as for an exported picture; called when nothing has moved for a while.
    pub fn classify(&mut self) {
        let preclassified = self.shown.as_mut().map_or(Ok(()), Shown::classify);
        if let Err(error) = preclassified {
            self.tell(error);
        }
    }

    /// Carries an action out; a refusal becomes a notice.
    pub fn apply(&mut self, action: Action) {
        // Ending a gesture changes nothing, so it does not count as an action.
        self.acted += u64::from(action != Action::Release);
        if let Err(error) = self.carry_out(action) {
            self.tell(error);
        }
    }

    fn carry_out(&mut self, action: Action) -> Result<()> {
        match action {
            Action::Take(paths) => self.take(&paths),
            Action::Save(path) => self.save(&path),
            Action::SaveOver(path) => self.save_over(&path),
            Action::Reload => self.reload(),
            Action::Undo => self.undo(),
            Action::Redo => self.redo(),
            Action::Set { path, value } => {
                let gesture = Some(path.clone());
                self.edit(gesture, |document| {
                    styles::make_room(document, &path)?;
                    document.set(&path, value.clone())
                })
            }
            Action::Change(changes) => self.edit(None, |document| {
                changes.iter().try_for_each(|(path, value)| match value {
                    Some(value) => document.set(path, value.clone()),
                    None => removal::take_out(document, path),
                })
            }),
            Action::TakeBack(path) => {
                self.edit(None, |document| styles::take_back(document, &path))
            }
            Action::ShowPart(index, is_shown) => {
                self.edit(None, |document| parts::show(document, index, is_shown))
            }
            Action::Add(new) => self.add(new),
            Action::Duplicate(index) => self.duplicate(index),
            Action::Remove(index) => {
                self.change(None, |document| timeline::take_out_cut(document, index))?;
                self.selection = Selection::Scene;
                Ok(())
            }
            Action::MovePlane(by) => self.move_plane(by),
            Action::MoveRegion(by) => self.move_region(by),
            Action::CutThrough(point, normal) => self.cut_through(point, normal),
            Action::FaceEye => match &self.shown {
                Some(shown) => {
                    let forward = shown.view([64, 64]).forward;
                    self.move_plane(PlaneMove::Turn(forward))
                }
                None => Ok(()),
            },
            Action::Release => {
                self.history.end_gesture();
                Ok(())
            }
            Action::Select(selection) => {
                self.selection = selection;
                Ok(())
            }
            Action::MoveCamera(by) => self.move_camera(by),
            Action::Choose(side, painter) => {
                self.slots[side.index()] = painter;
                self.slots_revision += 1;
                Ok(())
            }
            Action::Swap => {
                self.slots.swap(0, 1);
                self.slots_revision += 1;
                Ok(())
            }
            Action::Arrange(layout) => {
                self.layout = layout;
                self.slots_revision += 1;
                Ok(())
            }
            Action::Wipe(at) => {
                self.wipe = at.clamp(0.0, 1.0);
                Ok(())
            }
            Action::ShowErrors(shows) => {
                self.shows_errors = shows;
                Ok(())
            }
            Action::AddKey => self.add_key(),
            Action::Animate => self.animate(),
            Action::MoveKey(key, to_s) => {
                let gesture = Some(format!("key {key:?}"));
                self.change(gesture, |document| timeline::move_key(document, key, to_s))
            }
            Action::RemoveKey(key) => self.remove_key(key),
            Action::ShowOpenEdges(shows) => {
                self.shows_open_edges = shows;
                Ok(())
            }
            Action::Seek(time_s) => self.seek(time_s),
        }
    }
}
