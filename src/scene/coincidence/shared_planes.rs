//! Planes in which faces of several parts lie that face the same way: found here, once, for the reference and all strategies.
//!
//! A pin flush with its plate has two faces in one place, and the depths of both are the same number but for rounding, which every
//! triangle does for itself. So such faces have no depths of their own: a sample of either has the depth of the plane, and of parts
//! at one depth the first in rank is drawn. A plane is that of its largest triangle; others belong to it if all of their vertices are
//! within the tolerance of both parts ([`plane_tolerance`](super::faces_in_plane::plane_tolerance)) and they face the same way.
//!
//! Cost: nothing but a look at pairs of boxes where no boxes of parts overlap; else, for triangles where they do, a sort by area and for
//! each at most 16 cells of [`MOST_IN_CELL`] planes. Kept from frame to frame as long as the parts that are looked at keep their vertices.
//!
//! Cannot: take in parts in a pose or that the device places, slivers, or triangles so small that rounding tilts them; more than
//! [`MOST_MEMBERS`] parts of planes, of which those with the largest triangles count; scenes of more than [`MOST_PARTS`] parts.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};

use crate::scene::{Bounds, PreparedPart, View, longest_edge};

/// Greatest number of parts of planes that are preclassified; with the sides of cuts they fit into the groups of a frame.
const MOST_MEMBERS: usize = 256;

/// Greatest number of parts that are tested for overlap in pairs: each takes a group of a frame, and leaves half of them to preclassified faces.
const MOST_PARTS: usize = 512;

/// Greatest number of planes per cell of normals and offsets, those with the largest triangles: bounds the search on curved
/// and on rough surfaces, where each triangle has a plane of its own.
const MOST_IN_CELL: usize = 64;

/// Cells of a unit normal's component, and of the distance from the origin.
const CELLS: [f64; 2] = [128.0, 512.0];

/// Distance from the border of a cell, in cells, within which the next cell is searched too.
const BESIDE: f64 = 0.25;

/// Triangles whose altitude is no more than this multiple of the tolerance are slivers.
const SLIVER: f64 = 4.0;

/// An eye nearer to a plane than this, in scene units, or a parallel view with so small a sine to it, sees it edge-on.
const EDGE_ON: f64 = 1e-4;

/// A plane with faces of several parts that overlap in it.
#[derive(Clone, Debug)]
pub struct SharedPlane {
    /// The way that the faces face.
    normal: DVec3,
    offset: f64,
    /// The parts, by rank, each with its level: 1 where no later part is in its way.
    levels: Vec<(u16, u16)>,
}

impl SharedPlane {
    /// The value of the depth buffer in a view: how much it changes per pixel to the right and downwards, and what it is in the upper
    /// left corner. None where the plane is seen edge-on.
    pub fn in_view(&self, view: &View) -> Option<[f64; 3]> {
        let buffer = |at: DVec2| {
            let (origin, direction) = view.ray(at);
            let along = self.normal.dot(direction);
            let away = self.offset - self.normal.dot(origin);
            match view.orthographic {
                true => view.buffer_from_depth(away / along),
                false => view.near * along / away,
            }
        };
        let sine = match view.orthographic {
            true => self.normal.dot(view.forward),
            false => self.offset - self.normal.dot(view.eye),
        };
        let corner = buffer(DVec2::ZERO);
        let slopes = [DVec2::X, DVec2::Y].map(|step| buffer(step) - corner);
        (sine.abs() > EDGE_ON).then_some([slopes[0], slopes[1], corner])
    }

    /// The level of a part in the plane: of two that meet in it the nearer has the higher one. 0 of a part that is not in it.
    pub(crate) fn level(&self, rank: usize) -> u16 {
        let at = (self.levels.iter()).find(|(r, _)| usize::from(*r) == rank);
        at.map_or(0, |(_, level)| *level)
    }
}

/// The vertices and the triangles of a part; none of one whose faces are not looked for.
type FoundIn = Option<(Arc<Vec<Vec3>>, Arc<Vec<[u32; 3]>>)>;

/// The planes that parts of a scene share.
#[derive(Clone, Debug, Default)]
pub struct SharedPlanes {
    /// Per part by rank: the input in which they were found.
    meshes: Vec<FoundIn>,
    planes: Vec<SharedPlane>,
    /// By rank: triangles in order, each with the number of its plane.
    faces: Vec<Arc<[(u32, u16)]>>,
}

