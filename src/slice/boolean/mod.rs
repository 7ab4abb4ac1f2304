//! Kept and removed half of a mesh, where reliefs and cutters are among the removing surfaces.
//!
//! Each region becomes a closed mesh: a block around the part, divided by the planes of the region as [`halves`] divides meshes, in common
//! with what lies below its reliefs ([`sheet`]) and within or around its cutter. The part in common with all regions is what is removed,
//! the part without them what is left. Booleans are those of `manifold-rust`: the algorithm of Manifold (Lalish) where meshes are manifold
//! and do not pass through themselves, else an arrangement in rational numbers.
//!
//! Cost: n log n in the triangles of part and regions together, with those of a relief growing with the square of its cells; many times
//! that where the part passes through itself.
//!
//! Cannot: cut open meshes, which are refused. Bodies of a part that overlap become the solid that the fill rule of the part makes of them
//! ([`filled`]). A body that passes through itself becomes the solid that it winds around, without walls inside; one that is inside out is
//! turned over first. Reliefs are followed to within what [`Sheet::off`](sheet::Sheet::off) says.

mod filled;
mod sheet;
mod solid;

use self::filled::filled;
use self::sheet::{Sheet, below};
pub(super) use self::solid::Undivided;
pub use self::solid::is_at_work;
use self::solid::{ManifoldSolid, Origin};
use super::SlicePlane;
use super::capped::{Cap, Half, Halves, halves, of_used};
use super::in_world::in_world;
use crate::scene::{Bounds, ClipSurface, Cutter, Edges, Fill, Mesh};

/// Region that a cut removes from a part.
pub(super) struct Region<'a> {
    /// In world space, moved by the offset of the part.
    pub(super) surfaces: Vec<ClipSurface>,
    pub(super) cutter: Option<&'a Cutter>,
}

/// A part divided by regions.
pub(super) struct Divided {
    pub(super) halves: Halves,
    /// Distance of the caps from the reliefs along `N`, in world units.
    pub(super) off: f64,
}

/// Name of the faces of a block: no clip-surface.
const BLOCK: u32 = u32::MAX;

/// Source of the cap faces of a mesh: the mesh, its region, and the clip-surface; `None` where its faces keep the name of their source.
struct CapOf {
    mesh: u32,
    region: usize,
    surface: Option<usize>,
}

/// Divides a mesh into what lies in any region, and the rest. Reliefs get about `cells` cells along the longer side of the mesh.
///
/// # Errors
///
/// A mesh or a cutter that is not closed, and operations that fail.
pub(super) fn divided(
    mesh: &Mesh,
    fill: Fill,
    regions: &[Region<'_>],
    cells: u32,
) -> Result<Divided, Undivided> {
    let (part, numbers) = filled(mesh, fill)?;
    let block = around(&mesh.bounds());
    let mut caps = Vec::new();
    let mut off = 0.0_f64;
    let mut all: Option<ManifoldSolid> = None;
    for (index, region) in regions.iter().enumerate() {
        let Some(solid) = region.solid(index, &block, cells, &mut caps, &mut off)? else {
            continue;
        };
        all = Some(match all {
            Some(all) => all.or(&solid)?,
            None => solid,
        });
    }
    let (kept, removed) = match all {
        Some(all) => (part.without(&all)?, part.and(&all)?),
        None => (part.clone(), part.without(&part)?),
    };
    let half = |solid: &ManifoldSolid| half(solid, &numbers, &caps);
    Ok(Divided {
        halves: Halves {
            kept: half(&kept)?,
            removed: half(&removed)?,
            defects: Vec::new(),
        },
        off,
    })
}

impl Region<'_> {
    /// Its part of a block; none where nothing of the block is in it.
    fn solid(
        &self,
        index: usize,
        block: &Bounds,
        cells: u32,
        caps: &mut Vec<CapOf>,
        off: &mut f64,
    ) -> Result<Option<ManifoldSolid>, Undivided> {
        let mut add = |mesh, surface| {
            caps.push(CapOf {
                mesh,
                region: index,
                surface,
            });
        };
        let flat = |surface: &ClipSurface| SlicePlane::of_flat(surface);
        let planes: Vec<(usize, SlicePlane)> = (self.surfaces.iter().enumerate())
            .filter_map(|(i, surface)| Some((i, flat(surface)?)))
            .collect();
        let planes_alone: Vec<SlicePlane> = planes.iter().map(|(_, plane)| *plane).collect();
        let within = halves(&block_mesh(block), &[planes_alone]).removed;
        if within.mesh.triangles.is_empty() {
            return Ok(None);
        }
        let name = |t: usize| match within.caps.iter().find(|c| c.triangles.contains(&t)) {
            Some(cap) => planes[cap.plane].0 as u32,
            None => BLOCK,
        };
        let (mut solid, number) = ManifoldSolid::new(&within.mesh, name)?;
        add(number, None);
        for (i, surface) in self.surfaces.iter().enumerate() {
            if flat(surface).is_none() {
                let Sheet { mesh, off: own } = below(surface, block, cells);
                *off = off.max(own);
                let (sheet, number) = ManifoldSolid::new(&mesh, |t| t as u32)?;
                add(number, Some(i));
                solid = solid.and(&sheet)?;
            }
        }
        if let Some(cutter) = self.cutter {
            let placed = in_world(cutter.mesh(), &cutter.world_from_cutter);
            let outward = if placed.volume() < 0.0 {
                turned(&placed)
            } else {
                placed
            };
            let of_cutter = |e: Undivided| match e {
                Undivided::Open => Undivided::OpenCutter {
                    name: cutter.name().to_owned(),
                },
                other => other,
            };
            let (volume, number) = ManifoldSolid::new(&outward, |t| t as u32).map_err(of_cutter)?;
            add(number, Some(self.surfaces.len()));
            solid = match cutter.keeps_inside {
                true => solid.without(&volume)?,
                false => solid.and(&volume)?,
            };
        }
        Ok((!solid.is_empty()).then_some(solid))
    }
}

