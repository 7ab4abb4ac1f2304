//! Closed paths along the open edges of a mesh.
//!
//! Each edge with a single triangle is walked against that triangle's direction. If a path returns to a vertex that it has passed, the
//! part in between is a separate hole: holes that touch in a vertex are separated, and no hole passes a vertex twice.
//!
//! Cost: a sort of the edges, and one walk over the open ones.

use std::collections::BTreeMap;

use crate::scene::meshes::topology::EdgeUses;

/// The rims of holes.
#[derive(Debug, Default)]
pub(super) struct Rims {
    /// Loops, each starting at its least vertex, sorted.
    pub(super) loops: Vec<Vec<u32>>,
    /// Number of open edges that are in no loop.
    pub(super) loose: usize,
}

pub(super) fn rims(triangles: &[[u32; 3]]) -> Rims {
    let mut steps: Vec<[u32; 2]> = Vec::new();
    let mut odd = 0;
    for ([low, high], uses) in EdgeUses::of(triangles).runs() {
        let mut uses = uses;
        let first = uses.next();
        match (first, uses.count()) {
            (Some(only), 0) => steps.push(match only.is_down {
                true => [low, high],
                false => [high, low],
            }),
            (_, more) => odd += (more + 1) % 2,
        }
    }
    steps.sort_unstable();
    let mut rims = Rims {
        loops: walk(&steps),
        loose: 0,
    };
    let walked: usize = rims.loops.iter().map(Vec::len).sum();
    rims.loose = steps.len() - walked + odd;
    for rim in &mut rims.loops {
        let least = (0..rim.len()).min_by_key(|i| rim[*i]).unwrap_or(0);
        rim.rotate_left(least);
    }
    rims.loops.sort_unstable();
    rims
}

/// Walks each step from vertex to vertex once; returns the closed paths found.
fn walk(steps: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut loops = Vec::new();
    let mut is_walked = vec![false; steps.len()];
    for start in 0..steps.len() {
        if is_walked[start] {
            continue;
        }
        is_walked[start] = true;
        let [from, mut at] = steps[start];
        let mut path = vec![from];
        let mut place_of = BTreeMap::from([(from, 0)]);
        loop {
            if let Some(place) = place_of.get(&at).copied() {
                let rim = path.split_off(place);
                rim.iter().for_each(|vertex| {
                    place_of.remove(vertex);
                });
                loops.push(rim);
            }
            // If the whole path was a hole, there is no vertex to continue from.
            if path.is_empty() {
                break;
            }
            place_of.insert(at, path.len());
            path.push(at);
            let first = steps.partition_point(|[from, _]| *from < at);
            let leaving = steps[first..].iter().take_while(|[from, _]| *from == at);
            let next = (first..).zip(leaving).find(|(step, _)| !is_walked[*step]);
            let Some((step, [_, to])) = next else { break };
            is_walked[step] = true;
            at = *to;
        }
    }
    // A hole of two edges would have no triangle.
    loops.retain(|rim| rim.len() > 2);
    loops
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_that_touch_in_a_vertex_come_apart() {
        // Two triangles that share vertex 2, each step given once, and a way that does not close.
        let mut steps = vec![
            [0, 1],
            [1, 2],
            [2, 0],
            [2, 3],
            [3, 4],
            [4, 2],
            [9, 8],
            [8, 7],
        ];
        steps.sort_unstable();
        let mut loops = walk(&steps);
        loops.iter_mut().for_each(|rim| {
            let least = (0..3).min_by_key(|i| rim[*i]).unwrap();
            rim.rotate_left(least);
        });
        loops.sort();
        assert_eq!(loops, [[0, 1, 2], [2, 3, 4]]);
    }

    #[test]
    fn rims_run_against_their_triangles() {
        let found = rims(&[[0, 1, 2], [0, 2, 3], [5, 6, 7], [5, 6, 8], [5, 6, 9]]);
        assert_eq!(found.loops, [[0, 3, 2, 1]]);
        // Three triangles at one edge, which is open without being around a hole, and their six others.
        assert_eq!(found.loose, 7);
    }
}
