//! Outline of the kept geometry that a camera is fitted to: the corners of its convex hull, at one time or over several times.
//!
//! The extent of an object in a picture, from any viewpoint, depends on its convex hull alone. The hull of a part's kept geometry has its
//! corners at kept vertices, at crossings of edges with clip-surfaces, at points of triangles where planes of two cuts meet, and at points
//! inside the solid where planes of three cuts meet. Crossings with planes are exact. Crossings with a relief are found by following the
//! edge in steps, then by bisection; the relief's heights between edges are sampled on a grid, and where three cuts meet inside a solid,
//! reliefs count as planes. A cutter that removes its inside is ignored, and one that keeps its inside is replaced by its box; the outline
//! is then too large. Where a section is hollow, it is also too large, by less than a relief's height.
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
        // If removed geometry is drawn, hidden parts are visible too.
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

    /// The corners, in no particular order.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
}
