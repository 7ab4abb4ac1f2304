//! Planes that contain equally oriented faces of several parts: found here, once, for the reference and all strategies.
//!
//! A pin flush with its plate has a face coplanar with the plate's, and the depths of both are equal except for rounding, which differs
//! per triangle. So such faces have no depths of their own: samples of both have the plane's depth, and among parts at the same depth
//! the one that ranks first is drawn. The largest triangle defines a plane; others belong to it if all of their vertices are within the
//! tolerance of both parts ([`plane_tolerance`](super::faces_in_plane::plane_tolerance)) and they face the same way.
//!
//! Cost: a test of box pairs. If boxes overlap, the triangles in the overlaps are also sorted by area, and each searches at most 16 cells
//! with up to [`MOST_IN_CELL`] planes each. Results are reused between frames as long as the searched parts keep their vertices.
//!
//! Cannot: include posed parts, parts that the device places, slivers, or triangles so small that rounding tilts them; more than
//! [`MOST_MEMBERS`] plane members (those with the largest triangles are kept); scenes with more than [`MOST_PARTS`] parts.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3};

use crate::scene::{Bounds, PreparedPart, View, longest_edge};

/// Maximum number of preclassified plane members (pairs of part and plane); with the sides of cuts they fit into a frame's groups.
const MOST_MEMBERS: usize = 256;

/// Maximum number of parts tested for overlap in pairs: each takes one of a frame's groups, and half remain for preclassified faces.
const MOST_PARTS: usize = 512;

/// Maximum number of planes per cell of normals and offsets; those with the largest triangles are kept. It limits the search on
/// curved and rough surfaces, where each triangle has its own plane.
const MOST_IN_CELL: usize = 64;

/// Cells per unit, for components of the unit normal and for the distance from the origin.
const CELLS: [f64; 2] = [128.0, 512.0];

/// Distance from the border of a cell, in cells, within which the next cell is searched too.
const BESIDE: f64 = 0.25;

/// Triangles whose altitude is no more than this multiple of the tolerance are slivers.
const SLIVER: f64 = 4.0;

/// A plane is seen edge-on if the eye is nearer to it than this, in scene units, or if the sine of its angle to a parallel view is.
const EDGE_ON: f64 = 1e-4;

/// A plane with faces of several parts that overlap in it.
#[derive(Clone, Debug)]
pub struct SharedPlane {
    /// The normal of the faces.
    normal: DVec3,
    offset: f64,
    /// The parts by rank, each with its level: 1 if the part hides no later part.
    levels: Vec<(u16, u16)>,
}

impl SharedPlane {
    /// The depth-buffer value of the plane in a view, as its change per pixel to the right, its change per pixel downwards, and its value
    /// in the upper left corner. `None` if the plane is seen edge-on.
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

    /// The level of a part in the plane: of two parts that overlap in it, the nearer has the higher level. 0 if the part is not in it.
    pub(crate) fn level(&self, rank: usize) -> u16 {
        let at = (self.levels.iter()).find(|(r, _)| usize::from(*r) == rank);
        at.map_or(0, |(_, level)| *level)
    }
}

/// The vertices and triangles of a part; `None` for parts that are not searched.
type FoundIn = Option<(Arc<Vec<Vec3>>, Arc<Vec<[u32; 3]>>)>;

/// The planes that parts of a scene share.
#[derive(Clone, Debug, Default)]
pub struct SharedPlanes {
    /// Per part, in rank order: the mesh data in which the planes were found.
    meshes: Vec<FoundIn>,
    planes: Vec<SharedPlane>,
    /// Per part, in rank order: its triangles in shared planes, in index order, each with the number of its plane.
    faces: Vec<Arc<[(u32, u16)]>>,
}

impl SharedPlanes {
    /// Finds the shared planes of parts, given by rank; reuses `before` if nothing has changed.
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

    /// The triangles of a part that lie in shared planes, in order, each with its plane's number.
    pub fn faces(&self, rank: usize) -> Arc<[(u32, u16)]> {
        self.faces.get(rank).cloned().unwrap_or_default()
    }
}

/// A triangle that may be coplanar with a triangle of another part.
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
    /// Returns true if this face lies in the plane of the face `plane`.
    fn lies_in(&self, plane: &Self) -> bool {
        let tolerance = self.tolerance.max(plane.tolerance);
        let height = |p: &DVec3| (p.dot(plane.normal) - plane.offset).abs();
        self.normal.dot(plane.normal) > 0.5 && self.points.iter().all(|p| height(p) <= tolerance)
    }

    /// The components of its normal and its distance from the origin, in cells.
    fn place(&self) -> [f64; 4] {
        let [x, y, z] = (self.normal * CELLS[0]).to_array();
        [x, y, z, self.offset * CELLS[1]]
    }
}

/// Returns true if two boxes overlap, or touch in more than an edge or a corner.
fn meet(a: &Bounds, b: &Bounds, tolerance: f64) -> bool {
    let common = (a.max.min(b.max) - a.min.max(b.min)).to_array();
    common.iter().all(|c| *c >= -tolerance)
        && common.iter().filter(|c| **c > tolerance).count() >= 2
}

/// Calls `pair` with the indices of every two boxes that meet; the search sorts the boxes by minimum x.
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

/// Returns true if the part's faces are searched. Its cuts play no role, since they may move.
fn is_looked_at(part: &PreparedPart) -> bool {
    !part.is_posed && !part.is_on_device && !part.triangles.is_empty()
}

/// The ranks of parts whose boxes meet other parts' boxes, each with a box around its overlaps.
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

/// The triangles of a part that reach into a box, without slivers.
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

/// Groups faces by plane, each group with the index of the face that defines the plane; `all` must be sorted by area.
fn planes_of(all: &[CandidateFace]) -> Vec<(usize, Vec<usize>)> {
    let mut planes: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut cells: HashMap<[i32; 4], Vec<usize>> = HashMap::new();
    for (number, face) in all.iter().enumerate() {
        let place = face.place();
        let ends = place.map(|c| [c - BESIDE, c + BESIDE].map(|c| c.floor() as i32));
        let near = (0..16_usize).filter_map(|corner| {
            let is_second = |axis: usize| (corner >> axis) & 1 == 1;
            // If both ends of an axis are in the same cell, that cell is searched once.
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

/// The parts whose faces in one plane overlap those of others, by descending rank, each with its level: 1 above the parts it hides.
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
        // Levels of later parts are already known.
        let hidden = levels.iter().find(|(r, _)| other > rank && *r == other);
        let least = hidden.map_or(1, |(_, level)| level + 1);
        match levels.last_mut() {
            Some((last, level)) if *last == rank => *level = least.max(*level),
            _ => levels.push((rank, least)),
        }
    }
    levels
}
