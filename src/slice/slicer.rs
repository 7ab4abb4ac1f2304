//! A mesh prepared for repeated cuts, and a single cut of it.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::by_winding;
use super::fill::{Filled, fill};
use super::in_world::in_world;
use super::loops::{Curves, CutSegment, join};
use super::plane::is_within;
use super::{Loop, Section, SectionDefect, SlicePlane};
use crate::scene::meshes::tree::{BRANCHES, Tree, sort};
use crate::scene::winding::CentredTree;
use crate::scene::{Bounds, Candidates, FacesInPlane, Fill, Part, SceneSpace, Side, tolerance_of};

/// A mesh with a bounding tree of its triangles. Building it visits every triangle, a section only those near the plane.
#[derive(Debug)]
pub struct Slicer {
    positions: Arc<Vec<DVec3>>,
    /// Usable triangles, in the order of the tree.
    triangles: Vec<[u32; 3]>,
    tree: Tree,
    /// Number of triangles left out.
    unusable: usize,
    /// Space in which faces are found to lie in a plane, with the tolerance for their vertices; without it only vertices exactly on a plane
    /// count as on it.
    scene: Option<(SceneSpace, f64)>,
    /// Made when a section has open curves that winding numbers are to close.
    winding: OnceLock<CentredTree>,
}

/// Elements that a plane crosses, and the faces that lie in the plane.
struct PlaneCrossing<'a> {
    slicer: &'a Slicer,
    plane: &'a SlicePlane,
    in_plane: FacesInPlane,
}

impl Slicer {
    /// Prepares a mesh. Any triangles are accepted: those that cannot be used are left out, and every section reports them.
    pub fn new(positions: impl Into<Arc<Vec<DVec3>>>, triangles: &[[u32; 3]]) -> Self {
        let positions = positions.into();
        let is_usable = |t: &[u32; 3]| {
            t.iter()
                .all(|i| positions.get(*i as usize).is_some_and(|p| is_within(*p)))
        };
        let mut usable: Vec<[u32; 3]> = triangles
            .par_iter()
            .copied()
            .filter(|t| is_usable(t))
            .collect();
        sort(&positions, &mut usable);
        Self {
            tree: Tree::over(&positions, &usable),
            unusable: triangles.len() - usable.len(),
            triangles: usable,
            positions,
            scene: None,
            winding: OnceLock::new(),
        }
    }

    /// Prepares a part as placed in the world, in its pose.
    pub fn of_part(part: &Part) -> Self {
        let mesh = in_world(&part.posed_mesh(), &part.world_from_part);
        Self::new(mesh.positions, &mesh.triangles)
    }

    /// [`Slicer::of_part`], but the faces that lie in a plane are those that lie in it when the scene is drawn: vertices of a planar
    /// face may be some `f32` steps off the plane.
    pub fn of_part_in(part: &Part, space: &SceneSpace) -> Self {
        let tolerance = tolerance_of(part, &part.mesh.bounds(), space);
        Self::of_part(part).in_scene(*space, tolerance)
    }

    /// The same slicer, but faces within a tolerance of a plane in scene space count as lying in the plane.
    pub(crate) fn in_scene(self, space: SceneSpace, tolerance: f64) -> Self {
        Self {
            scene: Some((space, tolerance)),
            ..self
        }
    }

    /// The section by a plane: the points enclosed by an odd number of crossings.
    pub fn section(&self, plane: &SlicePlane) -> Section {
        self.section_by(plane, Fill::EvenOdd)
    }

    /// The section by a plane: the points that the mesh encloses according to a fill rule.
    pub fn section_by(&self, plane: &SlicePlane, rule: Fill) -> Section {
        let is_decided = self.scene.is_some();
        self.filled(plane, rule, |cut| {
            if is_decided {
                cut.in_plane = self.faces_in(plane);
            }
            cut.pieces()
        })
    }

    /// The section by a plane, even where the mesh is open: there the region is where the mesh's generalised winding number (Jacobson,
    /// Kavan, Sorkine-Hornung 2013), rounded, is inside by the fill rule. Its outline is in `loops`, and [`Section::bridges`] are the
    /// straight lines that complete it where curves end. If all curves close, the section is that of [`Slicer::section_by`].
    ///
    /// The region does not leave the convex hull of the curves. Faces that are turned inside out count against the others, so this is
    /// for meshes that are open, not for those whose faces disagree.
    pub fn section_by_winding(&self, plane: &SlicePlane, rule: Fill) -> Section {
        let section = self.section_by(plane, rule);
        if section.open.is_empty() {
            return section;
        }
        let tree = (self.winding).get_or_init(|| CentredTree::of(&self.positions, &self.triangles));
        by_winding::closed(section, plane, tree, rule)
    }

