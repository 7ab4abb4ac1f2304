//! A scene file that can be read again at any time.
//!
//! At a time the numbers that keys move are written into the text, and the text is read by the same readers, from the same
//! meshes. Cost: that of reading the text, which is short, and of whatever relief changed; nothing is opened again.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::keys::Keyed;
use super::reader::{self, Source, Table};
use super::reliefs::Resolved;
use super::stock::Held;
use super::{Contents, KEYS};
use crate::error::{Error, Result};
use crate::scene::frames::Sequence;
use crate::scene::motion::Outwards;
use crate::scene::{Bounds, Key, Part, Scene};

/// A file and what it is made of.
#[derive(Debug)]
pub(in crate::scene) struct Script {
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) keys: Vec<Keyed>,
    pub(super) stock: Vec<Held>,
    /// Of each cut.
    pub(super) cutters: Vec<Option<super::cutters::Held>>,
    /// The reliefs as they were last read.
    pub(super) reliefs: Mutex<Resolved>,
    pub(super) outwards: Outwards,
}

/// Opens the table of a text.
pub(super) fn with_table<T>(
    source: &Source<'_>,
    read: impl FnOnce(&Table<'_>) -> Result<T>,
) -> Result<T> {
    reader::with_table(source, KEYS, read)
}

impl Script {
    /// The keys, as the file has them.
    pub(in crate::scene) fn keys(&self) -> impl Iterator<Item = &Key> {
        self.keys.iter().map(|k| &k.key)
    }

    /// The file, and the images of its reliefs.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let reliefs = self.reliefs.lock().unwrap_or_else(PoisonError::into_inner);
        let images = reliefs.images().map(Path::to_owned);
        std::iter::once(self.path.clone()).chain(images).collect()
    }

    /// The sequences of all parts.
    pub(in crate::scene) fn sequences(&self) -> impl Iterator<Item = &Sequence> {
        self.stock.iter().filter_map(Held::sequence)
    }

    /// The parts at a time, without the rest of the scene.
    pub(in crate::scene) fn parts_at(&self, time_s: f64) -> Result<Vec<Part>> {
        self.read_at(time_s, |root| {
            super::read_parts(root, self, time_s, &mut Vec::new()).map(|c| c.parts)
        })
    }

    /// The scene at a time; what is relative to bounds is relative to the stage.
    pub(in crate::scene) fn scene_at(&self, time_s: f64, stage: Option<Bounds>) -> Result<Scene> {
        self.read_at(time_s, |root| {
            let notes = &mut Vec::new();
            let parts = super::read_parts(root, self, time_s, notes)?;
            self.scene_of(root, parts, stage, notes)
        })
    }

    /// The scene of the text as it is.
    pub(super) fn scene_of(
        &self,
        root: &Table<'_>,
        contents: Contents,
        stage: Option<Bounds>,
        notes: &mut Vec<String>,
    ) -> Result<Scene> {
        let mut reliefs = self.reliefs.lock().unwrap_or_else(PoisonError::into_inner);
        super::read_scene(
            root,
            (&self.path, &self.cutters),
            contents,
            stage,
            &mut reliefs,
            notes,
        )
    }

    fn read_at<T>(&self, time_s: f64, read: impl FnOnce(&Table<'_>) -> Result<T>) -> Result<T> {
        let text = self.text_at(time_s);
        let source = Source {
            path: &self.path,
            text: &text,
        };
        with_table(&source, read).map_err(|e| self.blame(e, time_s))
    }

    /// The text with the numbers of a time. Lines stay where they are: no number has more than one.
    fn text_at(&self, time_s: f64) -> String {
        let mut changes: Vec<_> = self
            .keys
            .iter()
            .flat_map(|keyed| {
                let values = keyed.key.at(time_s);
                let written = keyed.slots.iter().zip(values);
                written.map(|(slot, value)| (slot.span.clone(), slot.write(value)))
            })
            .collect();
        changes.sort_by_key(|(span, _)| span.start);
        let mut text = String::with_capacity(self.text.len() + changes.len() * 16);
        let mut from = 0;
        for (span, number) in changes {
            text.push_str(&self.text[from..span.start]);
            text.push_str(&number);
            from = span.end;
        }
        text.push_str(&self.text[from..]);
        text
    }

    /// An error of the readers, with the keys that may have led to it and when they did.
    fn blame(&self, error: Error, time_s: f64) -> Error {
        let Error::File {
            path,
            line,
            what,
            mend,
        } = error
        else {
            return error;
        };
        if self.keys.is_empty() {
            return Error::File {
                path,
                line,
                what,
                mend,
            };
        }
        let place = what.split('`').nth(1).unwrap_or_default();
        let touches = |keyed: &&Keyed| {
            let (short, long) = if place.len() < keyed.path.len() {
                (place, keyed.path.as_str())
            } else {
                (keyed.path.as_str(), place)
            };
            long.strip_prefix(short)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        let named = |keyed: &Keyed| format!("`{}`, the target of `{}`", keyed.path, keyed.own_path);
        let mut blamed: Vec<String> = self.keys.iter().filter(touches).map(named).collect();
        if blamed.is_empty() {
            blamed = self.keys.iter().map(named).collect();
        }
        let time = (time_s * 1e4).round() / 1e4;
        Error::File {
            path,
            line,
            what: format!("at {time} s ({}): {what}", blamed.join("; ")),
            mend,
        }
    }
}