impl SharedPlanes {
    /// Those of some parts, by rank; those of `before` where nothing has changed.
    pub(crate) fn of(parts: &[PreparedPart], before: Option<&Arc<Self>>) -> Arc<Self> {
        if let Some(before) = before.filter(|b| b.is_of(parts)) {
            return before.clone();
        }
        let mut found = Self {
            meshes: (parts.iter())
                .map(|p| is_looked_at(p).then(|| (p.positions.clone(), p.triangles.clone())))
                .collect(),
            planes: Vec::new(),
            faces: vec![Arc::from([]); parts.len()],
        };
        let near = near_others(parts);
        let mut all: Vec<CandidateFace> = near
            .iter()
            .flat_map(|(rank, room)| faces_within(&parts[*rank], *rank, room))
            .collect();
        all.sort_by(|a, b| b.area.total_cmp(&a.area));
        let mut by_rank: Vec<Vec<(u32, u16)>> = vec![Vec::new(); parts.len()];
        let mut members = 0;
        for (first, faces) in planes_of(&all) {
            let levels = overlapping(faces.iter().map(|f| &all[*f]));
            if levels.is_empty() || members + levels.len() > MOST_MEMBERS {
                continue;
            }
            members += levels.len();
            let number = found.planes.len() as u16;
            let CandidateFace { normal, offset, .. } = all[first];
            let plane = SharedPlane {
                normal,
                offset,
                levels,
            };
            for face in faces.iter().map(|f| &all[*f]) {
                if plane.level(face.rank) > 0 {
                    by_rank[face.rank].push((face.triangle, number));
                }
            }
            found.planes.push(plane);
        }
        for (faces, mut of_rank) in found.faces.iter_mut().zip(by_rank) {
            of_rank.sort_unstable();
            *faces = of_rank.into();
        }
        Arc::new(found)
    }

    fn is_of(&self, parts: &[PreparedPart]) -> bool {
        let is_same = |(p, found): (&PreparedPart, &FoundIn)| match found {
            Some((at, of)) => {
                is_looked_at(p) && Arc::ptr_eq(&p.positions, at) && Arc::ptr_eq(&p.triangles, of)
            }
            None => !is_looked_at(p),
        };
        self.meshes.len() == parts.len() && parts.iter().zip(&self.meshes).all(is_same)
    }

    /// The planes, by number.
    pub fn planes(&self) -> &[SharedPlane] {
        &self.planes
    }

    /// The triangles of a part that lie in some of them, in order, each with the number of the plane.
    pub fn faces(&self, rank: usize) -> Arc<[(u32, u16)]> {
        self.faces.get(rank).cloned().unwrap_or_default()
    }
}

/// A triangle that may lie in the plane of one of another part.
struct CandidateFace {
    rank: usize,
    triangle: u32,
    points: [DVec3; 3],
    normal: DVec3,
    offset: f64,
    area: f64,
    tolerance: f64,
}

impl CandidateFace {
    /// Returns true if this one lies in the plane of another.
    fn lies_in(&self, plane: &Self) -> bool {
        let tolerance = self.tolerance.max(plane.tolerance);
        let height = |p: &DVec3| (p.dot(plane.normal) - plane.offset).abs();
        self.normal.dot(plane.normal) > 0.5 && self.points.iter().all(|p| height(p) <= tolerance)
    }

    /// Its place among the cells.
    fn place(&self) -> [f64; 4] {
        let [x, y, z] = (self.normal * CELLS[0]).to_array();
        [x, y, z, self.offset * CELLS[1]]
    }
}

/// Returns true if boxes have an area in common, or touch along one.
fn meet(a: &Bounds, b: &Bounds, tolerance: f64) -> bool {
    let common = (a.max.min(b.max) - a.min.max(b.min)).to_array();
    common.iter().all(|c| *c >= -tolerance)
        && common.iter().filter(|c| **c > tolerance).count() >= 2
}

/// The pairs of boxes that meet, by their places, of a list in order of their least x.
fn meeting(boxes: &[(Bounds, f64)], mut pair: impl FnMut(usize, usize)) {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|a, b| boxes[*a].0.min.x.total_cmp(&boxes[*b].0.min.x));
    for (at, a) in order.iter().enumerate() {
        let (of_a, tolerance) = &boxes[*a];
        for b in &order[at + 1..] {
            let (of_b, other) = &boxes[*b];
            let tolerance = tolerance.max(*other);
            if of_b.min.x > of_a.max.x + tolerance {
                break;
            }
            if meet(of_a, of_b, tolerance) {
                pair(*a, *b);
            }
        }
    }
}

/// Returns true if the faces of a part are searched, regardless of its cuts, since they may move.
fn is_looked_at(part: &PreparedPart) -> bool {
    !part.is_posed && !part.is_on_device && !part.triangles.is_empty()
}

