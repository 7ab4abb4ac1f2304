//! Where a ray crosses a relief: every texel cell under the ray in turn.
//!
//! Within a cell `f` is bilinear and `F` along the ray a quadratic. Signs decide, roots only locate: the sign at the end
//! of a cell is carried into the next one, one root where the two ends differ, two where they agree but the vertex of the
//! quadratic does not. Cells are counted in integers and their borders computed afresh from them, so nothing drifts. A
//! cell is skipped when the four-corner bounds of `f` keep `F` away from 0 over the whole cell.
//!
//! Cost: one step per texel border between the depths asked for, within the slab that holds the relief.

use std::sync::Arc;

use glam::DVec3;

use super::ambiguity::rounding;
use super::clip::{Graze, Ray, Root};
use super::outline::{NEAR_PX, change_per_px};
use crate::scene::{OffsetMap, PreparedSurface, View, Wrap};

/// The largest table of wrapped addresses; beyond it they are wrapped one by one.
const TABLE_TEXELS: i64 = 1 << 20;

/// Signed distance from the plane along a ray, `base + slope * depth`.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneLine {
    pub(super) base: f64,
    pub(super) slope: f64,
}

impl PlaneLine {
    fn at(self, depth: f64) -> f64 {
        self.base + self.slope * depth
    }
}

/// A relief ready for rays.
pub(super) struct Relief {
    map: Arc<OffsetMap>,
    origin: DVec3,
    normal: DVec3,
    /// Texels per scene unit along the columns and the rows of the map, as vectors.
    axes: [DVec3; 2],
    height: f64,
    /// Least and greatest `f.Sz`.
    slab: [f64; 2],
    /// Texels of the addresses around the scene, along each axis.
    tables: [Table; 2],
}

struct Table {
    first: i64,
    texels: Vec<u32>,
    wrap: Wrap,
    size: u32,
}

impl Table {
    fn of(wrap: Wrap, size: u32, centre: f64, reach: f64) -> Self {
        let first = (centre - reach).floor() as i64 - 2;
        let last = (centre + reach).ceil() as i64 + 3;
        let texels = if last.saturating_sub(first) < TABLE_TEXELS {
            (first..=last).map(|i| wrap.texel(i, size)).collect()
        } else {
            Vec::new()
        };
        Self {
            first,
            texels,
            wrap,
            size,
        }
    }

    fn texel(&self, address: i64) -> usize {
        let known = usize::try_from(address.wrapping_sub(self.first))
            .ok()
            .and_then(|i| self.texels.get(i));
        known
            .copied()
            .unwrap_or_else(|| self.wrap.texel(address, self.size)) as usize
    }
}

/// Heights of a cell: `h + x along columns + y along rows + xy of both`, times `Sz`.
#[derive(Clone, Copy, Default)]
struct Cell {
    h: f64,
    x: f64,
    y: f64,
    xy: f64,
    lo: f64,
    hi: f64,
}

impl Relief {
    /// Prepares a relief for rays within a ball around the origin of scene space.
    pub(super) fn of(surface: &PreparedSurface, map: Arc<OffsetMap>, radius: f64) -> Self {
        let size = map.size.map(f64::from);
        let axes = [
            surface.frame.u_hat * (surface.map_per_unit[0] * size[0]),
            surface.frame.v_hat * (surface.map_per_unit[1] * size[1]),
        ];
        let ends = map.range().map(|h| f64::from(h) * surface.height_scale);
        let table = |i: usize| {
            let centre = -surface.origin.dot(axes[i]) - 0.5;
            Table::of(surface.wrap, map.size[i], centre, axes[i].length() * radius)
        };
        Self {
            tables: [table(0), table(1)],
            origin: surface.origin,
            normal: surface.frame.normal,
            axes,
            height: surface.height_scale,
            slab: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            map,
        }
    }

    fn cell(&self, x: i64, y: i64) -> Cell {
        let width = self.map.size[0] as usize;
        let columns = [self.tables[0].texel(x), self.tables[0].texel(x + 1)];
        let rows = [self.tables[1].texel(y), self.tables[1].texel(y + 1)];
        let h = |i: usize, j: usize| {
            f64::from(self.map.texels[rows[j] * width + columns[i]]) * self.height
        };
        let (h00, h10, h01, h11) = (h(0, 0), h(1, 0), h(0, 1), h(1, 1));
        Cell {
            h: h00,
            x: h10 - h00,
            y: h01 - h00,
            xy: (h11 - h10) - (h01 - h00),
            lo: h00.min(h10).min(h01).min(h11),
            hi: h00.max(h10).max(h01).max(h11),
        }
    }