    /// Cap by a plane: the section minus the faces that lie in it with the solid above them, because there the face itself
    /// is visible.
    pub fn cap_by(&self, plane: &SlicePlane, rule: Fill) -> Section {
        self.filled(plane, rule, |cut| {
            cut.in_plane = self.faces_in(plane);
            let mut pieces = cut.pieces();
            pieces.extend(cut.rims_of_faces());
            pieces
        })
    }

    fn filled(
        &self,
        plane: &SlicePlane,
        rule: Fill,
        pieces_of: impl FnOnce(&mut PlaneCrossing<'_>) -> Vec<CutSegment>,
    ) -> Section {
        let mut section = Section::default();
        if self.unusable > 0 {
            section.defects.push(SectionDefect::Unusable {
                triangles: self.unusable,
            });
        }
        if !plane.is_usable() {
            section.defects.push(SectionDefect::Plane);
            return section;
        }
        let mut cut = PlaneCrossing {
            slicer: self,
            plane,
            in_plane: FacesInPlane::default(),
        };
        let pieces = pieces_of(&mut cut);
        let Curves {
            points,
            loops,
            open,
            turned,
        } = join(&pieces, |edge| cut.crossing(edge));
        let Filled {
            added,
            triangles,
            boundary,
            left_out,
            ..
        } = fill(&points, &loops, |winding| rule.holds(winding));

        let at = |p: DVec2| plane.point(p);
        let mut tell = |defect| section.defects.push(defect);
        if let Some(end) = open.first().and_then(|chain| chain.first()) {
            tell(SectionDefect::Open {
                chains: open.len(),
                at: at(points[*end as usize]),
            });
        }
        if turned > 0 {
            tell(SectionDefect::Turned { pieces: turned });
        }
        if let Some(first) = added.first() {
            tell(SectionDefect::Crossing {
                crossings: added.len(),
                at: at(*first),
            });
        }
        if let Some(first) = left_out.first() {
            tell(SectionDefect::LeftOut {
                loops: left_out.len(),
                at: at(points[loops[*first][0] as usize]),
            });
        }
        section.points = points;
        section.points.extend(added);
        section.loops = loops.into_iter().map(|points| Loop { points }).collect();
        section.open = open;
        section.triangles = triangles;
        section.boundary = boundary;
        section
    }

    /// The faces that lie in a plane.
    fn faces_in(&self, plane: &SlicePlane) -> FacesInPlane {
        let tolerance = self.scene.map_or(0.0, |(_, tolerance)| tolerance);
        let flat = match &self.scene {
            Some((space, _)) => space.flat(&plane.flat()),
            None => plane.flat(),
        };
        let is_near = |t: &u32| {
            let corners = self.triangles[*t as usize];
            let mut heights = corners.iter().map(|i| flat.height(self.in_scene_space(*i)));
            heights.all(|h| h.abs() <= tolerance)
        };
        let groups = self.groups_near(plane);
        let near = groups.par_iter().with_min_len(256).flat_map_iter(|group| {
            let first = group * BRANCHES;
            let last = (first + BRANCHES).min(self.triangles.len());
            (first as u32..last as u32).filter(is_near)
        });
        flat.faces_in(Candidates {
            triangles: &self.triangles,
            position: |i| self.in_scene_space(i),
            near: near.collect(),
            tolerance,
            is_inside_out: &|| self.volume_sign() < 0.0,
        })
    }

    /// Position of a vertex in the space in which faces are tested.
    fn in_scene_space(&self, vertex: u32) -> DVec3 {
        let position = self.positions[vertex as usize];
        match &self.scene {
            Some((space, _)) => space.vertex(position).as_dvec3(),
            None => position,
        }
    }

    /// A number with the sign of the volume that the mesh encloses.
    fn volume_sign(&self) -> f64 {
        let volumes = self.triangles.par_iter().map(|t| {
            let [a, b, c] = t.map(|i| self.positions[i as usize]);
            a.dot(b.cross(c))
        });
        volumes.sum()
    }

    /// The groups of the tree in which a plane may cross triangles, or contain faces.
    fn groups_near(&self, plane: &SlicePlane) -> Vec<usize> {
        let margin = (self.scene.as_ref()).map_or(0.0, |(space, t)| 2.0 * t / space.scale);
        self.tree.groups(|b: &Bounds| plane.misses(b, margin))
    }
}

impl PlaneCrossing<'_> {
    fn position(&self, vertex: u32) -> DVec3 {
        self.slicer.positions[vertex as usize]
    }