/// The parts, by rank, whose boxes meet those of others, each with a box that holds where they do.
fn near_others(parts: &[PreparedPart]) -> Vec<(usize, Bounds)> {
    let here: Vec<usize> = (0..parts.len())
        .filter(|r| is_looked_at(&parts[*r]))
        .collect();
    if here.len() > MOST_PARTS {
        return Vec::new();
    }
    let boxes: Vec<(Bounds, f64)> = (here.iter())
        .map(|r| (parts[*r].bounds, parts[*r].plane_tolerance))
        .collect();
    let mut rooms: Vec<Bounds> = vec![Bounds::EMPTY; here.len()];
    meeting(&boxes, |a, b| {
        let room = DVec3::splat(boxes[a].1.max(boxes[b].1));
        let common = Bounds {
            min: boxes[a].0.min.max(boxes[b].0.min) - room,
            max: boxes[a].0.max.min(boxes[b].0.max) + room,
        };
        rooms[a] = rooms[a].union(common);
        rooms[b] = rooms[b].union(common);
    });
    let met = here.into_iter().zip(rooms);
    met.filter(|(_, room)| room.min.x <= room.max.x).collect()
}

/// The triangles of a part that reach into a box, less its slivers.
fn faces_within<'a>(
    part: &'a PreparedPart,
    rank: usize,
    room: &'a Bounds,
) -> impl Iterator<Item = CandidateFace> + 'a {
    let tolerance = part.plane_tolerance;
    (0..)
        .zip(part.triangles.iter())
        .filter_map(move |(triangle, corners)| {
            let points = corners.map(|i| part.positions[i as usize].as_dvec3());
            let own = Bounds::from_points(points);
            let is_within = own.min.cmple(room.max).all() && room.min.cmple(own.max).all();
            let [a, b, c] = points;
            let cross = (b - a).cross(c - a);
            let area = cross.length();
            let normal = cross / area;
            (is_within && area > SLIVER * tolerance * longest_edge(points)).then(|| CandidateFace {
                rank,
                triangle,
                points,
                normal,
                offset: (a + b + c).dot(normal) / 3.0,
                area,
                tolerance,
            })
        })
}

/// Faces that lie in one plane, by the number of the first, which makes it; `all` are in order of area.
fn planes_of(all: &[CandidateFace]) -> Vec<(usize, Vec<usize>)> {
    let mut planes: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut cells: HashMap<[i32; 4], Vec<usize>> = HashMap::new();
    for (number, face) in all.iter().enumerate() {
        let place = face.place();
        let ends = place.map(|c| [c - BESIDE, c + BESIDE].map(|c| c.floor() as i32));
        let near = (0..16_usize).filter_map(|corner| {
            let is_second = |axis: usize| (corner >> axis) & 1 == 1;
            // An axis along which both are one cell is gone along once.
            let is_new = (0..4).all(|i| !is_second(i) || ends[i][0] != ends[i][1]);
            is_new.then(|| [0, 1, 2, 3].map(|i| ends[i][usize::from(is_second(i))]))
        });
        let of_plane = near
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .copied()
            .filter(|plane| face.lies_in(&all[planes[*plane].0]))
            .min();
        match of_plane {
            Some(plane) => planes[plane].1.push(number),
            None => {
                let cell = place.map(|c| c.floor() as i32);
                let of_cell = cells.entry(cell).or_default();
                if of_cell.len() < MOST_IN_CELL {
                    of_cell.push(planes.len());
                    planes.push((number, vec![number]));
                }
            }
        }
    }
    planes
}

/// The parts whose faces of one plane meet those of others, by falling rank, each with its level: one above those that it hides.
fn overlapping<'a>(faces: impl Iterator<Item = &'a CandidateFace>) -> Vec<(u16, u16)> {
    let mut boxes: HashMap<usize, (Bounds, f64)> = HashMap::new();
    for face in faces {
        let of_rank = (boxes.entry(face.rank)).or_insert((Bounds::EMPTY, face.tolerance));
        of_rank.0 = of_rank.0.union(Bounds::from_points(face.points));
    }
    if boxes.len() > MOST_MEMBERS {
        return Vec::new();
    }
    let (ranks, boxes): (Vec<usize>, Vec<(Bounds, f64)>) = boxes.into_iter().unzip();
    let mut pairs: Vec<(u16, u16)> = Vec::new();
    meeting(&boxes, |a, b| {
        let (a, b) = (ranks[a] as u16, ranks[b] as u16);
        pairs.extend([(a, b), (b, a)]);
    });
    pairs.sort_unstable_by(|a, b| b.cmp(a));
    let mut levels: Vec<(u16, u16)> = Vec::new();
    for (rank, other) in pairs {
        // Later parts have their levels already.
        let hidden = levels.iter().find(|(r, _)| other > rank && *r == other);
        let least = hidden.map_or(1, |(_, level)| level + 1);
        match levels.last_mut() {
            Some((last, level)) if *last == rank => *level = least.max(*level),
            _ => levels.push((rank, least)),
        }
    }
    levels
}
