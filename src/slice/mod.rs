//! The section of a mesh by a plane: closed loops by connectivity, the region they enclose, and its triangles; and the parts into which
//! planes divide a mesh, closed by such sections.
//!
//! # Tie rule
//!
//! A vertex is *above* (on the kept side) iff `(P - O).N > 0`: the sign of the exact real number that these f64s define, with
//! nothing rounded. A vertex on the plane counts as below. A triangle is crossed iff it has vertices on both sides, and then
//! in exactly two of its edges; so faces, edges and vertices that lie in the plane need no separate rule. The result
//! is the section by the plane moved along its normal by an arbitrarily small distance: a face in the plane is in the section iff
//! the solid lies above it, so that a plane through a face of the removed solid has no section.
//!
//! # How
//!
//! 1. A tree of boxes over the triangles ([`Slicer`]), built once, finds the triangles near the plane.
//! 2. Each crossed mesh edge gives one point, computed once, from the lesser end by coordinates: meshes that repeat vertices agree to the
//!    last bit. Each crossed triangle joins two points; seen from the kept side, the solid is on the left.
//! 3. Pieces are joined where they share a mesh edge; an edge of more than two triangles pairs them so that loops do not cross there.
//!    Pieces are never joined for being close, but open ends at equal points are joined.
//! 4. A constrained Delaunay triangulation of the loops is flooded from outside, counting how often each edge is passed.
//!    Loops that cross are cut where they do; only then edges move, by some 1e-14 of the section's size.
//!
//! [`halves`] divides a mesh by planes into two that are closed by such caps, and [`capped`] all parts of a scene. [`close_holes`] finds
//! triangles that close an open mesh.
//!
//! Cost: one parallel sort of the triangles; then, per section, about n log n in the points of the elements that the plane meets.
//!
//! Limits: 2^32 vertices and triangles; coordinates up to 1e300, beyond which triangles are left out and reported. Open curves
//! are not capped, but reported, unless winding numbers are to close them ([`Slicer::section_by_winding`]). Points are rounded to f64,
//! so loops that touch within rounding may cross by as much.

#[cfg(feature = "boolean")]
mod boolean;
mod by_winding;
mod capped;
mod cover;
mod fill;
mod half_plane;
mod holes;
mod in_world;
mod loops;
mod outline;
mod plane;
mod polygons;
mod section;
mod slicer;
mod trim;

#[cfg(feature = "boolean")]
#[doc(hidden)]
pub use boolean::is_at_work;
#[doc(hidden)]
pub use capped::planes_of;
pub use capped::{Cap, CappedPart, Half, Halves, RELIEF_CELLS, capped, capped_with, halves};
pub use half_plane::HalfPlane;
#[doc(hidden)]
pub use holes::close_holes_of;
pub use holes::{Closing, Hole, HoleDefect, close_holes};
pub use plane::SlicePlane;
pub use polygons::Polygon;
pub use section::{Loop, Section, SectionDefect};
pub use slicer::Slicer;
pub use trim::Trim;
