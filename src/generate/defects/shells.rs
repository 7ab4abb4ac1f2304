//! Defects of whole regions or of the whole mesh: charts pulled apart, copies stuck into the surface, all faces separated.

use std::collections::BTreeMap;

use glam::DVec3;

use super::edit::Edit;
use super::select::{charts, shuffled, signed};
use super::{middle, within};
use crate::scene::Bounds;
use crate::scene::meshes::weld::thousands;

/// Divides the surface into charts and moves their border vertices towards the charts' centres by half of `width`, but by at most
/// half the distance.
pub(super) fn pull_apart(edit: &mut Edit, width: f64, count: u32, seed: u64) -> String {
    let chart = charts(&edit.faces, count, seed);
    // Vertices of each chart, without duplicates.
    let mut users: Vec<[u32; 2]> = (edit.faces.iter().zip(&chart))
        .flat_map(|(face, chart)| face.corners.map(|v| [v, *chart]))
        .collect();
    users.sort_unstable();
    users.dedup();
    let charts = chart.iter().max().map_or(0, |most| *most as usize + 1);
    let mut members = vec![Vec::new(); charts];
    for [vertex, chart] in &users {
        members[*chart as usize].push(edit.at(*vertex));
    }
    let middles: Vec<DVec3> = members
        .into_iter()
        .map(|points| middle(points.into_iter()))
        .collect();
    let mut moved = BTreeMap::new();
    let rim = users.chunk_by(|a, b| a[0] == b[0]).filter(|u| u.len() > 1);
    for &[vertex, chart] in rim.flatten() {
        let at = edit.at(vertex);
        let inward = middles[chart as usize] - at;
        let step = inward.normalize_or_zero() * (0.5 * width).min(0.5 * inward.length());
        let new = edit.add(at + step, vertex);
        moved.insert([vertex, chart], new);
    }
    for (face, chart) in edit.faces.iter_mut().zip(chart) {
        let there = |v: u32| moved.get(&[v, chart]).copied().unwrap_or(v);
        *face = face.with_corners(face.corners.map(there));
    }
    let rims = thousands(moved.len());
    format!("the surface is split into {charts} charts with {rims} vertices on their borders")
}

/// Sticks small copies of the mesh into its surface: their centres lie half their size below faces, but no copy leaves the mesh's
/// bounding box.
pub(super) fn overlap(edit: &mut Edit, size: f64, copies: u32, seed: u64) -> String {
    let whole = edit.faces.clone();
    let bounds = edit.bounds;
    let order = shuffled(whole.len(), seed);
    let half = bounds.size() * 0.5 * size;
    for number in order.iter().take(copies as usize) {
        let [a, b, c] = edit.points(&whole[*number as usize]);
        let inward = (c - a).cross(b - a).normalize_or_zero();
        let room = Bounds {
            min: bounds.min + half,
            max: bounds.max - half,
        };
        let depth = 0.5 * half.max_element();
        let to = within(&room, middle([a, b, c].into_iter()) + inward * depth);
        let mut copied = BTreeMap::new();
        for face in &whole {
            let corners = face.corners.map(|v| {
                let at = to + (edit.at(v) - bounds.centre()) * size;
                *copied.entry(v).or_insert_with(|| edit.add(at, v))
            });
            edit.faces.push(face.with_corners(corners));
        }
    }
    let count = order.len().min(copies as usize);
    format!("{count} copies of the mesh stick in its surface")
}

/// Gives every face its own vertices, each moved by at most `distance`, in a direction that does not depend on `distance`.
pub(super) fn unweld(edit: &mut Edit, distance: f64, seed: u64) -> String {
    let bounds = edit.bounds;
    let longest = 3.0_f64.sqrt();
    for number in 0..edit.faces.len() {
        let face = edit.faces[number];
        let mut corners = face.corners;
        for (i, vertex) in corners.iter_mut().enumerate() {
            let word = |axis: u64| signed(seed, (3 * number + i) as u64 * 3 + axis);
            let way = DVec3::new(word(0), word(1), word(2)) / longest;
            *vertex = edit.add(within(&bounds, edit.at(*vertex) + way * distance), *vertex);
        }
        edit.faces[number] = face.with_corners(corners);
    }
    let corners = thousands(3 * edit.faces.len());
    format!("each of the {corners} corners has its own vertex")
}
