//! The solids of a file, a shape or a frame, and which of them a part takes by `split`, `only` and `except`, applied in this order.
//!
//! `split = true` divides each solid into its bodies ([`Bodies`]), which are numbered: `gear/1`, `gear/2`. A solid with one body keeps its
//! name. All frames of a sequence are split like the first, so all must have the same triangles.

use std::path::Path;
use std::sync::Arc;

use cutaway::error::{Diagnostic, Error, Result, did_you_mean};
use cutaway::scene::memo::{ById, Memo};
use cutaway::scene::weld::thousands;
use cutaway::scene::{
    Bodies, Bounds, GeometryId, Material, Mesh, Part, Pieces, body_name, glob_matches,
};

use super::reader::Table;

/// Maximum number of bodies. More could not be distinguished in a picture.
const MOST_BODIES: usize = 1 << 16;

/// A solid from a file, or one body of a solid.
#[derive(Clone, Debug)]
pub(super) struct SourceSolid {
    pub(super) part: Part,
    /// Bounds of the solid in part space.
    pub(super) rest: Bounds,
    /// Suffix that follows the entry's name in the part name, or `None` if the entry is a single solid.
    pub(super) below: Option<String>,
    /// True if the file does not give the solid a colour.
    pub(super) is_plain: bool,
}

impl SourceSolid {
    /// Converts parts to solids. `below` returns the name suffix of each.
    pub(super) fn all(parts: &[Part], below: impl Fn(usize, &Part) -> Option<String>) -> Vec<Self> {
        let solid = |(index, part): (usize, &Part)| Self {
            rest: Bounds::EMPTY,
            below: below(index, part),
            is_plain: part.material == Material::of_index(index),
            part: part.clone(),
        };
        parts.iter().enumerate().map(solid).collect()
    }

    /// Updates the solid's bounds.
    pub(super) fn measure(&mut self) {
        self.rest = self.part.posed_mesh().bounds();
    }
}

/// Describes how the solids of a file, or of a sequence's first frame, are split into bodies.
pub(super) struct BodySplits {
    /// Bodies of each solid.
    bodies: Vec<Bodies>,
    /// Meshes that have been split. Solids with the same mesh share the result.
    known: Memo<GeometryId, Arc<Pieces>>,
}

impl BodySplits {
    /// Finds the bodies of solids, if the entry has `split`.
    pub(super) fn asked_for(table: &Table<'_>, solids: &[SourceSolid]) -> Result<Option<Self>> {
        let Some(entry) = table.get("split") else {
            return Ok(None);
        };
        if !entry.flag()? {
            return Ok(None);
        }
        let bodies: Memo<ById<Mesh>, Bodies> = Memo::default();
        let of_solid = |solid: &SourceSolid| {
            bodies.get_or_make(ById(solid.part.mesh.clone()), |mesh| Bodies::of(&mesh.0))
        };
        let splits = Self {
            bodies: solids.iter().map(of_solid).collect(),
            known: Memo::default(),
        };
        let count = splits.count();
        if count > MOST_BODIES {
            let (count, most) = (thousands(count), thousands(MOST_BODIES));
            let what = format!("the mesh has {count} bodies, and at most {most} can be parts");
            return Err(entry.fault(what, "remove `split`, or use a mesh with fewer bodies"));
        }
        Ok(Some(splits))
    }

    fn count(&self) -> usize {
        self.bodies.iter().map(Bodies::count).sum()
    }

    /// Note about the bodies found in a file or shape.
    pub(super) fn note(&self, of: &str) -> Diagnostic {
        let (count, solids) = (self.count(), self.bodies.len());
        let bodies = match count {
            1 => "1 body".to_owned(),
            count => format!("{} bodies", thousands(count)),
        };
        let parts = if solids == 1 { "part" } else { "parts" };
        let open = match self.bodies.iter().map(Bodies::open).sum() {
            0 => String::new(),
            open => format!(", {} of them open", thousands(open)),
        };
        let nothing = match count == solids {
            true => ": there is nothing to split",
            false => "",
        };
        let text = format!("{bodies} in {} {parts}{open}{nothing}", thousands(solids));
        Diagnostic::note("bodies", text).about(of)
    }

    /// Splits solids. They must have the same triangles as the solids whose bodies were found.
    pub(super) fn applied(&mut self, solids: Vec<SourceSolid>) -> Vec<SourceSolid> {
        let mut taken: Vec<String> = solids.iter().map(|s| s.part.name.clone()).collect();
        taken.sort_unstable();
        let mut all = Vec::with_capacity(self.count());
        for (solid, bodies) in solids.into_iter().zip(&self.bodies) {
            let pieces = self.known.get_or_make(GeometryId::of(&solid.part), |_| {
                Arc::new(Pieces::of(&solid.part, bodies))
            });
            let parts = pieces.parts(&solid.part);
            if parts.len() == 1 {
                all.push(solid);
                continue;
            }
            for (number, mut part) in (1..).zip(parts) {
                let mut name = body_name(&solid.part.name, number);
                // The file may already use that name for a solid.
                while taken.binary_search(&name).is_ok() {
                    name.push_str("_2");
                }
                part.name = name;
                let below = match &solid.below {
                    Some(below) => body_name(below, number),
                    None => number.to_string(),
                };
                all.push(SourceSolid {
                    part,
                    below: Some(below),
                    ..solid
                });
            }
        }
        all
    }

    /// Refuses a frame whose triangles differ from the first frame's.
    pub(super) fn must_fit(
        &self,
        (first, first_file): (&[SourceSolid], &Path),
        (frame, file): (&[SourceSolid], &Path),
    ) -> Result<()> {
        let fits = first.len() == frame.len()
            && (first.iter().zip(frame))
                .all(|(a, b)| a.part.mesh.triangles == b.part.mesh.triangles);
        if fits {
            return Ok(());
        }
        let what = format!(
            "the frame's triangles differ from those of {}, by which all frames are split",
            first_file.display()
        );
        let help = "leave `split` out, or export all frames with the same triangles";
        Err(Error::file(file, what, help))
    }
}

/// The solids that `only` and `except` select.
pub(super) fn chosen(table: &Table<'_>, solids: Vec<SourceSolid>) -> Result<Vec<SourceSolid>> {
    let names: Vec<String> = solids.iter().map(|s| s.part.name.clone()).collect();
    let mut left = solids;
    for (key, keep) in [("only", true), ("except", false)] {
        let Some(entry) = table.get(key) else {
            continue;
        };
        let globs = entry.texts()?;
        for glob in &globs {
            if !names.iter().any(|name| glob_matches(glob, name)) {
                let what = format!("there is no solid `{glob}`");
                let names = names.iter().map(String::as_str);
                return Err(entry.fault(what, did_you_mean(glob, names)));
            }
        }
        left.retain(|s| keep == globs.iter().any(|g| glob_matches(g, &s.part.name)));
        if left.is_empty() {
            return Err(entry.fault(
                "it leaves no solid",
                "change the globs so that a solid remains",
            ));
        }
    }
    Ok(left)
}
