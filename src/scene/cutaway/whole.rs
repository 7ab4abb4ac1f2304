//! Parts that are never cut, and hidden where all of them lies in what is removed: bolts, pins, shafts. A pin that is spared would stand in the
//! air before the cut.
//!
//! Cost: for each such part the sides of its vertices, up to the first that is kept.

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use crate::scene::{Bounds, Cut, Cutter, Part, Role, Scene};

/// Whether cuts remove every vertex of a part that is whole.
pub(crate) fn is_removed_whole(scene: &Scene, part: &Part) -> bool {
    if part.role != Role::Whole {
        return false;
    }
    let cuts: Vec<Removed<'_>> = (scene.cuts.iter())
        .filter(|cut| cut.is_on() && cut.names(part))
        .map(|cut| Removed::of(cut, part))
        .collect();
    let mut points = part.points_in_world().peekable();
    !cuts.is_empty()
        && points.peek().is_some()
        && points.all(|p| cuts.iter().any(|cut| cut.holds(p)))
}

/// What a cut removes of a part.
struct Removed<'a> {
    cut: &'a Cut,
    keeps: f64,
    bounds: Option<Bounds>,
}

impl<'a> Removed<'a> {
    fn of(cut: &'a Cut, part: &Part) -> Self {
        Self {
            cut,
            keeps: cut.offset_for(part),
            bounds: cut.volume.as_ref().map(Cutter::bounds_in_world),
        }
    }

    fn holds(&self, point: DVec3) -> bool {
        let mut surfaces = self.cut.surfaces.iter();
        surfaces.all(|s| s.keeping(self.keeps).kept_height(point) < 0.0)
            && match (&self.cut.volume, &self.bounds) {
                (Some(cutter), Some(bounds)) => {
                    let near = point.cmpge(bounds.min).all() && point.cmple(bounds.max).all();
                    (near && is_inside(cutter, point)) != cutter.keeps_inside
                }
                _ => true,
            }
    }
}

/// Whether a ray along z crosses a cutter an odd number of times.
fn is_inside(cutter: &Cutter, point: DVec3) -> bool {
    let mesh = cutter.mesh();
    let place = |i: u32| {
        cutter
            .world_from_cutter
            .transform_point3(mesh.positions[i as usize])
    };
    let crosses = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(place);
        let side = |p: DVec3, q: DVec3| side_of(p.truncate(), q.truncate(), point.truncate());
        let sides = [side(a, b), side(b, c), side(c, a)];
        if sides != [true; 3] && sides != [false; 3] {
            return false;
        }
        let normal = (b - a).cross(c - a);
        // Above the point: along z to the plane.
        normal.z != 0.0 && (a - point).dot(normal) / normal.z > 0.0
    };
    mesh.triangles.iter().filter(crosses).count() % 2 == 1
}

/// On which side of an edge a point is, the same for both triangles of the edge; points on it lie to one side of it.
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
    use crate::scene::ClipSurface;
    use glam::DAffine3;

    fn cube_at(x: f64) -> Part {
        let mut part = shape("cube").unwrap_or_else(|e| panic!("{e}"))[0].clone();
        part.role = Role::Whole;
        part.world_from_part = DAffine3::from_translation(DVec3::X * x);
        part
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
            assert_eq!(is_removed_whole(&scene, &part), is_hidden, "at {x}");
            let exterior = Part {
                role: Role::Exterior,
                ..part
            };
            assert!(!is_removed_whole(&scene, &exterior), "it is cut");
        }
    }
}
