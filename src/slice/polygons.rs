//! The region of a section as polygons with holes, in the form that geometry libraries expect.
//!
//! A polygon is an edge-connected component of the region's triangles. Its rings are walked along its boundary with the region on the left.
//! At each corner the walk turns around the triangles there, so that it never leaves its component, even if components touch in a point. A
//! walk that returns to a point before its end is divided there, so that no ring touches itself; rings may touch one another in single
//! points, which the simple features of OGC allow.
//!
//! Cost: linear in the triangles.

use std::collections::{HashMap, HashSet};

use super::Section;

/// A connected component of a section's region, as indices of the section's points. A ring's first point is not repeated at its end.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polygon {
    /// The outer ring, counter-clockwise.
    pub outer: Vec<u32>,
    /// The rings of its holes, clockwise.
    pub holes: Vec<Vec<u32>>,
}

impl Section {
    /// The region as polygons, in the order of its triangles. The polygons' areas minus those of their holes add up to [`Section::area`].
    ///
    /// ```
    /// use cutaway::generate::shapes::shape;
    /// use cutaway::slice::{SlicePlane, Slicer};
    /// use cutaway::scene::ClipSurface;
    /// use glam::DVec3;
    ///
    /// let torus = &shape("torus")?[0];
    /// let plane = SlicePlane::from(&ClipSurface::plane(DVec3::ZERO, DVec3::Y));
    /// let polygons = Slicer::of_part(torus).section(&plane).polygons();
    /// assert_eq!(polygons.len(), 1, "an annulus");
    /// assert_eq!(polygons[0].holes.len(), 1);
    /// # Ok::<(), cutaway::Error>(())
    /// ```
    pub fn polygons(&self) -> Vec<Polygon> {
        let mesh = Adjacency::of(&self.triangles);
        let mut walked: HashSet<[u32; 2]> = HashSet::new();
        let mut rings_of: Vec<Vec<Vec<u32>>> = vec![Vec::new(); mesh.pieces];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            for edge in edges(*corners) {
                let is_inner = mesh.has_across(edge);
                if is_inner || walked.contains(&edge) {
                    continue;
                }
                let walk = mesh.walk(edge, &mut walked);
                divide(&walk, &mut rings_of[mesh.piece_of[triangle]]);
            }
        }
        rings_of
            .into_iter()
            .map(|rings| self.polygon(rings))
            .collect()
    }

    /// The polygon formed by rings: all but one of them bound holes.
    fn polygon(&self, mut rings: Vec<Vec<u32>>) -> Polygon {
        let area = |ring: &Vec<u32>| self.ring_area(ring);
        let areas: Vec<f64> = rings.iter().map(area).collect();
        let largest = (0..areas.len()).max_by(|a, b| areas[*a].total_cmp(&areas[*b]));
        Polygon {
            outer: largest.map(|at| rings.remove(at)).unwrap_or_default(),
            holes: rings,
        }
    }
}

/// The edges of a triangle, in order.
fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Map from directed edges to their triangles, and the components that triangles form through shared edges.
struct Adjacency {
    /// The corner opposite each directed edge, and the triangle.
    opposite: HashMap<[u32; 2], (u32, usize)>,
    piece_of: Vec<usize>,
    pieces: usize,
}

