//! Prepared cuts of a scene: each cut once, and once more for each offset that parts have from it.
//!
//! A part with an offset from a cut gets its own copy of the cut, moved in world space before rounding; parts with equal offsets share a
//! copy. Copies come after all cuts of the scene, so that the scene's cuts keep their numbers. Later stages do not deal with offsets, and
//! unused offsets cost nothing there.

use std::sync::Arc;

use super::{PreparedCut, PreparedSurface, PreparedVolume, SceneSpace};
use crate::scene::{Cutter, Part, Scene};

/// Table of cuts: index in the scene, and offset.
pub(super) struct CutTable(Vec<(usize, f64)>);

impl CutTable {
    /// The cuts of the scene, then their copies with offsets.
    pub(super) fn of(scene: &Scene) -> Self {
        let mut table: Vec<(usize, f64)> = (0..scene.cuts.len()).map(|cut| (cut, 0.0)).collect();
        for (index, cut) in scene.cuts.iter().enumerate() {
            if cut.offsets.is_empty() {
                continue;
            }
            for part in scene.parts.iter().filter(|p| cut.applies_to(p)) {
                let entry = (index, cut.offset_for(part));
                if !table.contains(&entry) {
                    table.push(entry);
                }
            }
        }
        Self(table)
    }

    /// Indices of the cuts that apply to a part.
    pub(super) fn cuts_of(&self, scene: &Scene, part: &Part) -> Vec<usize> {
        let cuts = scene.cuts.iter().enumerate();
        cuts.filter(|(_, cut)| cut.applies_to(part))
            .filter_map(|(index, cut)| {
                let entry = (index, cut.offset_for(part));
                self.0.iter().position(|e| *e == entry)
            })
            .collect()
    }

    /// The cuts and their clip-surfaces in scene space; a cutter follows the other clip-surfaces of its cut and is not moved by offsets.
    pub(super) fn placed(
        &self,
        scene: &Scene,
        space: &SceneSpace,
        place_volume: impl Fn(&Cutter, &SceneSpace, usize) -> Arc<PreparedVolume>,
    ) -> (Vec<PreparedCut>, Vec<PreparedSurface>) {
        let mut surfaces: Vec<PreparedSurface> = Vec::new();
        let cuts = self.0.iter().enumerate().map(|(number, (of, keeps))| {
            let cut = &scene.cuts[*of];
            let first = surfaces.len();
            surfaces.extend(cut.surfaces.iter().map(|surface| {
                let moved = surface.keeping(*keeps);
                let surface = if *keeps == 0.0 { surface } else { &moved };
                let origin = space.point(surface.origin);
                PreparedSurface::place(surface, origin, space.scale, number)
            }));
            if let Some(cutter) = &cut.volume {
                let volume = place_volume(cutter, space, surfaces.len());
                surfaces.push(PreparedSurface::of_volume(volume, number));
            }
            PreparedCut {
                name: cut.name.clone(),
                of: *of,
                keeps: *keeps,
                surfaces: (first..surfaces.len()).collect(),
            }
        });
        (cuts.collect(), surfaces)
    }
}
