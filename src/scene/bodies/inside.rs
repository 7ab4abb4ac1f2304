//! Finds the closed shells that contain a shell.
//!
//! A ray along x starts at a vertex of the inner shell. The vertex is inside the outer shell if the ray's signed crossings (exits minus
//! entries) do not sum to 0 or, if the outer shell's orientation is inconsistent, if their number is odd. Every sign is exact ([`robust`]);
//! a ray through an edge passes on the side of larger z, or else of larger y, so each crossing counts exactly once. A vertex on the outer
//! shell is undecided. Only some vertices are tested; one vertex outside rules out containment, since shells that touch or cross do not
//! contain each other.
//!
//! Cost: one bounding-box tree over the triangles of closed shells; each ray tests the boxes that it hits, and the triangles in their
//! leaves.

use glam::DVec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

use super::super::{Bounds, Mesh};
use super::shells::Shells;
use crate::scene::meshes::tree::{BRANCHES, Tree, order};

/// Number of vertices tested per shell; they are spread over its triangles.
const ASKED: usize = 8;

/// Closed shells, prepared for containment tests.
pub(super) struct Insides<'a> {
    mesh: &'a Mesh,
    shells: &'a Shells,
    /// [`ASKED`] triangles of each shell.
    asked: Vec<[u32; ASKED]>,
    /// Triangles of closed shells, in tree order.
    triangles: Vec<u32>,
    tree: Tree,
}

/// Position of a point that is not outside a closed shell.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ShellPosition {
    Within,
    On,
}

/// Intersection of a ray with a shell.
struct ShellHit {
    shell: u32,
    /// Direction of the crossing; 0 where the point is on the shell.
    step: i32,
}

impl<'a> Insides<'a> {
    pub(super) fn of(mesh: &'a Mesh, shells: &'a Shells) -> Self {
        let is_closed = |t: &usize| shells.shells[shells.of_triangles[*t] as usize].is_closed;
        let closed: Vec<u32> = (0..mesh.triangles.len())
            .filter(is_closed)
            .map(|t| t as u32)
            .collect();
        let corners = |numbers: &[u32]| -> Vec<[u32; 3]> {
            let of = |t: &u32| mesh.triangles[*t as usize];
            numbers.iter().map(of).collect()
        };
        let order = order(&mesh.positions, &corners(&closed));
        let triangles: Vec<u32> = order.into_iter().map(|i| closed[i as usize]).collect();
        Self {
            tree: Tree::over(&mesh.positions, &corners(&triangles)),
            asked: asked(shells),
            mesh,
            shells,
            triangles,
        }
    }

    /// The smallest closed shell that wholly contains the given closed shell.
    pub(super) fn smallest_around(&self, shell: u32) -> Option<u32> {
        let all = &self.shells.shells;
        let inner = &all[shell as usize];
        if !inner.is_closed {
            return None;
        }
        let mut left: Option<Vec<(u32, ShellPosition)>> = None;
        for triangle in self.asked[shell as usize] {
            let [vertex, ..] = self.mesh.triangles[triangle as usize];
            let mut places = self.places(self.mesh.positions[vertex as usize], shell);
            match &mut left {
                None => {
                    places.retain(|(outer, _)| {
                        let outer = &all[*outer as usize];
                        holds(&outer.bounds, &inner.bounds) && inner.by_size(outer).is_lt()
                    });
                    left = Some(places);
                }
                Some(left) => left.retain_mut(|(outer, place)| {
                    let now = places.iter().find(|(other, _)| other == outer);
                    if let Some((_, ShellPosition::Within)) = now {
                        *place = ShellPosition::Within;
                    }
                    now.is_some()
                }),
            }
            if left.as_ref().is_some_and(Vec::is_empty) {
                return None;
            }
        }
        let within = left.into_iter().flatten();
        let within = within.filter(|(_, place)| *place == ShellPosition::Within);
        within
            .map(|(outer, _)| outer)
            .min_by(|a, b| all[*a as usize].by_size(&all[*b as usize]).then(a.cmp(b)))
    }

