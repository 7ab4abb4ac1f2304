//! Outline of the kept geometry that a camera is fitted to: the corners of its convex hull, over one time or many.
//!
//! The extent of an object in a picture, from any viewpoint, depends on its convex hull alone. The hull of the kept part of a part has
//! its corners at vertices that are kept, where edges cross clip-surfaces, where two planes of different cuts meet in a triangle, and
//! where three meet inside the solid. Planes are met exactly. Along a relief edges are followed in steps and the crossing is found by
//! bisection; what rises between them is looked up at points of a grid, and where three meet inside a solid they count as planes.
//! A cutter is ignored, and one that keeps its inside is replaced by its box: the outline is then too
//! large, as it also is, by less than the height of a relief, where a section is hollow.
//!
//! Cost: one pass over the vertices and triangles of each part that is cut, one over the vertices of the rest, and the hull.

mod gather;
mod region;
mod rim;

use glam::DVec3;
use rayon::prelude::*;

use crate::scene::geometry::hull::hull_corners;
use crate::scene::{Part, Scene, is_removed_whole};
use region::Regions;

/// Corners of the convex hull of the kept geometry, in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    points: Vec<DVec3>,
}

impl Outline {
    /// The outline of a scene as it stands. It is empty if nothing is kept.
    pub fn of(scene: &Scene) -> Self {
        let mut outline = Self::default();
        outline.add(scene);
        outline
    }

    /// Adds the kept geometry of a scene at another time.
    pub fn add(&mut self, scene: &Scene) {
        self.add_parts(scene, scene.parts.iter());
    }

    /// Adds the kept geometry of some parts of a scene.
    #[doc(hidden)]
    pub fn add_parts<'a>(&mut self, scene: &Scene, parts: impl Iterator<Item = &'a Part>) {
        // A ghost shows hidden parts.
        let world = scene.bounds();
        let is_seen =
            |part: &&Part| scene.style.ghost.is_drawn() || !is_removed_whole(scene, &world, part);
        let parts: Vec<&Part> = parts.filter(is_seen).collect();
        let kept = parts.par_iter().flat_map_iter(|part| {
            let regions = Regions::of(scene, part);
            hull_corners(&gather::kept_of(part, &regions))
        });
        let mut points: Vec<DVec3> = kept.collect();
        if !points.is_empty() {
            points.append(&mut self.points);
            self.points = hull_corners(&points);
        }
    }

    /// Returns true if nothing is kept.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// The corners, in no order.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
}
