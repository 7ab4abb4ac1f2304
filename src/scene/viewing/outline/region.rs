//! The removed region of one part: the cuts that apply to it, each as the sides whose intersection it removes.

use glam::DVec3;

use crate::scene::{Bounds, ClipSurface, Part, Scene};

/// One removed side, described by heights that are negative on that side.
pub(super) enum RemovedSide {
    /// A plane, or a plane with a relief.
    Surface {
        surface: ClipSurface,
        normal: DVec3,
        /// Least and greatest height that the relief adds.
        slab: [f64; 2],
    },
    /// All that is outside of a box.
    Outside(Bounds),
}

/// The removed sides of all cuts of a part.
pub(super) struct Regions {
    /// All sides, grouped by cut.
    pub(super) sides: Vec<RemovedSide>,
    /// Per cut: the index of its first side, and one more than that of its last side.
    pub(super) cuts: Vec<[usize; 2]>,
}

impl RemovedSide {
    fn of(surface: &ClipSurface) -> Self {
        let slab = surface.relief.as_ref().map_or([0.0; 2], |map| {
            let [low, high] = map.range().map(|h| f64::from(h) * surface.scale.z);
            [low.min(high), low.max(high)]
        });
        Self::Surface {
            normal: surface.frame().normal,
            surface: surface.clone(),
            slab,
        }
    }

    /// Lower and upper bound of a point's height, without evaluating the relief.
    pub(super) fn bracket(&self, point: DVec3) -> [f64; 2] {
        match self {
            Self::Surface {
                surface,
                normal,
                slab,
            } => slab.map(|h| (point - surface.origin).dot(*normal) + h),
            Self::Outside(bounds) => {
                let inside = (point - bounds.min).min(bounds.max - point);
                [inside.min_element(); 2]
            }
        }
    }

    /// The height of a point.
    pub(super) fn height(&self, point: DVec3) -> f64 {
        match self {
            Self::Surface { surface, .. } if self.is_rough() => surface.kept_height(point),
            _ => self.bracket(point)[0],
        }
    }

    /// Returns true if heights must be evaluated at each point, since they are not linear along lines.
    pub(super) fn is_rough(&self) -> bool {
        match self {
            Self::Surface { surface, .. } => surface.relief.is_some(),
            Self::Outside(_) => true,
        }
    }

    /// The least height that the relief adds.
    pub(super) fn least_relief(&self) -> f64 {
        match self {
            Self::Surface { slab, .. } => slab[0],
            Self::Outside(_) => 0.0,
        }
    }

    /// The mean of the least and the greatest height that the relief adds.
    pub(super) fn middle_relief(&self) -> f64 {
        match self {
            Self::Surface { slab, .. } => (slab[0] + slab[1]) / 2.0,
            Self::Outside(_) => 0.0,
        }
    }

    /// The height that the relief adds at a point.
    pub(super) fn relief_at(&self, point: DVec3) -> f64 {
        match self {
            Self::Surface { .. } => {
                self.height(point) - self.bracket(point)[0] + self.least_relief()
            }
            Self::Outside(_) => 0.0,
        }
    }

    /// The plane in the middle of the relief, as a point and the normal; `None` for a box.
    pub(super) fn plane(&self) -> Option<(DVec3, DVec3)> {
        match self {
            Self::Surface {
                surface, normal, ..
            } => Some((surface.origin - *normal * self.middle_relief(), *normal)),
            Self::Outside(_) => None,
        }
    }
}

impl Regions {
    /// The regions of a part. A cut is ignored if its cutter removes its inside.
    pub(super) fn of(scene: &Scene, part: &Part) -> Self {
        let mut regions = Self {
            sides: Vec::new(),
            cuts: Vec::new(),
        };
        // If removed geometry is drawn, nothing counts as removed.
        if scene.style.ghost.is_drawn() {
            return regions;
        }
        for cut in scene.cuts.iter().filter(|cut| cut.applies_to(part)) {
            if cut.volume.as_ref().is_some_and(|v| !v.keeps_inside) {
                continue;
            }
            let first = regions.sides.len();
            let keeps = cut.offset_for(part);
            let surfaces = cut
                .surfaces
                .iter()
                .map(|s| RemovedSide::of(&s.keeping(keeps)));
            let cutter = cut
                .volume
                .as_ref()
                .map(|v| RemovedSide::Outside(v.bounds_in_world()));
            regions.sides.extend(surfaces.chain(cutter));
            regions.cuts.push([first, regions.sides.len()]);
        }
        regions
    }

    /// Returns true if no cut removes a point; `is_over` returns true if the point is over a side.
    pub(super) fn keep(&self, is_over: impl Fn(usize) -> bool) -> bool {
        (self.cuts.iter()).all(|[first, end]| (*first..*end).any(&is_over))
    }

    /// Returns true if a point is kept and is not on the border of the kept region.
    pub(super) fn keep_point(&self, point: DVec3, least: f64) -> bool {
        self.keep(|side| self.sides[side].height(point) > least)
    }

    /// Cut that a side belongs to.
    pub(super) fn cut_of(&self, side: usize) -> Option<usize> {
        (self.cuts.iter()).position(|[first, end]| (*first..*end).contains(&side))
    }
}