    /// As [`super::clip::Clip::meet`].
    pub(super) fn meet(
        &self,
        view: &View,
        (surface, plane): (u16, PlaneLine),
        ray: &Ray,
        [start, end]: [f64; 2],
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        // Outside [lo, hi] of the plane's distance the sign is that of the distance alone. The pad exceeds rounding.
        let pad = 1e-9;
        let (lo, hi) = (-self.slab[1] - pad, -self.slab[0] + pad);
        let (mut from, mut to) = (start, end);
        if plane.slope != 0.0 {
            let (a, b) = (
                (lo - plane.base) / plane.slope,
                (hi - plane.base) / plane.slope,
            );
            from = start.max(a.min(b));
            to = end.min(a.max(b));
        }
        let outside = plane.at(start) < lo || plane.at(start) > hi;
        if from >= to || (plane.slope == 0.0 && outside) {
            return plane.at(start) + 0.5 * (self.slab[0] + self.slab[1]) < 0.0;
        }
        let mut walk = Walk {
            relief: self,
            view,
            surface,
            plane,
            ray,
            p: self
                .axes
                .map(|axis| (ray.origin - self.origin).dot(axis) - 0.5),
            d: self.axes.map(|axis| ray.direction.dot(axis)),
            slope_before: f64::NAN,
        };
        let mut removed = (from > start).then(|| plane.at(start) < lo);
        let first = walk.run([from, to], &mut removed, roots, grazes);
        if to < end {
            // The slab's far side fixes the sign; rounding may have left the last root just behind it.
            let beyond = plane.slope < 0.0;
            if removed != Some(beyond) {
                roots.push(walk.root(to, !beyond, 0.0, walk.cell_at(to)));
            }
        }
        first
    }

    fn gradient(&self, cell: &Cell, [lx, ly]: [f64; 2]) -> DVec3 {
        self.normal
            + self.axes[0] * (cell.x + cell.xy * ly)
            + self.axes[1] * (cell.y + cell.xy * lx)
    }
}

/// A ray on its way over the texel grid. Texel coordinates along it are `p + d * depth`.
struct Walk<'a> {
    relief: &'a Relief,
    view: &'a View,
    surface: u16,
    plane: PlaneLine,
    ray: &'a Ray,
    p: [f64; 2],
    d: [f64; 2],
    /// Slope of `F` at the end of the cell before; NaN where that cell was skipped.
    slope_before: f64,
}

/// `F(start + s) = a s^2 + b s + c` over `0..length`.
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
    length: f64,
}

impl Quadratic {
    fn at(&self, s: f64) -> f64 {
        self.c + s * (self.b + s * self.a)
    }

    /// Both roots, least first, in the form that divides by no small number (`c / q`, `q / a`).
    fn roots(&self) -> [f64; 2] {
        let root = (self.b * self.b - 4.0 * self.a * self.c).max(0.0).sqrt();
        let q = -0.5 * (self.b + root.copysign(self.b));
        let (r, s) = (self.c / q, q / self.a);
        // A double root at 0 gives 0 / 0.
        let [r, s] = [r, s].map(|x| if x.is_nan() { 0.0 } else { x });
        [r.min(s), r.max(s)]
    }

    /// The root between two ends of different sign.
    fn crossing(&self) -> f64 {
        let miss = |r: f64| (r - r.clamp(0.0, self.length)).abs();
        let [r, s] = self.roots();
        let best = if miss(r) <= miss(s) { r } else { s };
        best.clamp(0.0, self.length)
    }
}

