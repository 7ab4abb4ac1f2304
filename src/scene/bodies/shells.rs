//! Shells: edge-connected components of the surface.
//!
//! An edge with two triangles joins them, whatever their orientation. Where more than two meet, the order of the triangles decides first:
//! files write one solid after the other, so a closed run of consecutive triangles is separate from all other triangles ([`runs`]). Among
//! the remaining triangles, a shell that uses the edge equally often in both directions is complete by itself: two cubes that share an edge
//! are two shells. The rest are paired around the edge so that each wedge of solid has its two walls ([`around_edge`](super::around_edge)),
//! or all are joined if that fails. This separates a sheet from a solid that it is attached to by one edge, and two cubes whose common face
//! is present twice. A mesh with negative volume is treated as if its orientation were reversed, so that its cubes are separated too.

use std::cmp::Ordering;

use super::super::{Bounds, Mesh};
use super::around_edge::walls;
use crate::scene::meshes::topology::{EdgeUse, EdgeUses, Sets};

/// A shell is flat if its mean thickness, as a share of its size, is below this: rounding would decide which way it faces.
const FLAT: f64 = 1e-9;

/// Orientation of a closed shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ShellOrientation {
    Out,
    In,
}

/// Properties of a shell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shell {
    /// True if the shell uses every edge an even number of times.
    pub(super) is_closed: bool,
    /// True if the shell uses every edge equally often in both directions.
    pub(super) is_consistent: bool,
    /// Orientation of a closed shell; `None` if the shell is open, inconsistently oriented or flat.
    pub(super) facing: Option<ShellOrientation>,
    pub(super) bounds: Bounds,
    volume: f64,
}

impl Shell {
    /// Orders shells so that no shell sorts below one that it contains.
    pub(super) fn by_size(&self, other: &Self) -> Ordering {
        let span = |s: &Self| s.bounds.size().element_sum();
        let by_volume = |a: &Self, b: &Self| a.volume.abs().total_cmp(&b.volume.abs());
        let spans = span(self).total_cmp(&span(other));
        spans.then_with(|| by_volume(self, other))
    }
}

/// The shells of a mesh, numbered in the order of their first triangles.
pub(super) struct Shells {
    pub(super) of_triangles: Vec<u32>,
    pub(super) shells: Vec<Shell>,
}

impl Shells {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let uses = EdgeUses::of(&mesh.triangles);
        let of_triangles = joined(mesh, &uses);
        let count = of_triangles
            .iter()
            .max()
            .map_or(0, |most| *most as usize + 1);
        let mut shells = measured(mesh, &of_triangles, count);
        for (_, run) in uses.runs() {
            let mut run: Vec<(u32, i32)> = run
                .map(|u| (of_triangles[u.triangle as usize], step(u)))
                .collect();
            run.sort_unstable();
            for of_shell in run.chunk_by(|a, b| a.0 == b.0) {
                let shell = &mut shells[of_shell[0].0 as usize];
                shell.is_closed &= of_shell.len() % 2 == 0;
                shell.is_consistent &= of_shell.iter().map(|u| u.1).sum::<i32>() == 0;
            }
        }
        for shell in shells
            .iter_mut()
            .filter(|s| !(s.is_closed && s.is_consistent))
        {
            shell.facing = None;
        }
        Self {
            of_triangles,
            shells,
        }
    }
}

/// Sign of an edge use: upward and downward uses cancel.
fn step(of: EdgeUse) -> i32 {
    if of.is_down { -1 } else { 1 }
}

/// The shell of each triangle.
fn joined(mesh: &Mesh, uses: &EdgeUses) -> Vec<u32> {
    let count = mesh.triangles.len();
    let mut sets = Sets::new(count);
    let mut crowded: Vec<([u32; 2], Vec<EdgeUse>)> = Vec::new();
    for (edge, mut run) in uses.runs() {
        let (Some(a), Some(b)) = (run.next(), run.next()) else {
            continue;
        };
        match run.next() {
            None => sets.join(a.triangle, b.triangle),
            Some(c) => crowded.push((edge, [a, b, c].into_iter().chain(run).collect())),
        }
    }
    let run_of = match crowded.is_empty() {
        true => Vec::new(),
        false => runs(count, uses),
    };
    let mut shared: Vec<([u32; 2], Vec<EdgeUse>)> = Vec::new();
    for (edge, mut of_edge) in crowded {
        // Uses are sorted by triangle within each direction, not overall.
        of_edge.sort_by_key(|of| of.triangle);
        for of_run in
            of_edge.chunk_by(|a, b| run_of[a.triangle as usize] == run_of[b.triangle as usize])
        {
            match of_run {
                [_] => {}
                [a, b] => sets.join(a.triangle, b.triangle),
                more => shared.push((edge, more.to_vec())),
            }
        }
    }
    // Uses the patches that two-triangle edges alone join, so that the result does not depend on the order in which edges are visited.
    let patches: Vec<u32> = match shared.is_empty() {
        true => Vec::new(),
        false => (0..count as u32).map(|t| sets.find(t)).collect(),
    };
    let faces_in = !shared.is_empty()
        && facing_of(mesh.volume(), mesh.area(), &mesh.bounds()) == Some(ShellOrientation::In);
    for (edge, mut run) in shared {
        if faces_in {
            run.iter_mut().for_each(|u| u.is_down = !u.is_down);
        }
        for [a, b] in pairs_at(mesh, edge, run, &patches) {
            sets.join(a, b);
        }
    }
    let mut numbers = vec![u32::MAX; count];
    let mut next = 0;
    (0..count as u32)
        .map(|t| {
            let number = &mut numbers[sets.find(t) as usize];
            if *number == u32::MAX {
                *number = next;
                next += 1;
            }
            *number
        })
        .collect()
}

