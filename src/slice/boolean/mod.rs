//! Kept and removed half of a mesh, when the removing surfaces include reliefs or cutters.
//!
//! Each region becomes a closed mesh: a block around the part, divided by the region's planes as [`halves`] divides meshes, intersected
//! with the volume below its reliefs ([`sheet`]) and inside or around its cutter. The part's intersection with all regions is the removed
//! half, the part minus the regions the kept half. The Boolean operations are those of `manifold-rust`: Manifold's algorithm (Lalish) for
//! manifold meshes without self-intersections, otherwise an arrangement in rational numbers.
//!
//! Cost: n log n in the triangles of part and regions together, where a relief's triangles grow with the square of its cells; many times
//! that if the part intersects itself.
//!
//! Cannot: cut open meshes, which are refused. Overlapping bodies of a part become the solid that the part's fill rule makes of them
//! ([`filled`]). A body that intersects itself becomes the solid that it winds around, without inner walls; one that is inside out is
//! reversed first. Reliefs are followed to within the error [`Sheet::off`](sheet::Sheet::off).

mod filled;
mod sheet;
mod solid;

use self::filled::filled;
use self::sheet::{Sheet, below};
pub(super) use self::solid::Undivided;
pub use self::solid::is_at_work;
use self::solid::{FaceOrigin, ManifoldSolid};
use super::SlicePlane;
use super::capped::{Cap, Half, Halves, halves, of_used};
use super::in_world::in_world;
use crate::scene::{Bounds, ClipSurface, Cutter, Edges, Fill, Mesh};

/// A region that a cut removes from a part.
pub(super) struct RemovedRegion<'a> {
    /// The region's clip-surfaces in world space, moved by the part's offset.
    pub(super) surfaces: Vec<ClipSurface>,
    pub(super) cutter: Option<&'a Cutter>,
}

/// A part divided by regions.
pub(super) struct Divided {
    pub(super) halves: Halves,
    /// Distance of the caps from the reliefs along `N`, in world units.
    pub(super) off: f64,
}

/// Face name for a block, whose faces belong to no clip-surface.
const BLOCK: u32 = u32::MAX;

/// Source of a mesh's cap faces: the mesh, its region and the clip-surface; `None` if its faces keep the name of their source.
struct CapOf {
    mesh: u32,
    region: usize,
    surface: Option<usize>,
}

/// Divides a mesh into what lies in any region, and the rest. Reliefs get about `cells` cells along the mesh's longer side.
///
/// # Errors
///
/// Fails for a mesh or cutter that is not closed, and if an operation fails.
pub(super) fn divided(
    mesh: &Mesh,
    fill: Fill,
    regions: &[RemovedRegion<'_>],
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

impl RemovedRegion<'_> {
    /// The part of a block that lies in the region; `None` if no part does.
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

/// A solid's faces that come from the part, then its caps by region and clip-surface.
fn half(solid: &ManifoldSolid, part: &[u32], caps: &[CapOf]) -> Result<Half, Undivided> {
    let (mesh, origins) = solid.mesh();
    if Edges::of(&mesh.triangles).count().open > 0 {
        return Err(Undivided::Failed {
            what: "the result is an open mesh".to_owned(),
        });
    }
    // Faces of the part come before all caps, which are sorted by region and clip-surface.
    let place = |origin: &FaceOrigin| {
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

/// The mesh turned inside out.
fn turned(mesh: &Mesh) -> Mesh {
    Mesh {
        positions: mesh.positions.clone(),
        triangles: (mesh.triangles.iter())
            .map(|[a, b, c]| [*a, *c, *b])
            .collect(),
        ..Mesh::default()
    }
}

/// Bounds enlarged by a margin on all sides.
fn around(bounds: &Bounds) -> Bounds {
    let room = bounds.radius() / 16.0;
    Bounds {
        min: bounds.min - room,
        max: bounds.max + room,
    }
}

/// A block.
fn block_mesh(bounds: &Bounds) -> Mesh {
    // Corners in the order of `Bounds::corners`; each face counter-clockwise, seen from outside.
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
