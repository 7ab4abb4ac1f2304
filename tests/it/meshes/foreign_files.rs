//! Promise: files as other programs write them are read for their geometry: what only looks, data or habits of a format stand in the way
//! of is passed over with a note, and what moves, repeats or hides geometry is read.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod gltf;
mod slicers;
mod text;

use std::path::Path;

use cutaway::scene::{Bounds, Topology};
use cutaway_io::load::{Loaded, load_mesh_file};
use glam::DVec3;

use crate::common::command;

/// The corners of a cube of size 1, those of a lower face and above it, and its faces from outside.
const CORNERS: [[u8; 3]; 8] = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 1],
    [1, 1, 1],
    [0, 1, 1],
];
const QUADS: [[u16; 4]; 6] = [
    [0, 3, 2, 1],
    [4, 5, 6, 7],
    [0, 1, 5, 4],
    [1, 2, 6, 5],
    [2, 3, 7, 6],
    [3, 0, 4, 7],
];

fn triangles() -> impl Iterator<Item = [u16; 3]> {
    let halves = |[a, b, c, d]: [u16; 4]| [[a, b, c], [a, c, d]];
    QUADS.into_iter().flat_map(halves)
}

fn open(path: &Path) -> Loaded {
    load_mesh_file(path).unwrap_or_else(|e| panic!("{e}"))
}

fn bounds(loaded: &Loaded) -> Bounds {
    let parts = loaded.parts.iter();
    parts.fold(Bounds::EMPTY, |all, part| all.union(part.bounds_in_world()))
}

/// That a file holds so many closed cubes of size 1, and no more.
#[track_caller]
fn must_be_cubes(loaded: &Loaded, count: usize, what: &str) {
    let facts = Topology::from_parts(&loaded.parts);
    let notes = &loaded.notes;
    assert!(facts.closed, "{what} is open: {notes:?}");
    let off = facts.volume - count as f64;
    assert!(
        off.abs() < 1e-9,
        "{what}: volume {}: {notes:?}",
        facts.volume
    );
}

#[track_caller]
fn must_say(loaded: &Loaded, words: &str, what: &str) {
    let notes = &loaded.notes;
    let is_said = notes.iter().any(|note| note.to_string().contains(words));
    assert!(is_said, "{what}: no `{words}` in {notes:?}");
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}
