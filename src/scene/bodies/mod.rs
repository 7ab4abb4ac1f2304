//! The bodies of a mesh: what of it could be taken away without tearing anything.
//!
//! A *shell* is a piece of surface whose triangles hang together over edges (see [`shells`]); a vertex alone joins nothing. A body is a
//! shell with its cavities. Shells that are closed nest: of those that contain a shell wholly, the smallest is around it.
//!
//! | the shell | is |
//! |---|---|
//! | around it is nothing | a body |
//! | around it is a body that faces the same way | a body of its own: solids that overlap |
//! | around it is a body that faces the other way | a cavity of that body |
//! | around it is a cavity | a body, whichever way it faces |
//! | it is open | a body: nothing is inside of it |
//!
//! So a mesh that is inside out as a whole has the bodies that it has the right way round. Where orientation says nothing, because
//! triangles of a shell contradict each other or it is flat, what is directly in a body is its cavity: parity.
//!
//! Bodies are numbered by their first triangles.
//!
//! Cost: one parallel sort of three numbers per triangle; where there are shells that do not face out, boxes over the triangles of closed
//! shells, and up to eight rays per shell ([`inside`]). Cannot: tell bodies apart that share all of their edges, or join the sheets of a
//! solid whose edges are open.

mod around_edge;
mod inside;
mod pieces;
mod shells;

use rayon::prelude::*;

use self::inside::Insides;
pub(crate) use self::pieces::{Pieces, body_name};
use self::shells::{Facing, Shells};
use super::Mesh;

/// Which body each triangle of a mesh belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    of_triangles: Vec<u32>,
    count: usize,
    open: usize,
}

impl Bodies {
    /// The bodies of a mesh. Indices must be in range and coordinates finite ([`Mesh::defect`]).
    pub fn of(mesh: &Mesh) -> Self {
        let shells = Shells::of(mesh);
        let heads = heads(mesh, &shells);
        // Bodies in the order of their first triangles, whichever shell of theirs has it.
        let mut numbers: Vec<Option<u32>> = vec![None; heads.len()];
        let mut count = 0;
        let of_triangles = (shells.of_triangles.iter())
            .map(|shell| {
                let number = &mut numbers[heads[*shell as usize] as usize];
                *number.get_or_insert_with(|| {
                    count += 1;
                    count - 1
                })
            })
            .collect();
        Self {
            of_triangles,
            count: count as usize,
            open: shells.shells.iter().filter(|s| !s.is_closed).count(),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many of them are open.
    pub fn open(&self) -> usize {
        self.open
    }

    /// The number of the body of each triangle, from 0.
    pub fn of_triangles(&self) -> &[u32] {
        &self.of_triangles
    }

    /// The triangles of each body, in their order.
    pub fn triangles(&self) -> Vec<Vec<u32>> {
        let mut triangles = vec![Vec::new(); self.count];
        for (triangle, body) in (0..).zip(&self.of_triangles) {
            triangles[*body as usize].push(triangle);
        }
        triangles
    }
}

/// The shell that each shell is a body with: itself, or the one whose cavity it is.
fn heads(mesh: &Mesh, shells: &Shells) -> Vec<u32> {
    let all = &shells.shells;
    let mut heads: Vec<u32> = (0..all.len() as u32).collect();
    let faces_out = |s: &shells::Shell| s.facing == Some(Facing::Out);
    if all.iter().all(|s| !s.is_closed || faces_out(s)) {
        // Whatever is in what, there is no cavity.
        return heads;
    }
    let insides = Insides::of(mesh, shells);
    let around: Vec<Option<u32>> = (0..all.len() as u32)
        .into_par_iter()
        .map(|shell| insides.smallest_around(shell))
        .collect();
    // What is around a shell is larger, and comes before it.
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    order.sort_by(|a, b| all[*b as usize].by_size(&all[*a as usize]).then(b.cmp(a)));
    for shell in order {
        let Some(outer) = around[shell as usize] else {
            continue;
        };
        let is_cavity = heads[outer as usize] != outer;
        let [inner_facing, outer_facing] = [shell, outer].map(|s| all[s as usize].facing);
        let overlaps = inner_facing.is_some() && inner_facing == outer_facing;
        if !is_cavity && !overlaps {
            heads[shell as usize] = outer;
        }
    }
    heads
}

#[cfg(test)]
mod tests;
