//! Cache of loaded parts across reloads, keyed by their source settings. Dragging a cut opens a document for each frame, and splitting
//! bodies and closing holes takes longer than a frame.
//!
//! If roles depend on the visibility of parts from outside, the visibility is cached likewise.
//!
//! Entries are compared by the keys that affect how they are opened. A lookup compares an entry with all entries of the last document.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::memo::{ById, Memo};
use cutaway::scene::{Mesh, Motion, Part, Pose, Sight, sights};
use glam::DAffine3;

use super::opening::LoadContext;
use super::part_source::PartSource;
use super::reader::Table;
use crate::document::Node;
use crate::load::Assets;

/// Keys that affect how an entry is opened.
const OPENED_BY: [&str; 10] = [
    "mesh",
    "shape",
    "fps",
    "first",
    "loop",
    "split",
    "only",
    "except",
    "defects",
    "close_holes",
];

/// An opened entry.
pub(super) struct OpenedEntry {
    /// Source of the entry's parts, which have no names and colours yet.
    pub(super) source: PartSource,
    notes: Vec<Diagnostic>,
    files: BTreeSet<PathBuf>,
}

/// The document's folder, and those of the entry's keys that are in [`OPENED_BY`].
type EntryKey = (PathBuf, Vec<(&'static str, Node)>);

/// The opened entries of a document.
pub(super) type OpenedEntries = Memo<EntryKey, Arc<OpenedEntry>>;

impl LoadContext<'_> {
    /// Opens an entry, or reuses an equal entry of this document or the last one, and adds its notes.
    pub(super) fn known(
        &mut self,
        table: &Table<'_>,
        before: &OpenedEntries,
        now: &OpenedEntries,
    ) -> Result<Arc<OpenedEntry>> {
        let given = |key: &&'static str| Some((*key, table.get(key)?.node.clone()));
        let by: Vec<_> = OPENED_BY.iter().filter_map(given).collect();
        let known = now.get_or_try_make((self.folder.to_owned(), by), |key| {
            if let Some(known) = before.get(key) {
                return Ok(known);
            }
            let mut own = LoadContext {
                folder: self.folder,
                assets: &mut *self.assets,
                notes: Vec::new(),
                files: BTreeSet::new(),
            };
            let source = own.entry(table)?;
            let LoadContext { notes, files, .. } = own;
            Ok::<_, Error>(Arc::new(OpenedEntry {
                source,
                notes,
                files,
            }))
        })?;
        let new = known.notes.iter().filter(|note| !self.notes.contains(note));
        let new: Vec<Diagnostic> = new.cloned().collect();
        self.notes.extend(new);
        self.files.extend(known.files.iter().cloned());
        Ok(known)
    }
}

/// Data that determines the visibility of a part, namely its mesh, motion, placement and pose.
type PosedMesh = (ById<Mesh>, Option<ById<Motion>>, DAffine3, Pose);

/// Visibility of the parts of the last document.
type KnownSights = Memo<Vec<PosedMesh>, Vec<Sight>>;

/// Computes the visibility of each part from outside.
pub(in crate::document) fn sights_of(parts: &[Part], assets: &mut Assets) -> Vec<Sight> {
    let posed_mesh = |part: &Part| {
        let (mesh, motion) = (ById(part.mesh.clone()), ById::of(part.motion.as_ref()));
        (mesh, motion, part.world_from_part, part.pose.clone())
    };
    let known = assets.kept::<KnownSights>();
    let known = known.unwrap_or_else(|| assets.keep(KnownSights::with_capacity(1)));
    known.get_or_make(parts.iter().map(posed_mesh).collect(), |_| sights(parts))
}