    /// Returns true if a vertex is on the plane because it belongs to a face in the plane.
    fn is_of_face(&self, vertex: u32) -> bool {
        !self.in_plane.is_empty() && self.in_plane.holds(self.slicer.in_scene_space(vertex))
    }

    fn is_above(&self, vertex: u32) -> bool {
        self.plane.is_above(self.position(vertex)) && !self.is_of_face(vertex)
    }

    /// Distance of a vertex from the plane.
    fn distance(&self, vertex: u32) -> f64 {
        match self.is_of_face(vertex) {
            true => 0.0,
            false => self.plane.height(self.position(vertex)).abs(),
        }
    }

    /// The pieces from the crossed triangles, in the order of the tree.
    fn pieces(&self) -> Vec<CutSegment> {
        let groups = self.slicer.groups_near(self.plane);
        let of_group = |group: &usize| {
            let first = group * BRANCHES;
            let last = (first + BRANCHES).min(self.slicer.triangles.len());
            let triangles = self.slicer.triangles[first..last].iter();
            triangles.filter_map(|t| self.piece(*t))
        };
        groups
            .par_iter()
            .with_min_len(256)
            .flat_map_iter(of_group)
            .collect()
    }

    /// From the edge where a triangle, in vertex order, descends through the plane, to the edge where it ascends: inside is on the left.
    fn piece(&self, triangle: [u32; 3]) -> Option<CutSegment> {
        let above = triangle.map(|i| self.is_above(i));
        if above[0] == above[1] && above[1] == above[2] {
            return None;
        }
        let [mut down, mut up] = [[0; 2]; 2];
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let edge = [triangle[i], triangle[j]];
            match (above[i], above[j]) {
                (true, false) => down = edge,
                (false, true) => up = edge,
                _ => {}
            }
        }
        let [from, to] = [down, up].map(|[a, b]| [a.min(b), a.max(b)]);
        // A triangle that has a vertex twice descends and ascends in the same edge, and joins nothing.
        (from != to).then_some(CutSegment { from, to })
    }

    /// Boundaries of the faces in the plane with the solid above them: the winding number within them is one less.
    fn rims_of_faces(&self) -> Vec<CutSegment> {
        let above = (self.in_plane.faces().iter()).filter(|(_, side)| *side == Side::Kept);
        let mut count: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for (triangle, _) in above {
            let [a, b, c] = self.slicer.triangles[*triangle as usize];
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let way = if from < to { 1 } else { -1 };
                *count.entry([from.min(to), from.max(to)]).or_default() += way;
            }
        }
        let pieces = count.into_iter().flat_map(|([low, high], net)| {
            let [from, to] = if net > 0 { [low, high] } else { [high, low] };
            let piece = CutSegment {
                from: [from, from],
                to: [to, to],
            };
            std::iter::repeat_n(piece, net.unsigned_abs() as usize)
        });
        pieces.collect()
    }

    /// Intersection of a crossed edge and the plane. Computed from the lesser end, so that edges whose coordinates are
    /// all equal give equal points.
    fn crossing(&self, edge: [u32; 2]) -> DVec2 {
        let [mut a, mut b] = edge;
        if self.position(b).to_array() < self.position(a).to_array() {
            (a, b) = (b, a);
        }
        let [height_a, height_b] = [a, b].map(|v| self.distance(v));
        let [at_a, at_b] = [a, b].map(|v| self.plane.coordinates(self.position(v)));
        // Fractions of the way from either end: at most 1, and exactly 0 if that end is on the plane. Measured from the nearer end.
        let at = if height_a <= height_b {
            at_a + (at_b - at_a) * share(height_a, height_b)
        } else {
            at_b + (at_a - at_b) * share(height_b, height_a)
        };
        // Adding zero turns -0 into +0, so that equality and order agree.
        at.clamp(at_a.min(at_b), at_a.max(at_b)) + DVec2::ZERO
    }
}

/// `near / (near + far)`, even if the sum would overflow; 0 for two zeros.
pub(super) fn share(near: f64, far: f64) -> f64 {
    if near == 0.0 {
        0.0
    } else {
        1.0 / (1.0 + far / near)
    }
}
