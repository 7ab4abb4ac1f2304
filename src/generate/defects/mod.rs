//! Defects put into a mesh on purpose, in measured amounts, to imitate the meshes that users really have.
//!
//! A [`Defect`] is data: a kind, an amount, a seed. The same defect makes the same mesh on every machine. With the same seed, a larger
//! amount damages everything that a smaller one damages, and more, so a sweep over amounts changes only one thing. For every kind, the
//! amount 0 leaves the mesh unchanged.
//!
//! | kind | effect on the mesh | `amount` | further key, its default |
//! |---|---|---|---|
//! | `holes` | faces are missing | share of the faces | `patch`: adjacent faces removed together, 1 |
//! | `flipped` | faces are flipped | share of the faces | `patch` |
//! | `duplicated` | faces appear twice | share of the faces | `patch` |
//! | `t-junctions` | an edge has a vertex at its midpoint that only the face on one side uses | share of the faces | |
//! | `gaps` | the surface is split into charts whose borders do not touch | width of the gaps, a length | `charts`: how many, 8 |
//! | `overlap` | small copies of the mesh stick in its surface | size of a copy relative to the mesh | `copies`: how many, 8 |
//! | `open` | all faces beyond a plane are missing: a bowl without a wall | depth removed, as a share of the box | `axis`: `x` to `-z`, z |
//! | `soup` | no two faces share a vertex, and every corner is moved | largest displacement, a length | |
//!
//! Shares are given in percent; lengths in units of the mesh, or in percent of its bounding-box diagonal.
//!
//! The vertices of the intact mesh stay in the list, whether a face uses them or not; new ones follow them, and none leaves the
//! bounding box. A broken mesh thus has the intact mesh's box, so that the same camera frames both, the same section cuts both, and
//! the two can be compared. (A part rotated off the axes has a different box in world space, which soup, gaps and overlaps may
//! stretch a little.)
//!
//! Cost: a sort of the edges or of the faces. Limit: new vertices move with the vertices they come from; under skinning, the
//! midpoint of an edge moves with one of its ends.

mod edit;
mod faces;
mod select;
mod shells;
mod spec;

use std::sync::Arc;

use crate::error::Diagnostic;
use crate::scene::memo::{ById, Memo};
use crate::scene::meshes::weld::thousands;
use crate::scene::{Amount, Bounds, Mesh, Part};
use crate::{Error, Result};
use edit::Edit;

/// A deliberate defect of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defect {
    /// Kind of the defect.
    pub kind: DefectKind,
    /// Amount of the defect; the table in the module docs gives the unit for each kind.
    pub amount: Amount,
    /// Seed for the choice of faces and for displacements.
    pub seed: u64,
}

/// Kind of damage to a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefectKind {
    /// Faces are missing, in patches of `patch` faces.
    Holes {
        /// Faces that go together.
        patch: u32,
    },
    /// Faces are flipped, in patches of `patch` faces.
    Flipped {
        /// Faces that go together.
        patch: u32,
    },
    /// Faces are duplicated, in patches of `patch` faces.
    Duplicated {
        /// Faces that go together.
        patch: u32,
    },
    /// Edges are split on one side only.
    TJunctions,
    /// The surface is split into `charts` charts whose borders do not touch; more if it already has more connected components.
    Gaps {
        /// Number of charts.
        charts: u32,
    },
    /// `copies` small copies of the mesh stick in its surface.
    Overlap {
        /// Number of copies.
        copies: u32,
    },
    /// All faces beyond a plane are missing.
    Open {
        /// Index of the axis.
        axis: usize,
        /// True if the end with the smaller coordinates is removed.
        from_below: bool,
    },
    /// Faces share no vertices, and their corners are displaced.
    Soup,
}

