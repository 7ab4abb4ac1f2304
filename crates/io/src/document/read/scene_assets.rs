//! Sources of a scene's parts, cuts and reliefs: meshes, shapes, images and frames, each opened once.
//!
//! The numbers of a document may change over time, but its texts may not. So everything that a text names is opened with the document.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use cutaway::error::{Diagnostic, Result};
use cutaway::scene::{CutoutFrame, Fit, Sight, Style};

use super::clip::cutters::CutterSource;
use super::clip::reliefs::ReliefImages;
use super::known::OpenedEntries;
use super::opening::LoadContext;
use super::part_source::PartSource;
use super::parts::{KEYS, MATERIAL};
use super::reader::{Entry, Table};
use super::{cap_materials, hatches};

/// Opened assets of a document.
#[derive(Debug)]
pub(in crate::document) struct SceneAssets {
    /// Source of each part.
    pub(in crate::document) parts: Vec<PartSource>,
    /// Cutter of each cut.
    pub(super) cutters: Vec<Option<CutterSource>>,
    pub(super) images: ReliefImages,
    /// Base of the document's style, if it has one.
    pub(in crate::document) style: Option<Style>,
    /// What an orbiting camera frames by default.
    pub(in crate::document) fit: Fit,
    /// Visibility from outside of each part, if the roles depend on it.
    pub(in crate::document) sights: Option<BTreeMap<String, Sight>>,
    /// Frames of the cutouts, by the index of their cut. Empty until they are computed.
    pub(in crate::document) frames: BTreeMap<usize, CutoutFrame>,
    /// Notes about the assets.
    pub(in crate::document) notes: Vec<Diagnostic>,
    /// All files that were read.
    pub(in crate::document) files: BTreeSet<PathBuf>,
}

/// Opens the files of a document's parts.
pub(super) fn open(
    entries: &[Entry<'_>],
    opening: &mut LoadContext<'_>,
) -> Result<Vec<PartSource>> {
    let mut sources = Vec::with_capacity(entries.len());
    let mut given = Vec::with_capacity(entries.len());
    let mut of_caps = Vec::with_capacity(entries.len());
    let before = opening.assets.kept::<OpenedEntries>().unwrap_or_default();
    let now = OpenedEntries::default();
    for entry in entries {
        let table = entry.table(KEYS.all())?;
        let name = table.get("name");
        if let Some(name) = &name
            && name.text()?.is_empty()
        {
            return Err(name.fault("it is empty", "give the part a name, or remove the key"));
        }
        given.push(name.map(|n| n.text()).transpose()?);
        let known = opening.known(&table, &before, &now)?;
        sources.push(known.source.clone());
        let hatch = of_material(&table, "hatch")?;
        let hatch = hatch.map(|hatch| hatches::open(&hatch, opening));
        let cap = of_material(&table, "cap")?;
        let cap = cap.map(|cap| cap_materials::open(&cap, opening));
        of_caps.push((hatch.transpose()?, cap.transpose()?));
    }
    opening.assets.keep(now);
    let mut taken = BTreeSet::new();
    // Names from the document have priority over names from files.
    for is_given in [true, false] {
        let entries = sources.iter_mut().zip(&given);
        entries
            .filter(|(_, name)| name.is_some() == is_given)
            .for_each(|(held, name)| held.call(*name, &mut taken));
    }
    let mut shapes = Vec::new();
    sources.iter_mut().for_each(|held| held.colour(&mut shapes));
    for (held, (hatch, cap)) in sources.iter_mut().zip(of_caps) {
        for solid in held.solids_mut() {
            let material = &mut solid.part.material;
            if let Some(hatch) = &hatch {
                material.hatch = hatch.clone();
            }
            material.cap.clone_from(&cap);
        }
    }
    Ok(sources)
}

/// Returns the value of a key in the material of a part.
pub(super) fn of_material<'a>(part: &Table<'a>, key: &str) -> Result<Option<Entry<'a>>> {
    let material = part.get("material").map(|m| m.table(MATERIAL.all()));
    Ok(material.transpose()?.and_then(|m| m.get(key)))
}