/// The faces of a solid that are of the part, then its caps by region and clip-surface.
fn half(solid: &ManifoldSolid, part: &[u32], caps: &[CapOf]) -> Result<Half, Undivided> {
    let (mesh, origins) = solid.mesh();
    if Edges::of(&mesh.triangles).count().open > 0 {
        return Err(Undivided::Failed {
            what: "it left the mesh open".to_owned(),
        });
    }
    // Faces of the part are before all caps; then by region and clip-surface.
    let place = |origin: &Origin| {
        let cap = caps.iter().find(|c| c.mesh == origin.mesh);
        cap.map(|cap| (cap.region, cap.surface.unwrap_or(origin.face as usize)))
    };
    let mut order: Vec<_> = (origins.iter().enumerate())
        .map(|(t, origin)| match part.contains(&origin.mesh) {
            true => (None, origin.face, t),
            false => (place(origin), 0, t),
        })
        .collect();
    order.sort_unstable();
    let faces = order.partition_point(|(cap, _, _)| cap.is_none());
    let mut made = Half {
        sources: order[..faces]
            .iter()
            .map(|(_, source, _)| *source)
            .collect(),
        ..Half::default()
    };
    let mut first = faces;
    for run in order[faces..].chunk_by(|a, b| a.0 == b.0) {
        let triangles = first..first + run.len();
        first = triangles.end;
        if let Some((region, plane)) = run[0].0 {
            made.caps.push(Cap {
                region,
                plane,
                triangles,
            });
        }
    }
    let triangles = order.iter().map(|(_, _, t)| mesh.triangles[*t]).collect();
    made.mesh = of_used(&mesh.positions, triangles);
    Ok(made)
}

/// The mesh with its inside out.
fn turned(mesh: &Mesh) -> Mesh {
    Mesh {
        positions: mesh.positions.clone(),
        triangles: (mesh.triangles.iter())
            .map(|[a, b, c]| [*a, *c, *b])
            .collect(),
        ..Mesh::default()
    }
}

/// Bounds that hold others with room on all sides.
fn around(bounds: &Bounds) -> Bounds {
    let room = bounds.radius() / 16.0;
    Bounds {
        min: bounds.min - room,
        max: bounds.max + room,
    }
}

/// A block.
fn block_mesh(bounds: &Bounds) -> Mesh {
    // Corners in the order of `Bounds::corners`; each face from outside, counter-clockwise.
    const FACES: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    Mesh {
        positions: bounds.corners().to_vec(),
        triangles: (FACES.iter())
            .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
            .collect(),
        ..Mesh::default()
    }
}
