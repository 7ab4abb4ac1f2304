//! Files that are taken in, and the file that the document is saved to.

use std::path::{Path, PathBuf};

use cutaway::document::{Value, part};
use cutaway::load::Assets;
use cutaway::{Document, Error, Result};

use super::State;
use crate::action::Selection;
use crate::files;
use crate::notice::Notice;

impl State {
    /// Takes files in.
    pub(super) fn take(&mut self, paths: &[PathBuf]) -> Result<()> {
        for path in paths {
            match files::kind(path)? {
                files::Kind::Scene => {
                    let document = Document::read(path)?;
                    let mut opened = Self::open(document, Assets::default())?;
                    opened.revision = self.revision + 1;
                    opened.layout = self.layout;
                    opened.notices.append(&mut self.notices);
                    *self = opened;
                }
                files::Kind::Model => self.take_model(path)?,
                files::Kind::Image => self.take_image(path)?,
            }
            self.tell(Notice::done(format!("opened {}", path.display())));
        }
        Ok(())
    }

    pub(super) fn take_model(&mut self, path: &Path) -> Result<()> {
        let name = path.to_string_lossy();
        let is_first = self.shown.is_none();
        let mut assets = std::mem::take(&mut self.assets);
        let added = self.document.clone();
        let mut document = added;
        let read = document
            .add_part(part(&name))
            .and_then(|()| match is_first {
                true => document.guess_up(&mut assets).map(|_| ()),
                false => Ok(()),
            });
        self.assets = assets;
        read?;
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
            document.set(&format!("relief.{name}.image"), Value::from(file))?;
            let surface = format!("cut.{index}.surfaces.0");
            document.get(&surface)?;
            document.set(&format!("{surface}.relief"), name)
        })
    }

    /// Reads all files again. The scene itself is read again only where nothing of it was changed here.
    pub(super) fn reload(&mut self) -> Result<()> {
        let mut document = self.document.clone();
        let is_file = !document.path().as_os_str().is_empty();
        if is_file && !self.is_changed() {
            document = Document::read(document.path())?;
        }
        let (is_changed, assets) = (self.is_changed(), std::mem::take(&mut self.assets));
        if let Err(error) = self.show(document, true) {
            // What was read is still good.
            self.assets = assets;
            return Err(error);
        }
        if !is_changed {
            self.saved = self.document.clone();
        }
        self.tell(Notice::done("read all files again"));
        Ok(())
    }

    /// Writes the document to a file, with who draws the first slot, and goes on with that.
    pub(super) fn save(&mut self, path: &Path) -> Result<()> {
        let document = self.with_settings(self.document.clone())?;
        let document = document.moved_to(path)?;
        files::write_whole(path, document.to_string().as_bytes())?;
        let document = Document::read(path)?;
        self.show(document, false)?;
        self.saved = self.document.clone();
        self.history.clear();
        self.tell(Notice::done(format!("saved {}", path.display())));
        Ok(())
    }
}
