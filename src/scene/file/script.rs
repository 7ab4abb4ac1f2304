//! A scene file that can be read again at any time.
//!
//! At a time the numbers that keys move are set in the tree of the file, which is read by the same readers, from the same
//! meshes. Cost: that of reading the tree, which is small, and of whatever relief changed; nothing is opened or parsed again.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::keys::{Keyed, Moment};
use super::reader::{Source, Table};
use super::reliefs::Resolved;
use super::stock::Held;
use super::{Contents, KEYS};
use crate::error::Result;
use crate::scene::document::Node;
use crate::scene::frames::Sequence;
use crate::scene::motion::Outwards;
use crate::scene::{Bounds, Key, Part, Scene};

/// A file and what it is made of.
#[derive(Debug)]
pub(in crate::scene) struct Script {
    pub(super) path: PathBuf,
    /// The file as it stands.
    pub(super) root: Node,
    pub(super) keys: Vec<Keyed>,
    pub(super) stock: Vec<Held>,
    /// Of each cut.
    pub(super) cutters: Vec<Option<super::cutters::Held>>,
    /// The reliefs as they were last read.
    pub(super) reliefs: Mutex<Resolved>,
    pub(super) outwards: Outwards,
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
        // Copied only where something moves in it.
        let mut root = Cow::Borrowed(&self.root);
        for keyed in &self.keys {
            keyed.set(root.to_mut(), time_s);
        }
        let keys = self.keys.as_slice();
        let source = Source {
            path: &self.path,
            moment: (!keys.is_empty()).then_some(Moment { time_s, keys }),
        };
        read(&Table::of_file(source, &root, KEYS)?)
    }
}
