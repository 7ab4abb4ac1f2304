//! Triangulation of the region that closed curves bound in a plane, covering each point as often as the curves wind around it.
//!
//! [`super::fill`] finds where a region is; this module finds a surface that closes a mesh: triangles whose directed edges add
//! up to exactly the given ones. If an edge must pass through points other than its ends, because loops cross or because one
//! runs through a point of another, these points are reported, so that the faces on the edge's other side can be divided in the same way.
//! Coincident points are reported as well.
//!
//! Cost: that of filling, and a sort of the edges.

use glam::DVec2;
use spade::Triangulation;

use super::fill::{preclassified, windings};
use super::outline::{ConstrainedMesh, FillRegion};

/// A surface in a plane. Point numbers run through the given points, then through `added`.
#[derive(Debug, Default)]
pub(super) struct Cover {
    /// Crossing points of loops.
    pub(super) added: Vec<DVec2>,
    /// For each given point, the point that replaces it.
    pub(super) stand_ins: Vec<u32>,
    /// Counter-clockwise triangles, each with the loops' winding number there, which is not 0.
    pub(super) triangles: Vec<([u32; 3], i32)>,
    /// Loop edges that consist of several triangle edges: all their points in order.
    pub(super) paths: Vec<Vec<u32>>,
    /// Loops left out of the result.
    pub(super) left_out: Vec<usize>,
}

/// Covers the region that loops wind around. Points must be finite.
pub(super) fn cover(points: &[DVec2], loops: &[Vec<u32>]) -> Cover {
    let mut outline = FillRegion::of(points, loops, &[]);
    let drawn = preclassified(&mut outline);
    let mut cover = Cover {
        stand_ins: outline.stand_ins(),
        ..Cover::default()
    };
    if let Some(drawn) = drawn {
        let windings = windings(&drawn.mesh);
        for face in drawn.mesh.inner_faces() {
            let winding = windings[face.fix().index()];
            if winding != 0 {
                let corners = face.vertices().map(|v| v.data().number);
                cover.triangles.push((corners, winding));
            }
        }
        cover.paths = paths(&outline, &drawn);
    }
    cover.added = outline.added;
    cover.left_out = outline.left_out.into_iter().collect();
    cover
}

/// The edges that were drawn in several steps.
fn paths(outline: &FillRegion, drawn: &ConstrainedMesh) -> Vec<Vec<u32>> {
    let mut steps: Vec<(u32, [u32; 2])> = (drawn.covered.iter())
        .map(|(part, edge)| {
            let ends = drawn.mesh.directed_edge(*edge).vertices();
            (outline.parts[*part].edge, ends.map(|v| v.data().number))
        })
        .collect();
    // Stable sort: the steps of a part stay in order.
    steps.sort_by_key(|(edge, _)| *edge);
    let of_edge = steps.chunk_by(|a, b| a.0 == b.0);
    of_edge
        .filter(|run| run.len() > 1)
        .map(|run| joined(run.iter().map(|(_, ends)| *ends).collect()))
        .collect()
}

/// Steps of one path in walking order.
fn joined(mut steps: Vec<[u32; 2]>) -> Vec<u32> {
    let is_end = |at: u32| steps.iter().all(|[_, to]| *to != at);
    let first = (steps.iter().position(|[from, _]| is_end(*from))).unwrap_or_default();
    let mut at = steps[first][0];
    let mut path = vec![at];
    while let Some(next) = steps.iter().position(|[from, _]| *from == at) {
        at = steps.remove(next)[1];
        path.push(at);
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, size: f64) -> [DVec2; 4] {
        let at = DVec2::new(x, y);
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| at + DVec2::new(x, y) * size)
    }

    /// Checks that the directed edges of all triangles, and of all loops along their paths, cancel completely.
    fn is_closed(cover: &Cover, loops: &[Vec<u32>]) -> bool {
        let mut net = std::collections::BTreeMap::new();
        let mut pass = |[a, b]: [u32; 2], times: i32| {
            let (key, sign) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
            *net.entry(key).or_insert(0) += sign * times;
        };
        for (t, winding) in &cover.triangles {
            (0..3).for_each(|i| pass([t[i], t[(i + 1) % 3]], *winding));
        }
        for one in loops {
            for (i, from) in one.iter().enumerate() {
                let ends = [*from, one[(i + 1) % one.len()]].map(|p| cover.stand_ins[p as usize]);
                let is_path =
                    |p: &&Vec<u32>| p.first() == Some(&ends[0]) && p.last() == Some(&ends[1]);
                match cover.paths.iter().find(is_path) {
                    Some(path) => path.windows(2).for_each(|w| pass([w[0], w[1]], -1)),
                    None => pass(ends, -1),
                }
            }
        }
        net.values().all(|n| *n == 0)
    }

    #[test]
    fn loops_that_cross_are_covered_as_often_as_they_wind() {
        let points = [square(0.0, 0.0, 1.0), square(0.3, 0.4, 1.0)].concat();
        let loops = [vec![0, 1, 2, 3], vec![4, 5, 6, 7]];
        let cover = cover(&points, &loops);
        assert_eq!((cover.added.len(), cover.paths.len()), (2, 4), "{cover:?}");
        let all: Vec<DVec2> = points.iter().chain(&cover.added).copied().collect();
        let area: f64 = (cover.triangles.iter())
            .map(|(t, winding)| {
                let [a, b, c] = t.map(|i| all[i as usize]);
                0.5 * (b - a).perp_dot(c - a) * f64::from(*winding)
            })
            .sum();
        assert!((area - 2.0).abs() < 1e-12, "{area}");
        assert!(
            cover.triangles.iter().any(|(_, winding)| *winding == 2),
            "in both"
        );
        assert!(is_closed(&cover, &loops), "{cover:?}");
        let unpassed = Cover {
            paths: Vec::new(),
            ..cover
        };
        assert!(
            !is_closed(&unpassed, &loops),
            "without paths edges miss the crossings"
        );
    }

    #[test]
    fn an_edge_through_a_point_of_another_loop_is_told() {
        let points = [square(0.0, 0.0, 2.0), square(1.0, 2.0, 0.5)].concat();
        let loops = [vec![0, 1, 2, 3], vec![4, 5, 6, 7]];
        let cover = cover(&points, &loops);
        assert!(cover.added.is_empty(), "{cover:?}");
        assert!(cover.paths.contains(&vec![2, 5, 4, 3]), "{cover:?}");
        assert!(is_closed(&cover, &loops), "{cover:?}");
    }
}
