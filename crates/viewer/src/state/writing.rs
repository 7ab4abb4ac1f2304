//! Written files: the scene, and the rules for other files written in addition to it.
//!
//! No file replaces an input of the scene, and none replaces another unasked, but the scene that was read.

use std::path::{Component, Path, PathBuf};

use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::Node;
use cutaway_io::load::place_of;

use super::State;
use crate::notice::Notice;

impl State {
    /// The name of the file that the scene goes to, until another is given: its own, or that of its first model.
    pub fn usual_file(&self) -> PathBuf {
        let own = self.document.path();
        if !own.as_os_str().is_empty() {
            return own.to_owned();
        }
        let parts = self.document.root().get("part");
        let first = parts.and_then(|parts| parts.items().first());
        let mesh = first.and_then(|part| part.get("mesh")?.text());
        let name = match (mesh, first.and_then(Node::model)) {
            (Some(mesh), _) => PathBuf::from(mesh.strip_suffix(".gz").unwrap_or(mesh)),
            (None, Some(shape)) => PathBuf::from(shape),
            (None, None) => PathBuf::from("scene"),
        };
        name.with_extension("toml")
    }

    /// Returns true if a write would replace a file that the scene was not read from, or that has changed since.
    pub fn replaces(&self, path: &Path) -> bool {
        let path = &*place_of(path);
        let is_own = self.is_own(path);
        // By the name that the scene has for it: a document holds its own.
        let on_disk = || Document::read_from(self.document.path(), &*self.store).ok();
        self.store.is_file(path) && !(is_own && on_disk().is_some_and(|there| there == self.saved))
    }

    /// Refuses to write where the scene has an input: a mesh, an image, a file that one of them names. Where a file is in the way, and not
    /// that of the scene, the meshes are read for what they name.
    ///
    /// # Errors
    ///
    /// Names the file.
    pub fn must_not_be_read(&self, path: &Path) -> Result<()> {
        if !self.store.is_file(&place_of(path)) || self.is_own(path) {
            return Ok(());
        }
        let inputs = self.document.files(&*self.store);
        let mut inputs = inputs
            .iter()
            .map(PathBuf::as_path)
            .chain(self.assets.files());
        match inputs.any(|input| self.store.is_one(input, path)) {
            true => {
                let what = "the scene is made of it, and it would be overwritten";
                Err(Error::file(path, what, "write to a file of another name"))
            }
            false => Ok(()),
        }
    }

    /// Returns true if a file is that of the scene.
    pub fn is_own(&self, path: &Path) -> bool {
        let own = self.document.path();
        !own.as_os_str().is_empty() && self.store.is_one(own, path)
    }

    /// Writes the document to a file, with the painter of the first slot, and continues with that.
    pub(super) fn save(&mut self, path: &Path) -> Result<()> {
        if self.replaces(path) {
            let what = match self.is_own(path) {
                true => "it was changed by another program, and would be overwritten",
                false => "there is such a file, and it would be overwritten",
            };
            let help = "save the scene under another name, or agree to replace the file";
            return Err(Error::file(path, what, help));
        }
        self.save_over(path)
    }

    /// As [`State::save`], where another file may be in the way.
    pub(super) fn save_over(&mut self, path: &Path) -> Result<()> {
        self.must_not_be_read(path)?;
        // A way back from a folder that is not there can be written through, but not read: the scene gets the name of the place.
        let goes_back = path.components().any(|step| step == Component::ParentDir);
        let place = goes_back.then(|| place_of(path));
        let path = place.as_deref().unwrap_or(path);
        let document = self.with_settings(self.document.clone())?;
        let document = document.moved_to(path)?;
        self.store.write(path, document.to_string().as_bytes())?;
        let document = Document::read_from(path, &*self.store)?;
        self.show(document, false)?;
        self.saved = self.document.clone();
        self.history.clear();
        self.tell(Notice::done(format!("saved {}", path.display())));
        self.opened.push(path.to_owned());
        Ok(())
    }
}