impl Adjacency {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let mut opposite = HashMap::with_capacity(3 * triangles.len());
        for (number, [a, b, c]) in triangles.iter().copied().enumerate() {
            for (edge, corner) in edges([a, b, c]).into_iter().zip([c, a, b]) {
                opposite.insert(edge, (corner, number));
            }
        }
        let mut piece_of = vec![usize::MAX; triangles.len()];
        let mut pieces = 0;
        for first in 0..triangles.len() {
            if piece_of[first] != usize::MAX {
                continue;
            }
            let mut ahead = vec![first];
            while let Some(triangle) = ahead.pop() {
                if piece_of[triangle] != usize::MAX {
                    continue;
                }
                piece_of[triangle] = pieces;
                let across = edges(triangles[triangle]).map(|[a, b]| opposite.get(&[b, a]));
                ahead.extend(across.into_iter().flatten().map(|(_, triangle)| *triangle));
            }
            pieces += 1;
        }
        Self {
            opposite,
            piece_of,
            pieces,
        }
    }

    fn has_across(&self, [a, b]: [u32; 2]) -> bool {
        self.opposite.contains_key(&[b, a])
    }

    /// The points of the boundary from one edge until the walk returns to that edge.
    fn walk(&self, first: [u32; 2], walked: &mut HashSet<[u32; 2]>) -> Vec<u32> {
        let mut points = Vec::new();
        let mut edge = first;
        while walked.insert(edge) {
            points.push(edge[0]);
            edge = self.after(edge);
        }
        points
    }

    /// The boundary edge that follows one, found by turning around the triangles at its end.
    fn after(&self, edge: [u32; 2]) -> [u32; 2] {
        let mut inner = edge;
        loop {
            let at = inner[1];
            let Some((corner, _)) = self.opposite.get(&inner) else {
                return inner;
            };
            let next = [at, *corner];
            if !self.has_across(next) {
                return next;
            }
            inner = [*corner, at];
        }
    }
}

/// Divides a closed walk into rings that contain no point twice.
fn divide(walk: &[u32], rings: &mut Vec<Vec<u32>>) {
    let mut open: Vec<u32> = Vec::new();
    let mut place_of: HashMap<u32, usize> = HashMap::new();
    for point in walk {
        if let Some(from) = place_of.get(point).copied() {
            let ring: Vec<u32> = open.drain(from..).collect();
            for of_ring in &ring {
                place_of.remove(of_ring);
            }
            rings.push(ring);
        }
        place_of.insert(*point, open.len());
        open.push(*point);
    }
    rings.push(open);
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    /// Squares of a grid of points 4 x 4 as a section: two triangles each.
    fn of_squares(squares: &[[u32; 2]]) -> Section {
        let number = |x: u32, y: u32| y * 4 + x;
        Section {
            points: (0..16_u32)
                .map(|i| DVec2::new(f64::from(i % 4), f64::from(i / 4)))
                .collect(),
            triangles: (squares.iter())
                .flat_map(|[x, y]| {
                    let [a, b] = [number(*x, *y), number(x + 1, *y)];
                    let [c, d] = [number(x + 1, y + 1), number(*x, y + 1)];
                    [[a, b, c], [a, c, d]]
                })
                .collect(),
            ..Section::default()
        }
    }

    /// Areas of the outer rings and of the holes.
    fn areas(section: &Section) -> Vec<(f64, Vec<f64>)> {
        let area = |ring: &Vec<u32>| section.ring_area(ring);
        let of = |p: &Polygon| (area(&p.outer), p.holes.iter().map(area).collect());
        section.polygons().iter().map(of).collect()
    }

    #[test]
    fn a_hole_belongs_to_the_ring_around_it() {
        let ring = [
            [0, 0],
            [1, 0],
            [2, 0],
            [0, 1],
            [2, 1],
            [0, 2],
            [1, 2],
            [2, 2],
        ];
        assert_eq!(areas(&of_squares(&ring)), [(9.0, vec![-1.0])]);
    }

    #[test]
    fn pieces_that_touch_in_a_point_are_two_polygons() {
        let section = of_squares(&[[0, 0], [1, 1]]);
        assert_eq!(areas(&section), [(1.0, vec![]), (1.0, vec![])]);
    }

    #[test]
    fn a_ring_that_meets_itself_is_divided_into_an_outline_and_a_hole() {
        // A square is missing at a corner of the hole: outside and hole touch in a point.
        let pinched = [[1, 0], [2, 0], [0, 1], [2, 1], [0, 2], [1, 2], [2, 2]];
        let section = of_squares(&pinched);
        let polygons = section.polygons();
        assert_eq!(areas(&section), [(8.0, vec![-1.0])]);
        for ring in std::iter::once(&polygons[0].outer).chain(&polygons[0].holes) {
            let different: HashSet<&u32> = ring.iter().collect();
            assert_eq!(different.len(), ring.len(), "{ring:?} has a point twice");
        }
    }

    #[test]
    fn nothing_has_no_polygons() {
        assert!(Section::default().polygons().is_empty());
    }
}
