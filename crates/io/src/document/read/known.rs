//! Cache of loaded parts across reloads, keyed by their source settings. Splitting bodies and closing holes take longer than a frame, and
//! dragging a cut opens a document for each frame.
//!
//! The visibility of the parts from outside is cached likewise, if roles depend on it.
//!
//! Entries are compared by the keys that affect their opening. A lookup compares an entry with all entries of the last document.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::Result;
use cutaway::scene::{Mesh, Motion, Part, Pose, Sight, sights};
use glam::DAffine3;

use super::opening::Opening;
use super::part_source::PartSource;
use super::reader::Table;
use crate::document::Node;
use crate::load::Assets;

/// Keys that affect the opening of an entry.
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
pub(super) struct Known {
    folder: PathBuf,
    /// The entry's keys among [`OPENED_BY`].
    by: Vec<(&'static str, Node)>,
    /// Source of its parts, without a name or a colour.
    pub(super) source: PartSource,
    notes: Vec<String>,
    files: BTreeSet<PathBuf>,
}

/// The entries of the last opened document.
pub(super) type AllKnown = Vec<Arc<Known>>;

impl Known {
    fn is(&self, folder: &Path, by: &[(&'static str, Node)]) -> bool {
        self.folder == folder && self.by == by
    }
}

impl Opening<'_> {
    /// Opens an entry, or reuses it from the last document, and adds its notes.
    pub(super) fn known(&mut self, table: &Table<'_>, before: &AllKnown) -> Result<Arc<Known>> {
        let said = |key: &&'static str| Some((*key, table.get(key)?.node.clone()));
        let by: Vec<_> = OPENED_BY.iter().filter_map(said).collect();
        let known = match before.iter().find(|known| known.is(self.folder, &by)) {
            Some(known) => known.clone(),
            None => {
                let mut own = Opening {
                    folder: self.folder,
                    assets: &mut *self.assets,
                    notes: Vec::new(),
                    files: BTreeSet::new(),
                };
                let source = own.entry(table)?;
                let Opening { notes, files, .. } = own;
                Arc::new(Known {
                    folder: self.folder.to_owned(),
                    by,
                    source,
                    notes,
                    files,
                })
            }
        };
        let new = known.notes.iter().filter(|note| !self.notes.contains(note));
        let new: Vec<String> = new.cloned().collect();
        self.notes.extend(new);
        self.files.extend(known.files.iter().cloned());
        Ok(known)
    }
}

/// Data that determines the visibility of a part: its mesh, its motion, its placement and its pose.
type PosedMesh = (Arc<Mesh>, Option<Arc<Motion>>, DAffine3, Pose);

/// Visibility of the parts of the last document.
struct KnownSights {
    stands: Vec<PosedMesh>,
    sights: Vec<Sight>,
}

impl KnownSights {
    fn is_of(&self, parts: &[Part]) -> bool {
        let same = |((mesh, motion, placed, pose), part): (&PosedMesh, &Part)| {
            Arc::ptr_eq(mesh, &part.mesh)
                && motion.as_ref().map(Arc::as_ptr) == part.motion.as_ref().map(Arc::as_ptr)
                && *placed == part.world_from_part
                && *pose == part.pose
        };
        self.stands.len() == parts.len() && self.stands.iter().zip(parts).all(same)
    }
}

/// Computes the visibility of each part from outside.
pub(in crate::document) fn sights_of(parts: &[Part], assets: &mut Assets) -> Vec<Sight> {
    if let Some(known) = assets.kept::<KnownSights>()
        && known.is_of(parts)
    {
        return known.sights.clone();
    }
    let stand = |part: &Part| {
        let (mesh, motion) = (part.mesh.clone(), part.motion.clone());
        (mesh, motion, part.world_from_part, part.pose.clone())
    };
    let sights = sights(parts);
    assets.keep(KnownSights {
        stands: parts.iter().map(stand).collect(),
        sights: sights.clone(),
    });
    sights
}
