//! Saves the scene, and decides which files may be overwritten.
//!
//! Writing never replaces an input of the scene. It replaces an existing file only after confirmation, except the scene's own file.

use std::path::{Component, Path, PathBuf};

use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::Node;
use cutaway_io::load::place_of;

use super::State;
use cutaway::error::Diagnostic;

impl State {
    /// Default name for saving the scene: the name of its own file, or one made from its first model.
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

    /// Returns true if a write would replace a file other than the scene's own, or the scene's own file after another program changed it.
    pub fn replaces(&self, path: &Path) -> bool {
        let path = &*place_of(path);
        let is_own = self.is_own(path);
        // Read by the path that the document stores for its own file.
        let on_disk = || Document::read_from(self.document.path(), &*self.store).ok();
        self.store.is_file(path) && !(is_own && on_disk().is_some_and(|there| there == self.saved))
    }

    /// Refuses to overwrite an input of the scene: a mesh, an image, or a file named by one. If the path leads to a file other than
    /// the scene's own, the meshes are read to find the files that they name.
    ///
    /// # Errors
    ///
    /// The path leads to an input of the scene.
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
                let what = "it is an input of the scene, and would be overwritten";
                Err(Error::file(path, what, "write to a file of another name"))
            }
            false => Ok(()),
        }
    }

    /// Returns true if a file is the scene's own.
    pub fn is_own(&self, path: &Path) -> bool {
        let own = self.document.path();
        !own.as_os_str().is_empty() && self.store.is_one(own, path)
    }

    /// Saves the document to a file, with the first slot's renderer. The file becomes the scene's own.
    pub(super) fn save(&mut self, path: &Path) -> Result<()> {
        if self.replaces(path) {
            let what = match self.is_own(path) {
                true => "it was changed by another program, and would be overwritten",
                false => "the file exists, and would be overwritten",
            };
            let help = "save the scene under another name, or confirm replacing the file";
            return Err(Error::file(path, what, help));
        }
        self.save_over(path)
    }

    /// As [`State::save`], but may replace an existing file.
    pub(super) fn save_over(&mut self, path: &Path) -> Result<()> {
        self.must_not_be_read(path)?;
        // A path with `..` after a missing folder can be written but not read, so the document stores the resolved path.
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
        self.tell(Diagnostic::note(
            "saved",
            format!("saved {}", path.display()),
        ));
        self.opened.push(path.to_owned());
        Ok(())
    }
}
