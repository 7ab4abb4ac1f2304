//! Parts that are never cut, but hidden if they lie wholly in the removed region: bolts, pins, shafts. If such a pin stayed visible, it
//! would float in the air in front of the cut.
//!
//! A part is hidden if each of its triangles has all corners in the removed region of one cut; edges may still leave a non-convex cutter
//! between corners. A breakaway does not hide the parts that it shows. Cost: for each such part, classifying corners up to the first
//! triangle that is kept; for a cutter, each corner meets the triangles of one cell of a grid.

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use crate::scene::{Bounds, ClipSurface, Cut, Cutter, Part, Role, Scene};

/// A point closer to a clip-surface than this share of the scene's size lies on it, so that no part of zero thickness is left.
const FLUSH: f64 = 1e-9;

/// Returns true if each triangle of a whole part lies in some cut's removed region. `world` is the result of [`Scene::bounds`], passed in
/// because computing it may read every vertex.
pub(crate) fn is_removed_whole(scene: &Scene, world: &Bounds, part: &Part) -> bool {
    if part.role != Role::Whole {
        return false;
    }
    let hides = |cut: &&Cut| cut.is_on() && cut.names(part) && !cut.shows.contains(&part.name);
    let cuts: Vec<&Cut> = scene.cuts.iter().filter(hides).collect();
    if cuts.is_empty() {
        return false;
    }
    let flush = FLUSH * world.size().length();
    let cuts: Vec<Removed> = (cuts.iter())
        .map(|cut| Removed::of(cut, part, flush))
        .collect();
    let mesh = part.posed_mesh();
    let place = |i: u32| {
        part.world_from_part
            .transform_point3(mesh.positions[i as usize])
    };
    let mut triangles = mesh.triangles.iter().map(|t| t.map(place));
    !mesh.triangles.is_empty()
        && triangles.all(|t| cuts.iter().any(|cut| t.iter().all(|p| cut.holds(*p))))
}

/// Most cells on a side of a cutter's grid.
const MOST_CELLS: usize = 256;

/// Region that a cut removes from a part.
struct Removed {
    surfaces: Vec<ClipSurface>,
    flush: f64,
    cutter: Option<CutterSide>,
}

/// The side of a cutter that is removed: its inside or its outside.
struct CutterSide {
    bounds: Bounds,
    triangles: Vec<[DVec3; 3]>,
    /// Cells on each side of a grid over the bounds, seen along z.
    cells: usize,
    /// Indices of the triangles that may lie in a cell, by row.
    in_cell: Vec<Vec<u32>>,
    keeps_inside: bool,
}

impl Removed {
    fn of(cut: &Cut, part: &Part, flush: f64) -> Self {
        let keeps = cut.offset_for(part);
        Self {
            surfaces: cut.surfaces.iter().map(|s| s.keeping(keeps)).collect(),
            flush,
            cutter: cut.volume.as_ref().map(CutterSide::of),
        }
    }

    fn holds(&self, point: DVec3) -> bool {
        let mut surfaces = self.surfaces.iter();
        surfaces.all(|s| s.kept_height(point) <= self.flush)
            && self
                .cutter
                .as_ref()
                .is_none_or(|cutter| cutter.removes(point))
    }
}

impl CutterSide {
    fn of(cutter: &Cutter) -> Self {
        let mesh = cutter.mesh();
        let place = |i: u32| {
            cutter
                .world_from_cutter
                .transform_point3(mesh.positions[i as usize])
        };
        let cells = mesh.triangles.len().isqrt().clamp(1, MOST_CELLS);
        let mut side = Self {
            bounds: cutter.bounds_in_world(),
            triangles: mesh.triangles.iter().map(|t| t.map(place)).collect(),
            cells,
            in_cell: vec![Vec::new(); cells * cells],
            keeps_inside: cutter.keeps_inside,
        };
        for (index, [a, b, c]) in (0..).zip(&side.triangles) {
            let [first, last] = [a.min(*b).min(*c), a.max(*b).max(*c)].map(|p| side.cell(p));
            for y in first[1]..=last[1] {
                for x in first[0]..=last[0] {
                    side.in_cell[y * cells + x].push(index);
                }
            }
        }
        side
    }

    /// Column and row of a point's cell. They do not decrease along x and y.
    fn cell(&self, point: DVec3) -> [usize; 2] {
        let share = (point - self.bounds.min) / self.bounds.size();
        [share.x, share.y].map(|share| ((share * self.cells as f64) as usize).min(self.cells - 1))
    }

    fn removes(&self, point: DVec3) -> bool {
        let is_near = point.cmpge(self.bounds.min).all() && point.cmple(self.bounds.max).all();
        (is_near && self.holds(point)) != self.keeps_inside
    }

