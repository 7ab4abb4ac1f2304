//! Pairs the triangles at an edge that bound the same wedge of solid.
//!
//! Going around the edge, a triangle either opens solid or closes it, by its orientation. Each opening pairs with the next closing, as
//! brackets do. Triangles at the same angle, as of solids that touch, close before others open, and pair by their numbers.
//!
//! Cost: a sort of the triangles at the edge. Angles are rounded: angles within a ten thousandth of a radian are equal.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::Mesh;
use crate::scene::meshes::topology::EdgeUse;

/// Angles that differ by less are the same, in radians: files round to f32.
const SAME_ANGLE: f64 = 1e-4;

/// The pairs of triangles around an edge of which as many run up as run down.
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
    // What is still open closes beyond where the order began.
    pairs.extend(
        left.into_iter()
            .zip(open.into_iter().rev())
            .map(|(a, b)| [a, b]),
    );
    pairs
}

/// The uses by their angles around the edge, counter-clockwise seen from its larger index: one that runs down has its outer side before
/// it and opens solid, one that runs up closes it.
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
            // A hair before the beginning is at it.
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
        // The order backwards has to be that of the edge seen from its other end.
        order.extend(of(false).into_iter().rev());
        order.extend(of(true));
    }
    order
}
