//! Faces of a part that lie in a flat clip-surface: decided here, once, for the reference, all strategies, sections and export.
//!
//! In CAD files, the vertices of a rotated or moved planar face are a few `f32` steps off its plane, and users type coordinates as they are
//! printed. So a face lies in a plane if all its vertices are within [`STEPS`] such steps of it, measured at the mesh's largest coordinate
//! in its file. The whole face then counts as in the plane: its triangles as on the solid's side, and its vertices as on the plane, for all
//! triangles that share these vertices. Coordinates are not moved.
//!
//! The face's orientation determines which side the solid is on; the side is reversed if the whole mesh is inside out. Slivers, whose
//! orientation is rounding error, belong to the face that they touch.
//!
//! If the solid between two faces is thinner than the tolerance, only triangles with all vertices exactly on the plane count as in the
//! plane; for the others, coordinates decide which face is nearer.
//!
//! Cost: a few hash lookups for each triangle within the tolerance.
//!
//! Cannot: include a face that is tilted against the plane by more than the tolerance; those triangles of a curved or tilted surface that
//! are within the tolerance count as one face.

use std::collections::{HashMap, HashSet};

use glam::{DAffine3, DVec3};

use crate::scene::{Bounds, FlatSurface, SceneSpace, Side, longest_edge};

/// Number of `f32` steps that a vertex of a face may be off a plane: a rotated face whose coordinates are off by 4 steps along each axis is
/// 7 steps off its plane.
const STEPS: f64 = 8.0;

/// Combined `f32` rounding error of a vertex and the plane in scene space, in scene units.
const SCENE_ROUNDING: f64 = f32::EPSILON as f64;

/// Triangles whose altitude is no more than this multiple of the tolerance are slivers.
const SLIVER: f64 = 4.0;

/// Two faces closer than this share of the tolerance touch; farther apart, there is solid between them.
const TOUCHING: f64 = 0.25;

/// Maximum distance from a plane, in scene units, at which a face's vertices count as on it. `in_part` bounds the mesh before placement.
pub(crate) fn plane_tolerance(in_part: &Bounds, placed: &DAffine3, space: &SceneSpace) -> f64 {
    let largest = in_part.min.abs().max(in_part.max.abs()).max_element() as f32;
    let step = f64::from(largest.next_up()) - f64::from(largest);
    let m = placed.matrix3;
    let stretch = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::length);
    let tolerance = STEPS * step * stretch.into_iter().fold(0.0, f64::max) * space.scale;
    if tolerance.is_finite() {
        tolerance + SCENE_ROUNDING
    } else {
        0.0
    }
}

/// Triangles that may lie in a plane, in scene space.
pub(crate) struct Candidates<'a, P> {
    /// Triangles of the whole mesh.
    pub(crate) triangles: &'a [[u32; 3]],
    /// Position of a vertex; for parts of a scene, from [`PreparedPart::positions`](crate::scene::PreparedPart::positions).
    pub(crate) position: P,
    /// The triangles to test; they must include every triangle whose three vertices are all within the tolerance.
    pub(crate) near: Vec<u32>,
    /// Maximum distance of vertices from the plane; if it is 0, only vertices exactly on the plane count.
    pub(crate) tolerance: f64,
    /// Returns true if the mesh encloses a negative volume; called only if a face is found.
    pub(crate) is_inside_out: &'a dyn Fn() -> bool,
}

/// The faces of a part that lie in a plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FacesInPlane {
    /// Triangles in index order, each with the side of the plane on which its solid lies.
    faces: Vec<(u32, Side)>,
    /// Bit patterns of the coordinates of the faces' vertices.
    places: HashSet<[u64; 3]>,
}

impl FacesInPlane {
    /// Returns true if there are no faces.
    pub(crate) fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// The triangles in order, each with its side.
    pub(crate) fn faces(&self) -> &[(u32, Side)] {
        &self.faces
    }

    /// The side that a triangle of a face lies on; `None` for other triangles.
    pub(crate) fn side(&self, triangle: u32) -> Option<Side> {
        let at = self.faces.binary_search_by_key(&triangle, |f| f.0).ok()?;
        Some(self.faces[at].1)
    }

    /// Returns true if a vertex belongs to a face, or coincides with one that does.
    pub(crate) fn holds(&self, position: DVec3) -> bool {
        !self.places.is_empty() && self.places.contains(&place_of(position))
    }
}