    /// Returns true if a ray along z from the point crosses the cutter an odd number of times.
    fn holds(&self, point: DVec3) -> bool {
        let crosses = |[a, b, c]: &&[DVec3; 3]| {
            let side = |p: DVec3, q: DVec3| side_of(p.truncate(), q.truncate(), point.truncate());
            let sides = [side(*a, *b), side(*b, *c), side(*c, *a)];
            if sides != [true; 3] && sides != [false; 3] {
                return false;
            }
            let normal = (b - a).cross(c - a);
            // True if the plane is above the point, measured along z.
            normal.z != 0.0 && (a - point).dot(normal) / normal.z > 0.0
        };
        let [x, y] = self.cell(point);
        let near = self.in_cell[y * self.cells + x].iter();
        let crossed = near.map(|i| &self.triangles[*i as usize]).filter(crosses);
        crossed.count() % 2 == 1
    }
}

/// The side of an edge that a point is on, the same for both triangles of the edge; points on the edge count as on one side.
fn side_of(from: DVec2, to: DVec2, point: DVec2) -> bool {
    let is_turned = (to.x, to.y) < (from.x, from.y);
    let (first, last) = if is_turned { (to, from) } else { (from, to) };
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    (orient2d(coord(first), coord(last), coord(point)) >= 0.0) != is_turned
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::shapes::shape;
    use glam::DAffine3;

    fn cube_at(x: f64) -> Part {
        let mut part = shape("cube").unwrap_or_else(|e| panic!("{e}"))[0].clone();
        part.role = Role::Whole;
        part.world_from_part = DAffine3::from_translation(DVec3::X * x);
        part
    }

    #[test]
    fn what_is_kept_in_the_middle_stays_and_what_touches_a_cut_goes() {
        let cut = |x: f64, keeps: f64| {
            Cut::new(
                "cut",
                vec![ClipSurface::plane(DVec3::X * x, DVec3::X * keeps)],
            )
        };
        let mut scene = Scene {
            cuts: vec![cut(-1.0, 1.0), cut(1.0, -1.0)],
            ..Scene::default()
        };
        let mut pin = cube_at(0.0);
        pin.world_from_part = DAffine3::from_scale(DVec3::new(6.0, 0.2, 0.2));
        assert!(
            !is_removed_whole(&scene, &scene.bounds(), &pin),
            "its middle is kept"
        );
        // A face of the cube lies in the plane.
        scene.cuts = vec![cut(0.5, 1.0)];
        scene.parts = vec![cube_at(0.0)];
        assert!(
            is_removed_whole(&scene, &scene.bounds(), &cube_at(0.0)),
            "nothing without thickness is left"
        );
        scene.cuts[0].shows = vec![cube_at(0.0).name];
        assert!(
            !is_removed_whole(&scene, &scene.bounds(), &cube_at(0.0)),
            "it is what an opening shows"
        );
    }

    #[test]
    fn a_cell_of_the_grid_has_all_triangles_that_a_ray_can_cross() {
        let torus = shape("torus?segments=40&sides=20").unwrap_or_else(|e| panic!("{e}"));
        let mut torus = Cutter::from_parts("torus", &torus).unwrap_or_else(|e| panic!("{e}"));
        for turn in [0.0, 0.7] {
            torus.world_from_cutter = DAffine3::from_rotation_x(turn);
            let side = CutterSide::of(&torus);
            assert!(side.cells > 10);
            let brute_force = CutterSide {
                cells: 1,
                in_cell: vec![(0..side.triangles.len() as u32).collect()],
                ..CutterSide::of(&torus)
            };
            // Its vertices, whose rays meet edges, and points around them.
            let vertices = side.triangles.iter().flatten();
            let around = vertices.flat_map(|p| [*p, *p * 0.95, *p + DVec3::Z * 0.1]);
            let points: Vec<DVec3> = around.collect();
            let held = points.iter().filter(|p| side.holds(**p)).count();
            assert!(held > 100 && held < points.len(), "the control: {held}");
            for point in points {
                assert_eq!(side.holds(point), brute_force.holds(point), "{point}");
            }
        }
    }

    #[test]
    fn what_lies_wholly_in_what_is_removed_is_hidden() {
        let plane = Cut::new("plane", vec![ClipSurface::plane(DVec3::ZERO, DVec3::X)]);
        let ball = shape("sphere").unwrap_or_else(|e| panic!("{e}"));
        let mut ball = Cutter::from_parts("ball", &ball).unwrap_or_else(|e| panic!("{e}"));
        ball.world_from_cutter = DAffine3::from_scale_rotation_translation(
            DVec3::splat(4.0),
            glam::DQuat::IDENTITY,
            DVec3::X * 10.0,
        );
        let scene = Scene {
            cuts: vec![plane, Cut::by(ball)],
            ..Scene::default()
        };
        for (x, is_hidden) in [
            (-3.0, true),
            (0.0, false),
            (3.0, false),
            (10.0, true),
            (14.0, false),
        ] {
            let part = cube_at(x);
            assert_eq!(
                is_removed_whole(&scene, &scene.bounds(), &part),
                is_hidden,
                "at {x}"
            );
            let exterior = Part {
                role: Role::Exterior,
                ..part
            };
            assert!(
                !is_removed_whole(&scene, &scene.bounds(), &exterior),
                "it is cut"
            );
        }
    }
}
