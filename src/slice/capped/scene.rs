//! The parts of a scene with their caps, placed in the world in their poses.

use rayon::prelude::*;

use super::in_scene::InScene;
use super::{Half, Halves, halves_in};
use crate::scene::{Cut, Mesh, Part, Scene, SceneSpace, is_removed_whole};
use crate::slice::SlicePlane;
#[cfg(feature = "boolean")]
use crate::slice::boolean::{self, RemovedRegion};
use crate::slice::in_world::in_world;
use crate::{Error, Result};

/// Result of a scene's cuts for one part.
#[derive(Clone, Debug, Default)]
pub struct CappedPart {
    /// Index of the part in the scene.
    pub part: usize,
    /// Indices of the cuts that apply to the part, in the order of the regions of its caps.
    pub cuts: Vec<usize>,
    /// Kept and removed half, in world space.
    pub halves: Halves,
    /// Largest distance along `N` between caps and the reliefs that they follow, in world units, measured at the middles of cells.
    pub relief_off: f64,
}

/// Default number of relief cells along the longer side of a part.
pub const RELIEF_CELLS: u32 = 256;

/// Divides each part of a scene by its cuts into kept and removed meshes with caps, in world space. Each part is a separate solid,
/// even if parts overlap; a part that is never cut stays whole.
///
/// ```
/// use cutaway::generate::shapes::shape;
/// use cutaway::slice::capped;
/// use cutaway::{ClipSurface, Cut, Scene};
/// use glam::DVec3;
///
/// let mut scene = Scene { parts: shape("gears")?, ..Scene::default() };
/// scene.cuts.push(Cut::new("x", vec![ClipSurface::plane(DVec3::ZERO, DVec3::X)]));
/// for part in capped(&scene)? {
///     let kept = &part.halves.kept;
///     println!("{}: {:.3} are left", scene.parts[part.part].name, kept.mesh.volume());
///     assert!(kept.mesh.open_edges().is_empty());
/// }
/// # Ok::<(), cutaway::Error>(())
/// ```
///
/// # Errors
///
/// Those of [`capped_with`].
pub fn capped(scene: &Scene) -> Result<Vec<CappedPart>> {
    capped_with(scene, RELIEF_CELLS)
}

/// [`capped`], with reliefs sampled in about `relief_cells` cells along the longer side of a part as seen along `N`.
///
/// # Errors
///
/// Names a part that is open and cut by a relief or a cutter; without the feature `boolean`, a cut with either.
pub fn capped_with(scene: &Scene, relief_cells: u32) -> Result<Vec<CappedPart>> {
    let world = scene.bounds();
    let space = SceneSpace::new(&world);
    let capped = |(index, part): (usize, &Part)| {
        let mesh = in_world(&part.posed_mesh(), &part.world_from_part);
        let cuts: Vec<usize> = (0..scene.cuts.len())
            .filter(|c| scene.cuts[*c].applies_to(part))
            .collect();
        let applied = cuts.iter().map(|c| &scene.cuts[*c]);
        let planes: Option<Vec<Vec<SlicePlane>>> =
            applied.clone().map(|cut| planes_of(cut, part)).collect();
        let (halves, relief_off) = match (is_removed_whole(scene, &world, part), planes) {
            (true, _) => {
                let removed = Half {
                    sources: (0..mesh.triangles.len() as u32).collect(),
                    mesh,
                    caps: Vec::new(),
                };
                let halves = Halves {
                    removed,
                    ..Halves::default()
                };
                (halves, 0.0)
            }
            (false, Some(planes)) => {
                let decided = InScene::of(part, &space);
                (halves_in(&mesh, &planes, Some(&decided)), 0.0)
            }
            (false, None) => divided(part, &mesh, applied, relief_cells)?,
        };
        Ok(CappedPart {
            part: index,
            cuts,
            halves,
            relief_off,
        })
    };
    scene.parts.par_iter().enumerate().map(capped).collect()
}

/// The planes of a cut for a part; `None` if the cut has a surface that is not a plane.
#[doc(hidden)]
pub fn planes_of(cut: &Cut, part: &Part) -> Option<Vec<SlicePlane>> {
    let keeps = cut.offset_for(part);
    let planes = cut.surfaces.iter().map(SlicePlane::of_flat);
    let planes: Option<Vec<SlicePlane>> = planes.map(|p| Some(p?.keeping(keeps))).collect();
    planes.filter(|_| cut.volume.is_none())
}

/// Result of any kind of cut for a part, and the distance of its caps from their reliefs.
#[cfg(feature = "boolean")]
fn divided<'a>(
    part: &Part,
    mesh: &Mesh,
    cuts: impl Iterator<Item = &'a Cut>,
    relief_cells: u32,
) -> Result<(Halves, f64)> {
    let region = |cut: &'a Cut| {
        let keeps = cut.offset_for(part);
        RemovedRegion {
            surfaces: cut.surfaces.iter().map(|s| s.keeping(keeps)).collect(),
            cutter: cut.volume.as_ref(),
        }
    };
    let regions: Vec<RemovedRegion<'_>> = cuts.map(region).collect();
    let divided = boolean::divided(mesh, part.fill, &regions, relief_cells).map_err(|why| {
        let what = format!("it cannot be cut by a relief or by a mesh: {why}");
        Error::input(format!("part `{}`", part.name), what, why.help())
    })?;
    Ok((divided.halves, divided.off))
}

#[cfg(not(feature = "boolean"))]
fn divided<'a>(
    part: &Part,
    _: &Mesh,
    mut cuts: impl Iterator<Item = &'a Cut>,
    _: u32,
) -> Result<(Halves, f64)> {
    let name = cuts.find(|cut| planes_of(cut, part).is_none());
    Err(Error::input(
        format!("cut `{}`", name.map_or("", |cut| &cut.name)),
        "it has a relief or a mesh that cuts, and meshes are cut by planes only",
        "build the library with its feature `boolean`",
    ))
}