    /// All closed shells except `but` that a point is inside or on.
    fn places(&self, point: DVec3, but: u32) -> Vec<(u32, ShellPosition)> {
        let beside = |b: &Bounds| {
            let (y, z) = (point.y, point.z);
            b.min.y > y || b.max.y < y || b.min.z > z || b.max.z < z || b.max.x < point.x
        };
        let mut found: Vec<ShellHit> = Vec::new();
        for group in self.tree.groups(beside) {
            let end = self.triangles.len().min((group + 1) * BRANCHES);
            for triangle in &self.triangles[group * BRANCHES..end] {
                let shell = self.shells.of_triangles[*triangle as usize];
                let corners = self.mesh.corners(*triangle as usize);
                let bounds = Bounds::from_points(corners);
                if shell == but || beside(&bounds) {
                    continue;
                }
                if point.x >= bounds.min.x && is_on(point, corners) {
                    found.push(ShellHit { shell, step: 0 });
                } else if let Some(step) = crossing(point, corners) {
                    found.push(ShellHit { shell, step });
                }
            }
        }
        found.sort_by_key(|f| f.shell);
        let of_shells = found.chunk_by(|a, b| a.shell == b.shell);
        let place = |found: &[ShellHit]| {
            let shell = found[0].shell;
            if found.iter().any(|f| f.step == 0) {
                return Some((shell, ShellPosition::On));
            }
            let is_in = match self.shells.shells[shell as usize].is_consistent {
                true => found.iter().map(|f| f.step).sum::<i32>() != 0,
                false => found.len() % 2 == 1,
            };
            is_in.then_some((shell, ShellPosition::Within))
        };
        of_shells.filter_map(place).collect()
    }
}

/// Triangles of each shell, evenly spread over it.
fn asked(shells: &Shells) -> Vec<[u32; ASKED]> {
    let mut counts = vec![0_usize; shells.shells.len()];
    for shell in &shells.of_triangles {
        counts[*shell as usize] += 1;
    }
    let mut asked = vec![[0; ASKED]; counts.len()];
    let mut passed = vec![0_usize; counts.len()];
    for (triangle, shell) in (0..).zip(&shells.of_triangles) {
        let shell = *shell as usize;
        // Index of the first slot of each triangle; in a small shell, several slots share a triangle.
        let place = |triangles: usize| (triangles * ASKED).div_ceil(counts[shell]);
        asked[shell][place(passed[shell])..place(passed[shell] + 1)].fill(triangle);
        passed[shell] += 1;
    }
    asked
}

fn holds(outer: &Bounds, inner: &Bounds) -> bool {
    outer.min.cmple(inner.min).all() && outer.max.cmpge(inner.max).all()
}

/// Direction in which the ray along x from a point crosses a triangle: 1 towards the triangle's outer side, -1 towards its inner side.
fn crossing(point: DVec3, corners: [DVec3; 3]) -> Option<i32> {
    let across = |p: DVec3| Coord { x: p.y, y: p.z };
    let mut turns = 0;
    for [from, to] in sides(corners) {
        let is_up = from.z <= point.z && point.z < to.z;
        let is_down = to.z <= point.z && point.z < from.z;
        if !(is_up || is_down) {
            continue;
        }
        // Evaluated from the side's lower end, so that the two triangles that share this side compute the same sign.
        let (low, high) = if is_up { (from, to) } else { (to, from) };
        if orient2d(across(low), across(high), across(point)) > 0.0 {
            turns += if is_up { 1 } else { -1 };
        }
    }
    if turns == 0 {
        return None;
    }
    let is_ahead = behind(point, corners) * f64::from(turns) > 0.0;
    is_ahead.then_some(turns)
}

/// Returns true if a point is on a triangle, its border included.
fn is_on(point: DVec3, corners: [DVec3; 3]) -> bool {
    if behind(point, corners) != 0.0 {
        return false;
    }
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).abs();
    let flat = |p: DVec3| match normal.max_position() {
        0 => Coord { x: p.y, y: p.z },
        1 => Coord { x: p.z, y: p.x },
        _ => Coord { x: p.x, y: p.y },
    };
    let signs = sides(corners).map(|[from, to]| orient2d(flat(from), flat(to), flat(point)));
    signs.iter().all(|s| *s >= 0.0) || signs.iter().all(|s| *s <= 0.0)
}

/// Positive if a point is behind a triangle, negative if it is in front, 0 if it is in the triangle's plane.
fn behind(point: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c, p] = [corners[0], corners[1], corners[2], point].map(|p| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    orient3d(a, b, c, p)
}

fn sides([a, b, c]: [DVec3; 3]) -> [[DVec3; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}
