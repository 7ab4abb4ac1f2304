//! Defects put into a mesh on purpose: what the meshes that users really have are like, in measured amounts.
//!
//! A [`Defect`] is data: a kind, an amount, a seed. The same defect makes the same mesh on every machine. Of one seed, a greater
//! amount spoils what a smaller one did and more: a sweep over amounts is a sweep of one thing. The amount 0 of every kind leaves
//! the mesh as it is.
//!
//! | kind | what becomes of the mesh | `amount` | further key |
//! |---|---|---|---|
//! | `holes` | faces are missing | share of the faces | `patch`: faces that go together, 1 |
//! | `flipped` | faces are turned over | share of the faces | `patch` |
//! | `duplicated` | faces are there twice | share of the faces | `patch` |
//! | `t-junctions` | an edge has a vertex in its middle that only the face on one side knows | share of the faces | |
//! | `gaps` | the surface falls into charts whose rims do not touch | width of the gaps, a length | `charts`: how many, 8 |
//! | `overlap` | small copies of the mesh stick in its surface | size of a copy over that of the mesh | `copies`: how many, 8 |
//! | `open` | all faces beyond a plane are missing: a bowl without a wall | depth removed, as a share of the box | `axis`: `x` to `-z`, z |
//! | `soup` | no two faces share a vertex, and every corner is moved | how far at most, a length | |
//!
//! Shares are given in percent; lengths in units of the mesh, or in percent of the diagonal of its box.
//!
//! The vertices of the whole mesh stay in the list, whether a face uses them or not, new ones come after them, and none leaves the
//! box of the mesh: a broken mesh has the box of the whole one, so that the same camera frames both, the same section cuts both, and
//! one can be judged by the other. (A part that is placed askew has another box in the world, which soup, gaps and overlaps may
//! stretch a little.)
//!
//! Cost: a sort of the edges or of the faces. Limit: new vertices move as the vertices they come from; the middle of an edge goes
//! with one of its ends under a skin.

mod edit;
mod faces;
mod select;
mod shells;
mod spec;

use std::sync::Arc;

use crate::scene::meshes::weld::thousands;
use crate::scene::{Amount, Bounds, Mesh, Part};
use crate::{Error, Result};
use edit::Edit;

/// One way to spoil a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defect {
    /// Kind of the defect.
    pub kind: DefectKind,
    /// Amount of the defect; the table of the module lists its unit per kind.
    pub amount: Amount,
    /// Chooses which faces, and where they go.
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
    /// Faces are turned over, in patches of `patch` faces.
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
    /// The surface falls into `charts` charts, or more if it is in pieces already, whose rims do not touch.
    Gaps {
        /// Number of charts.
        charts: u32,
    },
    /// So many small copies stick in the surface.
    Overlap {
        /// Number of copies.
        copies: u32,
    },
    /// All faces beyond a plane are missing.
    Open {
        /// Number of the axis.
        axis: usize,
        /// The end with the smaller coordinates goes.
        from_below: bool,
    },
    /// Faces share no vertices, and corners are moved.
    Soup,
}

impl Defect {
    /// The mesh with the defect, the vertex that each of its vertices comes from, and what was done. An amount is refused that
    /// leaves no face.
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
                        "it makes {} faces of {}",
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

/// A mesh with defects, whom it comes from, and what was done.
struct Broken {
    whole: Arc<Mesh>,
    mesh: Arc<Mesh>,
    /// Per vertex of `mesh`, the vertex of `whole`.
    origins: Vec<u32>,
    did: Vec<String>,
}

impl Broken {
    fn of(whole: &Arc<Mesh>, defects: &[Defect]) -> Result<Self> {
        let mut broken = Self {
            whole: Arc::clone(whole),
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

/// More faces than this are a slip of a defect that multiplies them.
const MOST_FACES: usize = 50_000_000;

/// Puts defects into the meshes of parts, in their order, and says what each did. Parts that share a mesh share the broken one.
pub fn break_parts<'a>(
    parts: impl IntoIterator<Item = &'a mut Part>,
    defects: &[Defect],
) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    if defects.is_empty() {
        return Ok(notes);
    }
    let mut done: Vec<Broken> = Vec::new();
    for part in parts {
        let known = done.iter().position(|b| Arc::ptr_eq(&b.whole, &part.mesh));
        let known = match known {
            Some(known) => known,
            None => {
                done.push(Broken::of(&part.mesh, defects)?);
                done.len() - 1
            }
        };
        let broken = &done[known];
        notes.extend(broken.did.iter().map(|did| format!("{}: {did}", part.name)));
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

/// The middle of some points.
fn middle(points: impl Iterator<Item = glam::DVec3>) -> glam::DVec3 {
    let (sum, count) = points.fold((glam::DVec3::ZERO, 0.0_f64), |(s, n), p| (s + p, n + 1.0));
    sum / count.max(1.0)
}

/// The point of a box that is nearest.
fn within(bounds: &Bounds, p: glam::DVec3) -> glam::DVec3 {
    p.max(bounds.min).min(bounds.max)
}
