//! Planar faces: a region between closed polygons, filled with triangles of even size.
//!
//! Constrained Delaunay triangulation of the polygons and of a hexagonal lattice of points inside. No vertex is added on a polygon, so
//! walls that share the polygon still match. Cost: n log n in the vertices.

use std::collections::HashMap;

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use crate::{Error, Result};

/// A vertex of the triangulation with its index.
struct FillVertex {
    at: DVec2,
    number: u32,
}

impl HasPosition for FillVertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// A filled region.
pub(super) struct FilledRegion {
    /// Points added inside; their indices follow those of the polygons' points.
    pub(super) added: Vec<DVec2>,
    /// Counter-clockwise triangles; indices run through the polygons' points in order, then through `added`.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Fills the region inside an odd number of the polygons, with interior points `spacing` apart. Polygons must not cross or touch.
pub(super) fn fill(polygons: &[&[DVec2]], spacing: f64) -> Result<FilledRegion> {
    let added = lattice(polygons, spacing);
    let mut edges = Vec::new();
    let mut points: Vec<DVec2> = Vec::new();
    for polygon in polygons {
        let (first, n) = (points.len(), polygon.len());
        edges.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
        points.extend_from_slice(polygon);
    }
    points.extend_from_slice(&added);
    let vertices = (0_u32..).zip(&points);
    let vertices = vertices.map(|(number, at)| FillVertex { at: *at, number });
    let wanted = edges.len();
    let cdt = ConstrainedDelaunayTriangulation::<FillVertex>::try_bulk_load_cdt(
        vertices.collect(),
        edges,
        |_| {},
    )
    .map_err(|e| broken(&e.to_string()))?;
    if cdt.num_vertices() != points.len() || cdt.num_constraints() != wanted {
        return Err(broken("the outlines of a planar face touch"));
    }

    // Flood fill from outside: the parity of the polygon edges crossed decides. Every face is visited once.
    let mut is_done = vec![false; cdt.num_all_faces()];
    is_done[cdt.outer_face().fix().index()] = true;
    let mut reached: Vec<(_, bool)> = cdt
        .convex_hull()
        .map(|hull| (hull.rev(), hull.is_constraint_edge()))
        .collect();
    let mut triangles = Vec::new();
    while let Some((edge, is_inside)) = reached.pop() {
        if std::mem::replace(&mut is_done[edge.face().fix().index()], true) {
            continue;
        }
        let around = [edge, edge.next(), edge.prev()];
        if is_inside {
            triangles.push(around.map(|e| e.from().data().number));
        }
        reached.extend(around.map(|e| (e.rev(), is_inside != e.is_constraint_edge())));
    }
    Ok(FilledRegion { added, triangles })
}

fn broken(what: &str) -> Error {
    Error::input(
        "shape",
        format!("it cannot be built: {what}"),
        "keep its parameters nearer to their defaults",
    )
}

/// Points of a hexagonal lattice inside the region, at least 0.7 spacings from every polygon point.
fn lattice(polygons: &[&[DVec2]], spacing: f64) -> Vec<DVec2> {
    let clearance = 0.7 * spacing;
    let cell_of = |p: DVec2| (p / clearance).floor().as_i64vec2();
    let mut near: HashMap<_, Vec<DVec2>> = HashMap::new();
    for p in polygons.iter().copied().flatten() {
        near.entry(cell_of(*p)).or_default().push(*p);
    }
    let is_clear = |p: DVec2| {
        let cell = cell_of(p);
        (-1..=1).all(|dx| {
            (-1..=1).all(|dy| {
                let others = near.get(&(cell + glam::I64Vec2::new(dx, dy)));
                others.is_none_or(|o| o.iter().all(|q| q.distance(p) >= clearance))
            })
        })
    };
    let all = || polygons.iter().copied().flatten();
    let low = all().fold(DVec2::INFINITY, |m, p| m.min(*p));
    let high = all().fold(DVec2::NEG_INFINITY, |m, p| m.max(*p));
    let pitch = spacing * 0.75_f64.sqrt();
    let mut points = Vec::new();
    // An odd start keeps rows off the symmetry axes, where outlines often have corners.
    for row in 0..((high.y - low.y) / pitch) as usize {
        let y = low.y + (row as f64 + 0.619) * pitch;
        let mut crossings: Vec<f64> = Vec::new();
        for polygon in polygons {
            for (i, a) in polygon.iter().enumerate() {
                let b = polygon[(i + 1) % polygon.len()];
                if (a.y > y) != (b.y > y) {
                    crossings.push(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
                }
            }
        }
        crossings.sort_by(f64::total_cmp);
        let shift = low.x + if row % 2 == 0 { 0.0 } else { 0.5 * spacing };
        for span in crossings.chunks_exact(2) {
            let first = ((span[0] - shift) / spacing).ceil() as i64;
            let last = ((span[1] - shift) / spacing).floor() as i64;
            let row_points = (first..=last).map(|k| DVec2::new(shift + k as f64 * spacing, y));
            points.extend(row_points.filter(|p| is_clear(*p)));
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::super::outline::{area, circle};
    use super::*;

    #[test]
    fn a_filled_region_has_the_area_of_its_outlines() {
        let outer = circle(DVec2::ZERO, 1.0, 90);
        let hole = circle(DVec2::new(0.4, 0.1), 0.3, 40);
        let island = circle(DVec2::new(0.4, 0.1), 0.1, 12);
        let filled = fill(&[&outer, &hole, &island], 0.1).unwrap();
        let mut points = [&outer[..], &hole[..], &island[..]].concat();
        points.extend(&filled.added);
        let sum: f64 = (filled.triangles.iter())
            .map(|t| area(&t.map(|i| points[i as usize])))
            .sum();
        let expected = area(&outer) - area(&hole) + area(&island);
        assert!((sum - expected).abs() < 1e-12, "{sum} against {expected}");
        let turned = |t: &&[u32; 3]| area(&t.map(|i| points[i as usize])) <= 0.0;
        assert_eq!(filled.triangles.iter().find(turned), None, "clockwise");
    }

    #[test]
    fn outlines_that_cross_or_touch_are_refused() {
        let outer = circle(DVec2::ZERO, 1.0, 16);
        for centre in [0.5, 0.9] {
            let hole = circle(DVec2::X * centre, 0.5, 16);
            assert!(fill(&[&outer, &hole], 0.2).is_err(), "hole at {centre}");
        }
    }
}