impl Defect {
    /// The mesh with the defect, the original of each vertex, and a description of what was done. An amount that leaves no face
    /// is refused.
    fn applied(&self, mesh: &Mesh) -> Result<Option<(Edit, String)>> {
        let diagonal = mesh.bounds().size().length();
        let amount = match self.amount {
            Amount::Percent(p) if self.kind.is_length() => diagonal * p / 100.0,
            Amount::Percent(p) => p / 100.0,
            Amount::Units(v) => v,
        };
        if amount <= 0.0 {
            return Ok(None);
        }
        let mut edit = Edit::of(mesh);
        if let DefectKind::Overlap { copies } = self.kind {
            let copies = edit.faces.len().min(copies as usize);
            let faces = edit.faces.len().saturating_mul(copies + 1);
            if faces > MOST_FACES {
                return Err(Error::input(
                    format!("defect `{self}`"),
                    format!(
                        "it makes {} faces out of {}",
                        thousands(faces),
                        thousands(edit.faces.len())
                    ),
                    "take fewer copies, or a coarser mesh",
                ));
            }
        }
        let did = match self.kind {
            DefectKind::Holes { patch } => faces::holes(&mut edit, amount, patch, self.seed),
            DefectKind::Flipped { patch } => faces::flip(&mut edit, amount, patch, self.seed),
            DefectKind::Duplicated { patch } => {
                faces::duplicate(&mut edit, amount, patch, self.seed)
            }
            DefectKind::TJunctions => faces::split_one_side(&mut edit, amount, self.seed),
            DefectKind::Gaps { charts } => shells::pull_apart(&mut edit, amount, charts, self.seed),
            DefectKind::Overlap { copies } => shells::overlap(&mut edit, amount, copies, self.seed),
            DefectKind::Open { axis, from_below } => {
                faces::open(&mut edit, amount, axis, from_below)
            }
            DefectKind::Soup => shells::unweld(&mut edit, amount, self.seed),
        };
        if edit.faces.is_empty() {
            let help = "take a smaller amount";
            return Err(Error::input(
                format!("defect `{self}`"),
                "it leaves no face",
                help,
            ));
        }
        Ok(Some((edit, did)))
    }

    /// The mesh with the defect.
    pub fn apply(&self, mesh: &Mesh) -> Result<Mesh> {
        Ok(match self.applied(mesh)? {
            Some((edit, _)) => edit.finish().0,
            None => mesh.clone(),
        })
    }
}

/// A mesh with defects, its original, and a description of what was done.
struct Broken {
    mesh: Arc<Mesh>,
    /// Per vertex of `mesh`, the vertex of `whole` it comes from.
    origins: Vec<u32>,
    did: Vec<String>,
}

impl Broken {
    fn of(whole: &Arc<Mesh>, defects: &[Defect]) -> Result<Self> {
        let mut broken = Self {
            mesh: Arc::clone(whole),
            origins: (0..whole.positions.len() as u32).collect(),
            did: Vec::new(),
        };
        for defect in defects {
            let did = match defect.applied(&broken.mesh)? {
                None => "nothing".to_owned(),
                Some((edit, did)) => {
                    let (mesh, origins) = edit.finish();
                    let of_whole = |i: &u32| broken.origins[*i as usize];
                    broken.origins = origins.iter().map(of_whole).collect();
                    broken.mesh = Arc::new(mesh);
                    did
                }
            };
            broken.did.push(format!("defect `{defect}`: {did}"));
        }
        Ok(broken)
    }
}

/// Largest face count a defect may produce; more are taken for a typing error.
const MOST_FACES: usize = 50_000_000;

/// Applies defects, in order, to the meshes of parts and reports what each did. Parts that share a mesh share the broken one.
pub fn break_parts<'a>(
    parts: impl IntoIterator<Item = &'a mut Part>,
    defects: &[Defect],
) -> Result<Vec<Diagnostic>> {
    let mut notes = Vec::new();
    if defects.is_empty() {
        return Ok(notes);
    }
    let done: Memo<ById<Mesh>, Arc<Broken>> = Memo::default();
    for part in parts {
        let broken = done.get_or_try_make(ById(part.mesh.clone()), |mesh| {
            Broken::of(&mesh.0, defects).map(Arc::new)
        })?;
        let note = |did: &String| Diagnostic::note("defect", did).about(&part.name);
        notes.extend(broken.did.iter().map(note));
        if Arc::ptr_eq(&broken.mesh, &part.mesh) {
            continue;
        }
        part.mesh = Arc::clone(&broken.mesh);
        if let Some(motion) = &part.motion {
            let mut moved = motion.of_positions(&broken.origins);
            if !motion.outward.is_empty() {
                moved.outward = part.mesh.outward();
            }
            part.motion = Some(Arc::new(moved));
        }
    }
    Ok(notes)
}

/// `3 of 1,920 faces`.
fn of_faces(count: usize, all: usize) -> String {
    format!("{} of {} faces", thousands(count), thousands(all))
}

/// The mean of some points.
fn middle(points: impl Iterator<Item = glam::DVec3>) -> glam::DVec3 {
    let (sum, count) = points.fold((glam::DVec3::ZERO, 0.0_f64), |(s, n), p| (s + p, n + 1.0));
    sum / count.max(1.0)
}

/// The point of a box nearest to `p`.
fn within(bounds: &Bounds, p: glam::DVec3) -> glam::DVec3 {
    p.max(bounds.min).min(bounds.max)
}
