//! The solid of a mesh by a fill rule, if its bodies overlap: with voids where an even number of them overlap, or merged into one.
//!
//! Cost: comparing the boxes of all bodies; with the even-odd rule, one operation for each body whose box meets that of another.

use super::solid::{ManifoldSolid, Undivided};
use super::turned;
use crate::scene::meshes::topology::Sets;
use crate::scene::{Bodies, Bounds, Fill, Mesh};

/// The solid, and the mesh numbers by which its faces are found later; face numbers are triangle numbers of the mesh.
pub(super) fn filled(mesh: &Mesh, fill: Fill) -> Result<(ManifoldSolid, Vec<u32>), Undivided> {
    let bodies = match fill {
        Fill::EvenOdd => overlapping(mesh),
        Fill::Nonzero => Vec::new(),
    };
    if bodies.is_empty() {
        let (solid, number) = outward(mesh, |t| t as u32)?;
        return Ok((solid, vec![number]));
    }
    let mut numbers = Vec::new();
    let mut solid_of = |triangles: &[u32]| {
        let (solid, number) = outward(&mesh.picked(triangles).0, |t| triangles[t])?;
        numbers.push(number);
        Ok(solid)
    };
    let mut all: Option<ManifoldSolid> = None;
    for set in &bodies {
        let mut odd: Option<ManifoldSolid> = None;
        for triangles in set {
            let solid = solid_of(triangles)?;
            odd = Some(match odd {
                Some(odd) => odd.or(&solid)?.without(&odd.and(&solid)?)?,
                None => solid,
            });
        }
        all = match (all, odd) {
            (Some(all), Some(odd)) => Some(all.or(&odd)?),
            (all, odd) => all.or(odd),
        };
    }
    match all {
        Some(all) => Ok((all, numbers)),
        None => Err(Undivided::Open),
    }
}

/// A solid whose faces point outwards.
fn outward(mesh: &Mesh, face: impl Fn(usize) -> u32) -> Result<(ManifoldSolid, u32), Undivided> {
    match mesh.volume() < 0.0 {
        true => ManifoldSolid::new(&turned(mesh), face),
        false => ManifoldSolid::new(mesh, face),
    }
}

/// The triangles of each body of a mesh, in sets whose boxes meet; all bodies that meet no other count as one. Empty if none meet.
fn overlapping(mesh: &Mesh) -> Vec<Vec<Vec<u32>>> {
    let bodies = Bodies::of(mesh).triangles();
    let bounds: Vec<Bounds> = (bodies.iter())
        .map(|body| Bounds::from_points(body.iter().flat_map(|t| mesh.corners(*t as usize))))
        .collect();
    let mut order: Vec<usize> = (0..bodies.len()).collect();
    order.sort_by(|a, b| bounds[*a].min.x.total_cmp(&bounds[*b].min.x));
    let mut sets = Sets::new(bodies.len());
    let mut is_apart = vec![true; bodies.len()];
    for (k, a) in order.iter().enumerate() {
        let begins_before = |b: &&usize| bounds[**b].min.x < bounds[*a].max.x;
        for b in order[k + 1..].iter().take_while(begins_before) {
            let [own, other] = [&bounds[*a], &bounds[*b]];
            if own.min.cmplt(other.max).all() && other.min.cmplt(own.max).all() {
                sets.join(*a as u32, *b as u32);
                is_apart[*a] = false;
                is_apart[*b] = false;
            }
        }
    }
    if is_apart.iter().all(|apart| *apart) {
        return Vec::new();
    }
    let mut apart: Vec<u32> = Vec::new();
    let mut of_set: Vec<Vec<Vec<u32>>> = vec![Vec::new(); bodies.len()];
    for (number, body) in bodies.into_iter().enumerate() {
        match is_apart[number] {
            true => apart.extend(body),
            false => of_set[sets.find(number as u32) as usize].push(body),
        }
    }
    let apart = (!apart.is_empty()).then(|| vec![apart]);
    let of_set = of_set.into_iter().filter(|set| !set.is_empty());
    apart.into_iter().chain(of_set).collect()
}
