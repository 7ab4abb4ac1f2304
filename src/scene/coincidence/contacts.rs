//! Finds solids that touch, and assigns classes such that no two touching solids share a class.
//!
//! Surfaces are sampled more finely than a grid's cells; parts that occupy the same or adjacent cells are neighbours. So parts closer than
//! a cell get different classes, whether they touch or not. Cost: one or more samples per triangle, in proportion to the cells that it
//! covers, and a sort of the samples. Bounding boxes would not do, since those of nested rings all overlap.
//!
//! Cannot: detect contacts of parts that touch only in another pose.

use std::cmp::Reverse;

use glam::{DAffine3, DVec3, IVec3};
use rayon::prelude::*;

use crate::scene::{Bounds, Mesh, longest_edge};

/// Maximum number of samples along a triangle's side; in larger triangles some contacts in the interior may be missed.
const MOST_STEPS: f64 = 512.0;

/// The neighbours of each placed mesh, by index; cells are `cell` wide in world units.
pub(crate) fn contacts(parts: &[(&Mesh, DAffine3)], cell: f64) -> Vec<Vec<usize>> {
    let corners = parts.iter().flat_map(|(mesh, placed)| {
        let corners = mesh.bounds().corners();
        corners.map(|c| placed.transform_point3(c))
    });
    let origin = Bounds::from_points(corners).min;
    let mut cells: Vec<(u64, u32)> = (parts.par_iter().enumerate())
        .flat_map_iter(|(index, (mesh, placed))| {
            let mut of_part = cells_of(mesh, placed, origin, cell);
            of_part.sort_unstable();
            of_part.dedup();
            of_part.into_iter().map(move |key| (key, index as u32))
        })
        .collect();
    cells.par_sort_unstable();
    let mut pairs: Vec<(u32, u32)> = (cells.par_iter())
        .flat_map_iter(|(key, part)| {
            let near = AHEAD.into_iter().map(|step| key.wrapping_add_signed(step));
            let near = near.flat_map(|key| {
                let first = cells.partition_point(|c| c.0 < key);
                let same = cells[first..].iter().take_while(move |c| c.0 == key);
                same.take(MOST_IN_A_CELL)
            });
            near.filter(|other| other.1 != *part)
                .map(|other| (*part.min(&other.1), *part.max(&other.1)))
        })
        .collect();
    pairs.par_sort_unstable();
    pairs.dedup();
    let mut neighbours = vec![Vec::new(); parts.len()];
    for (a, b) in pairs {
        neighbours[a as usize].push(b as usize);
        neighbours[b as usize].push(a as usize);
    }
    neighbours
}

/// Maximum number of parts per cell that are tested as neighbours: with hundreds in one cell, hatch directions cannot tell them apart.
const MOST_IN_A_CELL: usize = 32;

/// Maximum number of items that get classes in the best order; if there are more, classes are assigned in input order.
const MOST_IN_ORDER: usize = 4096;

/// Bits per coordinate in a cell's key.
const BITS: u32 = 20;

const fn key_step(x: i64, y: i64, z: i64) -> i64 {
    (z << (2 * BITS)) + (y << BITS) + x
}

/// Key offsets from a cell to itself and to half of its 26 neighbours; the other half finds the cell from their side.
const AHEAD: [i64; 14] = [
    key_step(0, 0, 0),
    key_step(1, 0, 0),
    key_step(0, 1, 0),
    key_step(0, 0, 1),
    key_step(1, 1, 0),
    key_step(-1, 1, 0),
    key_step(1, 0, 1),
    key_step(-1, 0, 1),
    key_step(0, 1, 1),
    key_step(0, -1, 1),
    key_step(1, 1, 1),
    key_step(-1, 1, 1),
    key_step(1, -1, 1),
    key_step(-1, -1, 1),
];

fn cells_of(mesh: &Mesh, placed: &DAffine3, origin: DVec3, cell: f64) -> Vec<u64> {
    let most = (1 << BITS) - 2;
    // Cell coordinates start at 1, so that a step back still gives a valid key.
    let key = |p: DVec3| {
        let at = ((p - origin) / cell).floor().as_ivec3() + IVec3::ONE;
        let [x, y, z] = at
            .clamp(IVec3::ONE, IVec3::splat(most))
            .to_array()
            .map(|c| c as u64);
        (z << (2 * BITS)) | (y << BITS) | x
    };
    let mut keys = Vec::new();
    for corners in &mesh.triangles {
        let points = corners.map(|i| placed.transform_point3(mesh.positions[i as usize]));
        let [a, b, c] = points;
        // Sample spacing is smaller than a cell.
        let steps = (longest_edge(points) / (0.7 * cell))
            .ceil()
            .clamp(1.0, MOST_STEPS);
        let count = steps as u32;
        for i in 0..=count {
            for j in 0..=count - i {
                let [u, v] = [i, j].map(|k| f64::from(k) / steps);
                keys.push(key(a + u * (b - a) + v * (c - a)));
            }
        }
    }
    keys
}

/// Greedy graph colouring with few classes, so that no two neighbours share a class. Next comes the item with the most classes among its
/// neighbours; ties go to the most neighbours, then the first (Brélaz 1979, DSATUR).
pub(crate) fn classes(neighbours: &[Vec<usize>]) -> Vec<u16> {
    let mut classes: Vec<Option<u16>> = vec![None; neighbours.len()];
    let mut about: Vec<Vec<u16>> = vec![Vec::new(); neighbours.len()];
    for place in 0..neighbours.len() {
        let next = match neighbours.len() > MOST_IN_ORDER {
            true => place,
            false => {
                let open = (0..neighbours.len()).filter(|i| classes[*i].is_none());
                let best =
                    open.max_by_key(|i| (about[*i].len(), neighbours[*i].len(), Reverse(*i)));
                best.unwrap_or(place)
            }
        };
        let class = (0..).find(|class| !about[next].contains(class));
        classes[next] = class;
        for neighbour in &neighbours[next] {
            let met = &mut about[*neighbour];
            if let Some(class) = class.filter(|c| !met.contains(c)) {
                met.push(class);
            }
        }
    }
    classes.into_iter().map(Option::unwrap_or_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;

    fn placed(x: f64) -> DAffine3 {
        DAffine3::from_translation(DVec3::X * x)
    }

    #[test]
    fn what_touches_is_found_and_what_does_not_is_not() {
        let cube = shape("cube").expect("a shape")[0].mesh.clone();
        let size = cube.bounds().size().x;
        let all = [0.0, size, 2.2 * size, 3.2 * size].map(|x| (&*cube, placed(x)));
        let found = contacts(&all, size / 50.0);
        assert_eq!(found, [vec![1], vec![0], vec![3], vec![2]]);
        let coarse = contacts(&all, size / 4.0);
        assert_eq!(coarse[1], [0, 2], "a gap within a cell is none");
    }

    #[test]
    fn neighbours_never_share_a_class() {
        let wheel: Vec<Vec<usize>> = (0..8)
            .map(|i: usize| match i {
                0 => (1..8).collect(),
                i => vec![0, i % 7 + 1, (i + 5) % 7 + 1],
            })
            .collect();
        let classes = classes(&wheel);
        for (i, near) in wheel.iter().enumerate() {
            assert!(
                near.iter().all(|n| classes[*n] != classes[i]),
                "{classes:?}"
            );
        }
        assert_eq!(classes.iter().max(), Some(&3), "an odd wheel takes four");
        assert_eq!(
            super::classes(&[vec![], vec![]]),
            [0, 0],
            "who is alone has the first"
        );
    }
}