/// The bit patterns of the coordinates; -0 and 0 give the same bits.
fn place_of(position: DVec3) -> [u64; 3] {
    (position + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// A triangle within the tolerance.
struct Near {
    triangle: u32,
    places: [[u64; 3]; 3],
    /// True if it faces along the plane's normal, false if against it; `None` for a sliver.
    faces_up: Option<bool>,
    /// True if all vertices are exactly on the plane.
    is_exact: bool,
    bounds: Bounds,
    /// Mean height of its corners over the plane.
    height: f64,
}

impl FlatSurface {
    /// The faces that lie in this surface.
    pub(crate) fn faces_in<P: Fn(u32) -> DVec3>(&self, of: Candidates<'_, P>) -> FacesInPlane {
        let near: Vec<Near> = (of.near.iter())
            .filter_map(|t| {
                self.near(
                    *t,
                    of.triangles[*t as usize].map(&of.position),
                    of.tolerance,
                )
            })
            .collect();
        if near.is_empty() {
            return FacesInPlane::default();
        }
        let is_thin = thin(&near, of.tolerance);
        let mut facing: HashMap<[u64; 3], [bool; 2]> = HashMap::new();
        let mut faces: Vec<(u32, bool)> = Vec::new();
        let mut slivers: Vec<&Near> = Vec::new();
        for (one, is_thin) in near.iter().zip(is_thin) {
            match one.faces_up {
                Some(_) if is_thin && !one.is_exact => {}
                Some(up) => {
                    faces.push((one.triangle, up));
                    for place in one.places {
                        facing.entry(place).or_default()[usize::from(up)] = true;
                    }
                }
                None => slivers.push(one),
            }
        }
        // A sliver may touch the face only through another sliver.
        let mut left = slivers.len() + 1;
        while slivers.len() < left {
            left = slivers.len();
            slivers.retain(|sliver| {
                let touched = (sliver.places.iter().filter_map(|p| facing.get(p)))
                    .fold([false; 2], |[a, b], [c, d]| [a | c, b | d]);
                let [is_down, is_up] = touched;
                if is_down != is_up {
                    faces.push((sliver.triangle, is_up));
                    for place in sliver.places {
                        facing.entry(place).or_default()[usize::from(is_up)] = true;
                    }
                }
                is_down == is_up
            });
        }
        if faces.is_empty() {
            return FacesInPlane::default();
        }
        let is_inside_out = (of.is_inside_out)();
        let side = |is_up: bool| match is_up != is_inside_out {
            true => Side::Removed,
            false => Side::Kept,
        };
        let mut faces: Vec<(u32, Side)> = faces.into_iter().map(|(t, up)| (t, side(up))).collect();
        faces.sort_unstable();
        FacesInPlane {
            faces,
            places: facing.into_keys().collect(),
        }
    }

    fn near(&self, triangle: u32, points: [DVec3; 3], tolerance: f64) -> Option<Near> {
        let heights = points.map(|p| self.height(p));
        if heights.iter().any(|h| h.abs() > tolerance) {
            return None;
        }
        let [a, b, c] = points;
        let outward = (b - a).cross(c - a);
        let is_exact = heights.iter().all(|h| *h == 0.0);
        let altitude = outward.length() / longest_edge(points);
        let up = outward.dot(self.normal);
        let is_sliver = !is_exact && (altitude.is_nan() || altitude <= SLIVER * tolerance);
        let faces_up = (!is_sliver && up != 0.0).then_some(up > 0.0);
        Some(Near {
            triangle,
            places: points.map(place_of),
            faces_up,
            is_exact,
            bounds: Bounds::from_points(points),
            height: heights.iter().sum::<f64>() / 3.0,
        })
    }
}

/// Per triangle: true if the solid behind its face is thinner than the tolerance.
fn thin(near: &[Near], tolerance: f64) -> Vec<bool> {
    let apart = TOUCHING * tolerance;
    let of = |up: bool| near.iter().filter(move |n| n.faces_up == Some(up));
    let highest = of(true).map(|n| n.height).fold(f64::NEG_INFINITY, f64::max);
    let lowest = of(false).map(|n| n.height).fold(f64::INFINITY, f64::min);
    if lowest + apart >= highest {
        return vec![false; near.len()];
    }
    let region_of = regions(near);
    let mut extents: HashMap<u32, (Bounds, f64, u32)> = HashMap::new();
    for (one, region) in near.iter().zip(&region_of) {
        let extent = extents.entry(*region).or_insert((Bounds::EMPTY, 0.0, 0));
        extent.0 = extent.0.union(one.bounds);
        extent.1 += one.height;
        extent.2 += 1;
    }
    let all: Vec<(u32, Bounds, f64, bool)> = (extents.iter())
        .filter_map(|(region, (bounds, sum, count))| {
            let up = near[*region as usize].faces_up?;
            Some((*region, *bounds, sum / f64::from(*count), up))
        })
        .collect();
    let meet = |a: &Bounds, b: &Bounds| {
        let room = DVec3::splat(tolerance);
        (a.min - room).cmple(b.max).all() && (b.min - room).cmple(a.max).all()
    };
    let mut thin: HashSet<u32> = HashSet::new();
    for (top, above, height, _) in all.iter().filter(|r| r.3) {
        for (bottom, below, depth, _) in all.iter().filter(|r| !r.3) {
            if depth + apart < *height && meet(above, below) {
                thin.extend([*top, *bottom]);
            }
        }
    }
    region_of.iter().map(|r| thin.contains(r)).collect()
}

/// Per triangle, the index of the first triangle of its face. A face's triangles face the same way and are connected by shared positions.
fn regions(near: &[Near]) -> Vec<u32> {
    let mut first: Vec<u32> = (0..near.len() as u32).collect();
    fn root(first: &mut [u32], mut at: u32) -> u32 {
        while first[at as usize] != at {
            first[at as usize] = first[first[at as usize] as usize];
            at = first[at as usize];
        }
        at
    }
    let mut at_place: HashMap<([u64; 3], bool), u32> = HashMap::new();
    for (number, one) in (0..).zip(near) {
        let Some(up) = one.faces_up else { continue };
        for place in one.places {
            let other = *at_place.entry((place, up)).or_insert(number);
            let (a, b) = (root(&mut first, other), root(&mut first, number));
            first[a.max(b) as usize] = a.min(b);
        }
    }
    (0..near.len() as u32)
        .map(|n| root(&mut first, n))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1e-7;

    fn faces(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> FacesInPlane {
        let surface = FlatSurface {
            origin: DVec3::ZERO,
            normal: DVec3::Z,
            lift: 0.0,
        };
        surface.faces_in(Candidates {
            triangles,
            position: |i| DVec3::from_array(points[i as usize]),
            near: (0..triangles.len() as u32).collect(),
            tolerance: STEPS * STEP,
            is_inside_out: &|| false,
        })
    }

    #[test]
    fn a_face_that_straddles_the_plane_is_in_it_with_its_slivers() {
        // Two triangles, one above and one below, and a sliver along an edge, flipped by rounding.
        let points = [
            [0.0, 0.0, STEP],
            [1.0, 0.0, -STEP],
            [1.0, 1.0, 3.0 * STEP],
            [0.0, 1.0, -4.0 * STEP],
            [0.5, -STEP, 0.0],
            [0.5, 0.5, 9.0 * STEP],
        ];
        let square = [[0, 1, 2], [0, 2, 3]];
        let found = faces(&points, &[square[0], square[1], [0, 1, 4]]);
        let below = Side::Removed;
        assert_eq!(found.faces(), [(0, below), (1, below), (2, below)]);
        assert!(found.holds(DVec3::new(0.0, 1.0, -4.0 * STEP)));
        assert!(!found.holds(DVec3::new(0.5, 0.5, 9.0 * STEP)));
        assert_eq!(found.side(1), Some(below));
        // A vertex nine steps off excludes its triangle; the sliver alone is not a face.
        assert_eq!(
            faces(&points, &[[0, 1, 5], [0, 1, 4]]),
            FacesInPlane::default()
        );
    }

    #[test]
    fn solid_between_two_faces_keeps_them_apart() {
        let square = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
        let both = |top: f64, bottom: f64| {
            let points = [square(top), square(bottom)].concat();
            faces(&points, &[[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]])
                .faces()
                .to_vec()
        };
        assert!(
            both(2.0 * STEP, -2.0 * STEP).is_empty(),
            "a slab of four steps"
        );
        let [removed, kept] = [Side::Removed, Side::Kept];
        let touching = [(0, removed), (1, removed), (2, kept), (3, kept)];
        assert_eq!(both(0.0, STEP), touching, "two solids");
        assert_eq!(both(STEP, 0.0), touching, "the same, as rounding has it");
    }

    #[test]
    fn the_tolerance_is_in_steps_of_the_largest_coordinate() {
        let space = SceneSpace::ITSELF;
        let at = |far: f64| {
            let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::new(0.0, far, 0.0)]);
            plane_tolerance(&bounds, &DAffine3::from_scale(DVec3::splat(2.0)), &space)
        };
        let steps = |t: f64| t - SCENE_ROUNDING;
        assert!((steps(at(1.5)) - 16.0 * f64::from(f32::EPSILON)).abs() < 1e-12);
        assert!((steps(at(5000.0)) / steps(at(1.5)) - 4096.0).abs() < 1e-6);
        assert_eq!(at(f64::INFINITY), 0.0);
    }
}