/// Per triangle, the number of its run. A run of consecutive triangles ends as soon as they use every edge equally often in both
/// directions; the triangles left at the end also form a run.
fn runs(count: usize, uses: &EdgeUses) -> Vec<u32> {
    let mut edges_of: Vec<Vec<(u32, i32)>> = vec![Vec::with_capacity(3); count];
    let mut edges = 0;
    for (number, (_, run)) in (0..).zip(uses.runs()) {
        run.for_each(|of| edges_of[of.triangle as usize].push((number, step(of))));
        edges = number as usize + 1;
    }
    let mut balances = vec![0_i32; edges];
    let mut unbalanced = 0_usize;
    let mut run = 0;
    (edges_of.iter())
        .map(|of_triangle| {
            let own = run;
            for (edge, step) in of_triangle {
                let balance = &mut balances[*edge as usize];
                unbalanced -= usize::from(*balance != 0);
                *balance += step;
                unbalanced += usize::from(*balance != 0);
            }
            run += u32::from(unbalanced == 0);
            own
        })
        .collect()
}

/// Pairs of triangles to join at an edge that has more than two triangles.
fn pairs_at(mesh: &Mesh, edge: [u32; 2], mut run: Vec<EdgeUse>, patches: &[u32]) -> Vec<[u32; 2]> {
    let patch = |u: &EdgeUse| patches[u.triangle as usize];
    run.sort_by_key(|u| (patch(u), u.triangle));
    let open = run.chunk_by(|a, b| patch(a) == patch(b));
    let open = open.filter(|of_patch| of_patch.iter().copied().map(step).sum::<i32>() != 0);
    let open: Vec<EdgeUse> = open.flatten().copied().collect();
    if open.iter().copied().map(step).sum::<i32>() == 0 {
        return walls(mesh, edge, &open);
    }
    open.windows(2)
        .map(|two| [two[0].triangle, two[1].triangle])
        .collect()
}

/// Boxes and volumes of the shells, and the orientation derived from them.
fn measured(mesh: &Mesh, of_triangles: &[u32], count: usize) -> Vec<Shell> {
    let mut bounds = vec![Bounds::EMPTY; count];
    for (t, shell) in of_triangles.iter().enumerate() {
        let bounds = &mut bounds[*shell as usize];
        *bounds = bounds.union(Bounds::from_points(mesh.corners(t)));
    }
    let mut six_volumes = vec![0.0; count];
    let mut twice_areas = vec![0.0; count];
    for (t, shell) in of_triangles.iter().enumerate() {
        let shell = *shell as usize;
        let origin = bounds[shell].centre();
        let [a, b, c] = mesh.corners(t).map(|p| p - origin);
        six_volumes[shell] += a.dot(b.cross(c));
        twice_areas[shell] += (b - a).cross(c - a).length();
    }
    (bounds.into_iter().enumerate())
        .map(|(shell, bounds)| {
            let (volume, area) = (six_volumes[shell] / 6.0, twice_areas[shell] / 2.0);
            Shell {
                is_closed: true,
                is_consistent: true,
                facing: facing_of(volume, area, &bounds),
                bounds,
                volume,
            }
        })
        .collect()
}

/// Orientation of a closed surface, unless it is flat.
fn facing_of(volume: f64, area: f64, bounds: &Bounds) -> Option<ShellOrientation> {
    let is_flat = volume.abs() <= FLAT * area * bounds.size().length();
    let facing = if volume > 0.0 {
        ShellOrientation::Out
    } else {
        ShellOrientation::In
    };
    (!is_flat).then_some(facing)
}