impl Walk<'_> {
    fn cell_at(&self, depth: f64) -> (i64, i64) {
        let at = |i: usize| (self.p[i] + self.d[i] * depth).floor() as i64;
        (at(0), at(1))
    }

    fn local(&self, depth: f64, (x, y): (i64, i64)) -> [f64; 2] {
        [
            self.p[0] + self.d[0] * depth - x as f64,
            self.p[1] + self.d[1] * depth - y as f64,
        ]
    }

    fn root(&self, depth: f64, to_kept: bool, bend: f64, at: (i64, i64)) -> Root {
        let cell = self.relief.cell(at.0, at.1);
        Root {
            surface: self.surface,
            depth,
            to_kept,
            gradient: self.relief.gradient(&cell, self.local(depth, at)),
            bend,
            face: None,
        }
    }

    /// Walks `[from, to]`; `removed` holds the side so far, if one is known. Returns the side at the start.
    fn run(
        &mut self,
        [from, to]: [f64; 2],
        removed: &mut Option<bool>,
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        let (p, d) = (self.p, self.d);
        // Borders come from the number of the cell, never from the border before.
        let border = |cell: i64, i: usize| {
            let side = if d[i] > 0.0 { cell + 1 } else { cell };
            if d[i] == 0.0 {
                f64::INFINITY
            } else {
                (side as f64 - p[i]) / d[i]
            }
        };
        let step = d.map(|d| if d > 0.0 { 1 } else { -1 });
        let mut first = *removed;
        let mut at = from;
        let (mut x, mut y) = self.cell_at(from);
        let (mut next_x, mut next_y) = (border(x, 0), border(y, 1));
        loop {
            let next = next_x.min(next_y).min(to).max(at);
            let [before, after] = self.cross_cell((x, y), [at, next], *removed, roots, grazes);
            first.get_or_insert(before);
            *removed = Some(after);
            if next >= to {
                return first.unwrap_or(before);
            }
            at = next;
            // Ties step along the columns first.
            if next_x <= next_y {
                x += step[0];
                next_x = border(x, 0);
            } else {
                y += step[1];
                next_y = border(y, 1);
            }
        }
    }

    /// Crosses one cell. Returns the side at its start and at its end.
    fn cross_cell(
        &mut self,
        at: (i64, i64),
        [start, end]: [f64; 2],
        removed: Option<bool>,
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> [bool; 2] {
        let relief = self.relief;
        let cell = relief.cell(at.0, at.1);
        let (g0, g1) = (self.plane.at(start), self.plane.at(end));
        // No gradient in the cell is longer than `steep`, so no small shift of the sample moves F by more than `reach`.
        let steep = 1.0 + (cell.hi - cell.lo) * (relief.axes[0].length() + relief.axes[1].length());
        let blur = rounding(self.view, end) * self.ray.direction.length();
        let reach = steep * (self.view.pixel_size(end).abs() * NEAR_PX + blur);
        let kept = g0.min(g1) + cell.lo > reach;
        if (kept && removed != Some(true))
            || (g0.max(g1) + cell.hi < -reach && removed != Some(false))
        {
            self.slope_before = f64::NAN;
            return [!kept; 2];
        }
        let ([lx, ly], [dx, dy]) = (self.local(start, at), self.d);
        let f = Quadratic {
            a: cell.xy * dx * dy,
            b: self.plane.slope + cell.x * dx + cell.y * dy + cell.xy * (lx * dy + ly * dx),
            c: g0 + cell.h + cell.x * lx + cell.y * ly + cell.xy * lx * ly,
            length: end - start,
        };
        let before = removed.unwrap_or(f.c < 0.0);
        let after = f.at(f.length) < 0.0;
        let vertex = -f.b / (2.0 * f.a);
        let turns = vertex > 0.0 && vertex < f.length;
        if before != after {
            let depth = start + f.crossing();
            roots.push(self.root(depth, before, f.a, at));
        } else if turns && (f.at(vertex) < 0.0) != before {
            let [r, s] = f.roots();
            let (r, s) = (r.clamp(0.0, vertex), s.clamp(vertex, f.length));
            roots.push(self.root(start + r, before, f.a, at));
            roots.push(self.root(start + s, !before, f.a, at));
        }
        // Extrema of F: inside the cell, and at the crease between it and the cell before.
        let crease = (self.slope_before * f.b < 0.0).then_some((0.0, self.slope_before < 0.0));
        let inside = turns.then_some((vertex, f.a > 0.0));
        for (s, least) in [crease, inside].into_iter().flatten() {
            let (value, depth) = (f.at(s), start + s);
            let gradient = relief.gradient(&cell, self.local(depth, at));
            let change =
                change_per_px(self.view, gradient, depth) * NEAR_PX + gradient.length() * blur;
            if value.abs() < change {
                grazes.push(Graze {
                    surface: self.surface,
                    depth,
                    crossed: least == (value < 0.0),
                    removed: value < 0.0,
                });
            }
        }
        self.slope_before = f.b + 2.0 * f.a * f.length;
        [before, after]
    }
}

#[cfg(test)]
mod tests {
    use super::Quadratic;

    #[test]
    fn roots_survive_a_vanishing_square_term() {
        for a in [0.0, 1e-300, 1e-17, -1e-17, 1e-9] {
            let f = Quadratic {
                a,
                b: 2.0,
                c: -1.0,
                length: 1.0,
            };
            let r = f.crossing();
            assert!((r - 0.5).abs() < 1e-9, "root {r} for a = {a}");
        }
    }

    #[test]
    fn roots_are_those_of_the_factors() {
        for (r, s) in [(0.25, 0.75), (0.0, 0.5), (0.5, 0.5), (1e-12, 1.0)] {
            let f = Quadratic {
                a: -3.0,
                b: 3.0 * (r + s),
                c: -3.0 * r * s,
                length: 1.0,
            };
            let found = f.roots();
            assert!(
                (found[0] - r).abs() < 1e-9 && (found[1] - s).abs() < 1e-9,
                "{found:?} for {r}, {s}"
            );
        }
    }
}
