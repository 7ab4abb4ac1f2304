//! Defects of single faces: missing, flipped, duplicated, or split on one side of an edge.

use std::collections::BTreeSet;

use super::edit::{Edit, ShadedFace};
use super::select::{chosen, edges_of, mixed, share_of, shuffled};
use super::{middle, of_faces};

/// Removes a share of the faces.
pub(super) fn holes(edit: &mut Edit, share: f64, patch: u32, seed: u64) -> String {
    let is_chosen = chosen(&edit.faces, share, patch, seed);
    format!("{} are missing", remove(edit, &is_chosen))
}

/// Removes the faces whose centroid lies beyond a plane perpendicular to an axis; `share` is the removed share of the box.
pub(super) fn open(edit: &mut Edit, share: f64, axis: usize, from_below: bool) -> String {
    let (lo, hi) = (edit.bounds.min[axis], edit.bounds.max[axis]);
    let is_beyond = |face: &ShadedFace| {
        let at = middle(edit.points(face).into_iter())[axis];
        if from_below {
            at < lo + (hi - lo) * share
        } else {
            at > hi - (hi - lo) * share
        }
    };
    let is_chosen: Vec<bool> = edit.faces.iter().map(is_beyond).collect();
    format!("{} are missing beyond a plane", remove(edit, &is_chosen))
}

fn remove(edit: &mut Edit, is_chosen: &[bool]) -> String {
    let all = edit.faces.len();
    let mut gone = is_chosen.iter();
    edit.faces
        .retain(|_| !gone.next().is_some_and(|gone| *gone));
    of_faces(all - edit.faces.len(), all)
}

/// Flips a share of the faces.
pub(super) fn flip(edit: &mut Edit, share: f64, patch: u32, seed: u64) -> String {
    let is_chosen = chosen(&edit.faces, share, patch, seed);
    let mut count = 0;
    for (face, _) in edit.faces.iter_mut().zip(&is_chosen).filter(|(_, c)| **c) {
        *face = face.turned();
        count += 1;
    }
    format!("{} are flipped", of_faces(count, is_chosen.len()))
}

/// Duplicates a share of the faces.
pub(super) fn duplicate(edit: &mut Edit, share: f64, patch: u32, seed: u64) -> String {
    let is_chosen = chosen(&edit.faces, share, patch, seed);
    let twice = edit.faces.iter().zip(&is_chosen).filter(|(_, c)| **c);
    let twice: Vec<ShadedFace> = twice.map(|(face, _)| *face).collect();
    let all = edit.faces.len();
    edit.faces.extend_from_slice(&twice);
    format!("{} are duplicated", of_faces(twice.len(), all))
}

/// Splits one edge of each chosen face at its midpoint, for that face only. No edge is split from both sides or more than once.
pub(super) fn split_one_side(edit: &mut Edit, share: f64, seed: u64) -> String {
    let all = edit.faces.len();
    let mut split = BTreeSet::new();
    for number in shuffled(all, seed).into_iter().take(share_of(all, share)) {
        let face = edit.faces[number as usize];
        let first = (mixed(seed ^ 1, u64::from(number)) % 3) as usize;
        let edges = edges_of(&face);
        let free = (0..3)
            .map(|i| (first + i) % 3)
            .find(|i| split.insert(edges[*i]));
        let Some(edge) = free else {
            continue;
        };
        let [from, to] = edges[edge];
        let at = (edit.at(from) + edit.at(to)) * 0.5;
        let vertex = edit.add(at, from);
        let [kept, new] = face.halves(edge, vertex);
        edit.faces[number as usize] = kept;
        edit.faces.push(new);
    }
    let split = of_faces(split.len(), all);
    format!("{split} are split along an edge, but the face across that edge is not")
}
