//! At an edge, pairs the triangles that bound the same wedge of solid.
//!
//! Going around the edge, a triangle either enters or leaves the solid, by its orientation. Each entry pairs with the next exit, like
//! brackets. Among triangles at the same angle, as where solids touch, exits come before entries, and triangle indices decide the pairs.
//!
//! Cost: a sort of the triangles at the edge. Angles within a ten-thousandth of a radian count as equal.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::Mesh;
use crate::scene::meshes::topology::EdgeUse;

/// Angles that differ by less than this, in radians, count as equal, because files round to f32.
const SAME_ANGLE: f64 = 1e-4;

/// Pairs the triangles around an edge; equally many of them must use the edge in each direction.
pub(super) fn walls(mesh: &Mesh, edge: [u32; 2], uses: &[EdgeUse]) -> Vec<[u32; 2]> {
    let order = around(mesh, edge, uses);
    let mut pairs = Vec::with_capacity(uses.len() / 2);
    let mut open: Vec<u32> = Vec::new();
    let mut left = Vec::new();
    for one in order {
        match (one.is_down, open.last()) {
            (true, _) => open.push(one.triangle),
            (false, Some(last)) => {
                pairs.push([*last, one.triangle]);
                open.pop();
            }
            (false, None) => left.push(one.triangle),
        }
    }
    // Wedges still open are closed after wrapping around to the start.
    pairs.extend(
        left.into_iter()
            .zip(open.into_iter().rev())
            .map(|(a, b)| [a, b]),
    );
    pairs
}

/// The edge's uses, sorted by angle around the edge, counter-clockwise seen from the vertex with the larger index. In this order a downward
/// use enters the solid, because its outer side comes first; an upward use leaves it.
fn around(mesh: &Mesh, edge: [u32; 2], uses: &[EdgeUse]) -> Vec<EdgeUse> {
    let [from, to] = edge.map(|i| mesh.positions[i as usize]);
    let along = (to - from).normalize_or_zero();
    let away = |of: &EdgeUse| {
        let corners = mesh.triangles[of.triangle as usize];
        let other = corners.into_iter().find(|i| !edge.contains(i));
        let to_other = other.map_or(DVec3::ZERO, |i| mesh.positions[i as usize] - from);
        to_other - along * to_other.dot(along)
    };
    let first = uses.first().map_or(DVec3::ZERO, away).normalize_or_zero();
    let second = along.cross(first);
    let mut placed: Vec<(f64, EdgeUse)> = (uses.iter())
        .map(|of| {
            let away = away(of);
            let angle = away.dot(second).atan2(away.dot(first)).rem_euclid(TAU);
            // An angle just below a full turn counts as 0.
            let is_whole = angle > TAU - SAME_ANGLE;
            (if is_whole { 0.0 } else { angle }, *of)
        })
        .collect();
    placed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut order = Vec::with_capacity(uses.len());
    for same in placed.chunk_by(|a, b| b.0 - a.0 < SAME_ANGLE) {
        let of = |is_down: bool| {
            let some = same.iter().map(|(_, of)| *of);
            let mut some: Vec<EdgeUse> = some.filter(|of| of.is_down == is_down).collect();
            some.sort_by_key(|of| of.triangle);
            some
        };
        // Exits are reversed, so that the order seen from the edge's other end is the exact reverse.
        order.extend(of(false).into_iter().rev());
        order.extend(of(true));
    }
    order
}
