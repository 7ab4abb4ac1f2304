//! Collapses edges that division left too short to be distinguished from points.
//!
//! A plane that misses a vertex by a rounding error crosses the vertex's edges extremely close to it, and leaves triangles without area.
//! Programs that read the halves merge such vertices, each in its own way, and find the mesh open. So of a short edge, the end that
//! division made is moved to the other end. That end stays where it is, unless an axis-aligned plane moves it onto the plane, by less than
//! the edge's length. Original mesh vertices are never merged with each other.
//!
//! Cost: a pass over all faces, and a sort of the short edges.

use super::complex::{Complex, FaceState};
use crate::scene::Bounds;
use crate::scene::meshes::weld::has_three;

/// Edges shorter than this share of the mesh's diagonal count as points: half of what f32 can resolve at that size.
const SHORT: f64 = 1.0 / 33_554_432.0;

/// Number of passes over short edges: an edge remains after a pass if other edges were merged into both its ends.
const PASSES: usize = 4;

impl Complex<'_> {
    /// Collapses short edges that were not in the mesh.
    pub(super) fn collapse(&mut self) {
        for _ in 0..PASSES {
            if !self.collapse_once() {
                break;
            }
        }
    }

    fn collapse_once(&mut self) -> bool {
        let of_mesh = self.mesh.positions.len() as u32;
        let used = self.faces.iter().flat_map(|f| f.corners);
        let used = used.map(|i| self.positions[i as usize]);
        let short = SHORT * Bounds::from_points(used).size().length();
        // Edges to mesh vertices come first.
        let mut edges: Vec<(bool, f64, u32, u32)> = Vec::new();
        for [a, b, c] in self.faces.iter().map(|f| f.corners) {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let [into, new] = [from.min(to), from.max(to)];
                let length = || self.positions[from as usize].distance(self.positions[to as usize]);
                if new >= of_mesh && length() < short {
                    edges.push((into >= of_mesh, length(), new, into));
                }
            }
        }
        if edges.is_empty() {
            return false;
        }
        edges.sort_unstable_by(|a, b| {
            let by_length = a.1.total_cmp(&b.1);
            (a.0.cmp(&b.0))
                .then(by_length)
                .then((a.2, a.3).cmp(&(b.2, b.3)))
        });
        let mut to: Vec<u32> = (0..self.positions.len() as u32).collect();
        let mut is_goal = vec![false; to.len()];
        for (.., new, into) in edges {
            let [new, into] = [new as usize, into as usize];
            // No vertex moves farther than along one edge.
            if to[new] as usize == new && to[into] as usize == into && !is_goal[new] {
                to[new] = into as u32;
                is_goal[into] = true;
                self.marks[into] |= self.marks[new];
                for plane in self.planes.iter().filter(|p| self.marks[new] & p.mark != 0) {
                    self.positions[into] = plane.plane.preclassified(self.positions[into]);
                }
            }
        }
        for face in &mut self.faces {
            face.corners = face.corners.map(|i| to[i as usize]);
        }
        self.faces.retain(|f| has_three(&f.corners));
        self.cancel();
        true
    }

    /// Removes faces that lie back to back in the same half.
    fn cancel(&mut self) {
        let key = |corners: [u32; 3]| {
            let mut sorted = corners;
            sorted.sort_unstable();
            let first = corners.iter().position(|i| *i == sorted[0]).unwrap_or(0);
            (sorted, corners[(first + 1) % 3] == sorted[1])
        };
        let mut order: Vec<usize> = (0..self.faces.len())
            .filter(|f| self.faces[*f].plane().is_none())
            .collect();
        let of = |f: &usize| {
            let face = &self.faces[*f];
            let (corners, is_up) = key(face.corners);
            (corners, face.state == FaceState::Removed, is_up)
        };
        order.sort_by_cached_key(of);
        let mut is_gone = vec![false; self.faces.len()];
        for run in order.chunk_by(|a, b| (of(a).0, of(a).1) == (of(b).0, of(b).1)) {
            let down = run.iter().take_while(|f| !of(f).2).count();
            for k in 0..down.min(run.len() - down) {
                is_gone[run[k]] = true;
                is_gone[run[run.len() - 1 - k]] = true;
            }
        }
        let mut gone = is_gone.into_iter();
        self.faces.retain(|_| gone.next() != Some(true));
    }
}
