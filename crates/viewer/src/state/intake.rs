//! Opening and reloading of files.

use std::path::{Path, PathBuf};

use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value, part};

use super::State;
use crate::action::Selection;
use crate::picture::slot::SlotSide;
use crate::storage::files;
use cutaway::error::Diagnostic;

/// The files from which a document was opened: its own file or, if it has none, its meshes.
pub(super) fn files_of(document: &Document) -> Vec<PathBuf> {
    if !document.path().as_os_str().is_empty() {
        return vec![document.path().to_owned()];
    }
    let parts = document.root().get("part").map_or(&[] as &[_], Node::items);
    let meshes = parts.iter().filter_map(|part| part.get("mesh")?.text());
    meshes.map(PathBuf::from).collect()
}

impl State {
    /// Opens files.
    pub(super) fn take(&mut self, paths: &[PathBuf]) -> Result<()> {
        for path in paths {
            match files::kind(path)? {
                files::FileKind::Scene => {
                    let document = Document::read_from(path, &*self.store)?;
                    let (store, assets) = (self.store.clone(), self.fresh_assets());
                    let alike = self.ahead.as_ref().and_then(|ahead| ahead.shown.as_ref());
                    let mut opened = Self::open_like(store, document, assets, alike)?;
                    opened.acted = self.acted;
                    opened.ahead = self.ahead.take();
                    opened.scene_revision = self.scene_revision + 1;
                    opened.slots_revision = self.slots_revision;
                    opened.layout = self.layout;
                    opened.notices.append(&mut self.notices);
                    opened.opened.append(&mut self.opened);
                    *self = opened;
                }
                files::FileKind::Model => self.take_model(path)?,
                files::FileKind::Image => self.take_image(path)?,
            }
            self.tell(Diagnostic::note(
                "opened",
                format!("opened {}", path.display()),
            ));
            let is_file = files::kind(path)? != files::FileKind::Image && path.is_file();
            self.opened.extend(is_file.then(|| path.clone()));
        }
        Ok(())
    }

    pub(super) fn take_model(&mut self, path: &Path) -> Result<()> {
        let name = path.to_string_lossy();
        let is_first = self.shown.is_none();
        let mut document = self.document.clone();
        document.add_part(part(&name))?;
        if is_first {
            document.guess_up(&mut self.assets)?;
        }
        let before = self.document.clone();
        self.show(document, true)?;
        self.history.keep(&before, None);
        Ok(())
    }

    pub(super) fn take_image(&mut self, path: &Path) -> Result<()> {
        let Selection::Cut(index) = self.selection else {
            return Err(Error::file(
                path,
                "an image is the relief of a cut, and no cut is selected",
                "add a plane or select one, and drop the image again",
            ));
        };
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let name = name.replace(['.', '='], "_");
        let file = path.to_string_lossy().into_owned();
        self.edit(None, |document| {
            document.set(&format!("relief.{name}.image"), Value::from(file.clone()))?;
            let surface = format!("cut.{index}.surfaces.0");
            document.get(&surface)?;
            document.set(&format!("{surface}.relief"), name.clone())
        })
    }

    /// Reloads all files. If the scene file has changed on disk, reloading is refused when anything but the eye was changed in the window.
    pub(super) fn reload(&mut self) -> Result<()> {
        let mut document = self.document.clone();
        let path = document.path().to_owned();
        let is_file = !path.as_os_str().is_empty();
        let on_disk = is_file
            .then(|| Document::read_from(&path, &*self.store))
            .transpose()?;
        let written = on_disk.filter(|on_disk| *on_disk != self.saved);
        if let Some(written) = &written {
            if self.is_changed_beside_the_eye()? {
                return Err(Error::file(
                    &path,
                    "the file has changed on disk, and the scene was changed here as well",
                    "save the scene under another name, or undo the changes and reload",
                ));
            }
            document = self.seen_from_here(written.clone())?;
        }
        let fresh = self.fresh_assets();
        let assets = std::mem::replace(&mut self.assets, fresh);
        if let Err(error) = self.show(document, true) {
            // Reloading failed, so the files read earlier stay in use.
            self.assets = assets;
            return Err(error);
        }
        if let Some(written) = written {
            self.saved = written;
            self.history.clear();
        }
        self.tell(Diagnostic::note("read-again", "read all files again"));
        Ok(())
    }

    /// Returns true if there are unsaved changes. A move of the eye does not count.
    pub fn has_unsaved_changes(&self) -> bool {
        self.is_changed() && self.is_changed_beside_the_eye().unwrap_or(true)
    }

    /// Returns true if the document differs from its file in anything but the eye.
    fn is_changed_beside_the_eye(&self) -> Result<bool> {
        let mut both = [self.document.clone(), self.saved.clone()];
        for document in &mut both {
            document.remove("camera")?;
        }
        Ok(both[0] != both[1])
    }

    /// Applies the document's settings that are not part of its scene.
    pub(super) fn take_settings(&mut self) -> Result<()> {
        let Some(shown) = &self.shown else {
            return Ok(());
        };
        let settings = shown.timeline.settings();
        if let Some(name) = &settings.strategy.name {
            self.slots[SlotSide::A.index()] = name.parse()?;
        }
        self.time_s = settings.time_s;
        Ok(())
    }
}
