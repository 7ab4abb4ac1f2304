//! Crossings of a ray with a relief: visits every texel cell under the ray in turn, but skips blocks of cells far from the ray.
//!
//! Within a cell, `f` is bilinear, and `F` along the ray is a quadratic. Signs decide how many roots there are: the sign at the end
//! of a cell is carried into the next cell; there is one root if the signs at the two ends differ, and two if they agree but
//! differ from the sign at the quadratic's vertex. Cells are counted in integers, from which their borders are computed, so errors do not
//! accumulate. A cell is skipped if the bounds of `f` from its four corners keep `F` away from 0 over the whole cell, and a block of cells
//! if the block's bounds do; blocks skip only cells that would be skipped anyway.
//!
//! Cost within the requested range of depths: one step per texel border where the ray is near the relief; few steps elsewhere.

use std::sync::Arc;

use cutaway::scene::{OffsetMap, PreparedSurface, View};
use glam::DVec3;

use super::ambiguity::rounding;
use super::blocks::{Blocks, RayBlock, SMALLEST};
use super::clip::{Graze, Ray, Root};
use super::outline::change_per_px;
use super::quadratic::Quadratic;
use super::table::TexelTable;

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
pub(super) struct RayRelief {
    map: Arc<OffsetMap>,
    origin: DVec3,
    normal: DVec3,
    /// Texels per scene unit, as vectors along the columns and along the rows of the map.
    axes: [DVec3; 2],
    height: f64,
    /// Minimum and maximum of `f.Sz`.
    slab: [f64; 2],
    /// Per axis: the wrapped texel for each address around the scene.
    tables: [TexelTable; 2],
    blocks: Blocks,
}

/// Heights of a cell, times `Sz`, as coefficients of a bilinear function of the position along the columns and the rows.
#[derive(Clone, Copy, Default)]
struct ReliefCell {
    h: f64,
    x: f64,
    y: f64,
    xy: f64,
    lo: f64,
    hi: f64,
}

impl RayRelief {
    /// Prepares a relief for rays within a ball around the origin of scene space.
    pub(super) fn of(surface: &PreparedSurface, map: Arc<OffsetMap>, radius: f64) -> Self {
        let size = map.size().map(f64::from);
        let axes = [
            surface.frame.u_hat * (surface.map_per_unit[0] * size[0]),
            surface.frame.v_hat * (surface.map_per_unit[1] * size[1]),
        ];
        let ends = map.range().map(|h| f64::from(h) * surface.height_scale);
        let table = |i: usize| {
            let centre = -surface.origin.dot(axes[i]) - 0.5;
            TexelTable::of(
                surface.wrap,
                map.size()[i],
                centre,
                axes[i].length() * radius,
            )
        };
        Self {
            tables: [table(0), table(1)],
            blocks: Blocks::of(&map, surface.wrap),
            origin: surface.origin,
            normal: surface.frame.normal,
            axes,
            height: surface.height_scale,
            slab: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            map,
        }
    }

    fn cell(&self, x: i64, y: i64) -> ReliefCell {
        let width = self.map.size()[0] as usize;
        let columns = [self.tables[0].texel(x), self.tables[0].texel(x + 1)];
        let rows = [self.tables[1].texel(y), self.tables[1].texel(y + 1)];
        let h = |i: usize, j: usize| {
            f64::from(self.map.texels()[rows[j] * width + columns[i]]) * self.height
        };
        let (h00, h10, h01, h11) = (h(0, 0), h(1, 0), h(0, 1), h(1, 1));
        ReliefCell {
            h: h00,
            x: h10 - h00,
            y: h01 - h00,
            xy: (h11 - h10) - (h01 - h00),
            lo: h00.min(h10).min(h01).min(h11),
            hi: h00.max(h10).max(h01).max(h11),
        }
    }

    /// See [`super::clip::RayClipSurface::meet`].
    pub(super) fn meet(
        &self,
        view: &View,
        (surface, plane): (u16, PlaneLine),
        ray: &Ray,
        [start, end]: [f64; 2],
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        // Where the distance from the plane is outside [lo, hi], it alone gives the sign. The pad exceeds the rounding error.
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
            // Where the ray leaves the slab, the sign is known; rounding may have put the last root just behind.
            let beyond = plane.slope < 0.0;
            if removed != Some(beyond) {
                roots.push(walk.root(to, !beyond, 0.0, walk.cell_at(to)));
            }
        }
        first
    }

    fn gradient(&self, cell: &ReliefCell, [lx, ly]: [f64; 2]) -> DVec3 {
        self.normal
            + self.axes[0] * (cell.x + cell.xy * ly)
            + self.axes[1] * (cell.y + cell.xy * lx)
    }
}

/// A ray's traversal of the texel grid. Texel coordinates along the ray are `p + d * depth`.
struct Walk<'a> {
    relief: &'a RayRelief,
    view: &'a View,
    surface: u16,
    plane: PlaneLine,
    ray: &'a Ray,
    p: [f64; 2],
    d: [f64; 2],
    /// Slope of `F` at the end of the previous cell; NaN if that cell was skipped.
    slope_before: f64,
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

    /// Walks `[from, to]`. `removed` holds the ray's side so far, if it is known. Returns the side at the start.
    fn run(
        &mut self,
        [from, to]: [f64; 2],
        removed: &mut Option<bool>,
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        let (p, d) = (self.p, self.d);
        // Borders are computed from the cell's index, never from the previous border.
        let border = |cell: i64, i: usize| {
            let side = if d[i] > 0.0 { cell + 1 } else { cell };
            if d[i] == 0.0 {
                f64::INFINITY
            } else {
                (side as f64 - p[i]) / d[i]
            }
        };
        let up = d.map(|d| d > 0.0);
        let step = up.map(|up| if up { 1 } else { -1 });
        let mut first = *removed;
        let mut at = from;
        let (mut x, mut y) = self.cell_at(from);
        let mut level = self.relief.blocks.top();
        loop {
            let RayBlock { range, ahead } = self.relief.blocks.block(level, [x, y], up);
            // Per axis, the last cell before the border ahead: the ray leaves the block from it.
            let last = [0, 1].map(|i| if up[i] { ahead[i] - 1 } else { ahead[i] });
            let (end_x, end_y) = (border(last[0], 0), border(last[1], 1));
            let end = end_x.min(end_y).min(to).max(at);
            let [a, b] = range.map(|h| f64::from(h) * self.relief.height);
            let heights = [a.min(b), a.max(b)];
            if let Some(side) = self.far_side(heights, [at, end], *removed) {
                self.slope_before = f64::NAN;
                let first = *first.get_or_insert(side);
                *removed = Some(side);
                if end >= to {
                    return first;
                }
                at = end;
                // The ray has passed all borders of the other axis that come before this border; ties step along the columns first.
                if end_x <= end_y {
                    y = self.cell_by([y, last[1]], 1, |j| border(j, 1) < end_x, at);
                    x = last[0] + step[0];
                } else {
                    x = self.cell_by([x, last[0]], 0, |i| border(i, 0) <= end_y, at);
                    y = last[1] + step[1];
                }
                level = (level + 1).min(self.relief.blocks.top());
                continue;
            }
            if level > SMALLEST {
                level -= 1;
                continue;
            }
            let mut is_inside = true;
            while is_inside {
                let (next_x, next_y) = (border(x, 0), border(y, 1));
                let next = next_x.min(next_y).min(to).max(at);
                let [before, after] = self.cross_cell((x, y), [at, next], *removed, roots, grazes);
                first.get_or_insert(before);
                *removed = Some(after);
                if next >= to {
                    return first.unwrap_or(before);
                }
                at = next;
                if next_x <= next_y {
                    is_inside = x != last[0];
                    x += step[0];
                } else {
                    is_inside = y != last[1];
                    y += step[1];
                }
            }
        }
    }

    /// The cell along an axis that the ray is in at a depth: the first from `now` to `last` for which `is_left` is false.
    fn cell_by(
        &self,
        [now, last]: [i64; 2],
        axis: usize,
        is_left: impl Fn(i64) -> bool,
        depth: f64,
    ) -> i64 {
        let step = (last - now).signum();
        let guess = (self.p[axis] + self.d[axis] * depth).floor() as i64;
        let mut cell = guess.clamp(now.min(last), now.max(last));
        while cell != last && is_left(cell) {
            cell += step;
        }
        while cell != now && !is_left(cell - step) {
            cell -= step;
        }
        cell
    }

    /// The side of an interval of the ray that stays clear of all heights in `[lo, hi]`; none if it does not, or comes from the other side.
    fn far_side(
        &self,
        [lo, hi]: [f64; 2],
        [start, end]: [f64; 2],
        removed: Option<bool>,
    ) -> Option<bool> {
        let (g0, g1) = (self.plane.at(start), self.plane.at(end));
        // If heights stay in [lo, hi], no gradient of F is longer than `steep`, so a small shift of the sample moves F by at most `reach`.
        let axes = &self.relief.axes;
        let steep = 1.0 + (hi - lo) * (axes[0].length() + axes[1].length());
        let reach =
            steep * (self.view.pixel_size(end).abs() * self.view.doubt_px() + self.blur(end));
        let kept = g0.min(g1) + lo > reach;
        let is_far =
            (kept && removed != Some(true)) || (g0.max(g1) + hi < -reach && removed != Some(false));
        is_far.then_some(!kept)
    }

    /// Distance in scene space by which rounding may move the sample at a depth.
    fn blur(&self, depth: f64) -> f64 {
        rounding(self.view, depth) * self.ray.direction.length()
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
        if let Some(side) = self.far_side([cell.lo, cell.hi], [start, end], removed) {
            self.slope_before = f64::NAN;
            return [side; 2];
        }
        let (g0, blur) = (self.plane.at(start), self.blur(end));
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
        // Extrema of F: within the cell, and at the crease between it and the previous cell.
        let crease = (self.slope_before * f.b < 0.0).then_some((0.0, self.slope_before < 0.0));
        let inside = turns.then_some((vertex, f.a > 0.0));
        for (s, least) in [crease, inside].into_iter().flatten() {
            let (value, depth) = (f.at(s), start + s);
            let gradient = relief.gradient(&cell, self.local(depth, at));
            let change = change_per_px(self.view, gradient, depth) * self.view.doubt_px()
                + gradient.length() * blur;
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
    use glam::DVec2;

    use super::*;
    use cutaway::generate::shapes;
    use cutaway::scene::{Camera, ClipSurface, Cut, Prepared, Projection, Scene, Viewpoint, Wrap};

    /// A cube cut by a wavy relief with a few spikes, seen at an angle to the plane's normal.
    fn prepared(wrap: Wrap, size: [u32; 2], height: f64, angle_deg: f64) -> Prepared {
        let texels = (0..size[0] * size[1]).map(|i| {
            let wave =
                (f64::from(i % size[0]) * 0.31).sin() * (f64::from(i / size[0]) * 0.23).cos();
            wave as f32 + if i * 7919 % 97 == 0 { 3.0 } else { 0.0 }
        });
        let map = OffsetMap::new(size, texels.collect()).expect("finite heights");
        let mut surface = ClipSurface::plane(DVec3::new(0.1, 0.05, 0.0), DVec3::Z);
        surface.relief = Some(Arc::new(map));
        surface.wrap = wrap;
        surface.scale.z = height;
        Prepared::new(&Scene {
            parts: shapes::shape("cube").unwrap_or_else(|e| panic!("{e}")),
            cuts: vec![Cut::new("c", vec![surface])],
            camera: Camera {
                viewpoint: Viewpoint::Orbit {
                    azimuth_deg: angle_deg,
                    elevation_deg: 3.0,
                },
                projection: Projection::Perspective { fov_y_deg: 40.0 },
                ..Camera::default()
            },
            ..Scene::default()
        })
    }

    fn relief_of(prepared: &Prepared) -> RayRelief {
        let surface = &prepared.surfaces[0];
        let map = surface.relief.clone().expect("a relief");
        RayRelief::of(surface, map, 2.0)
    }

    /// All crossings of a picture's rays with a relief, as text, and their number.
    fn met(prepared: &Prepared, relief: &RayRelief) -> (String, usize) {
        let view = prepared.view([24, 24]);
        let (mut roots, mut grazes) = (Vec::new(), Vec::new());
        let mut sides = Vec::new();
        for pixel in 0..24 * 24 {
            let at = DVec2::new(f64::from(pixel % 24), f64::from(pixel / 24)) + 0.5;
            let ray = Ray::through(&view, at);
            let line = PlaneLine {
                base: (ray.origin - relief.origin).dot(relief.normal),
                slope: ray.direction.dot(relief.normal),
            };
            let range = [view.near, 8.0];
            sides.push(relief.meet(&view, (0, line), &ray, range, &mut roots, &mut grazes));
        }
        (format!("{sides:?} {roots:?} {grazes:?}"), roots.len())
    }

    #[test]
    fn blocks_that_are_passed_change_nothing() {
        let mut crossings = 0;
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for (size, height) in [([64, 64], 0.02), ([37, 90], -0.05), ([200, 1], 0.04)] {
                for angle_deg in [5.0, 60.0, 86.0, 94.0] {
                    let prepared = prepared(wrap, size, height, angle_deg);
                    let relief = relief_of(&prepared);
                    let (passed, count) = met(&prepared, &relief);
                    let cell_by_cell = RayRelief {
                        blocks: relief.blocks.always_near(),
                        ..relief
                    };
                    let same = passed == met(&prepared, &cell_by_cell).0;
                    assert!(same, "{wrap:?}, {size:?} at {angle_deg} degrees");
                    crossings += count;
                }
            }
        }
        assert!(crossings > 5000, "only {crossings} crossings");
    }

    #[test]
    fn a_block_with_a_fault_is_noticed() {
        let prepared = prepared(Wrap::Repeat, [64, 64], 0.02, 60.0);
        let right = met(&prepared, &relief_of(&prepared)).0;
        for level in SMALLEST..5 {
            let relief = relief_of(&prepared);
            let wrong = RayRelief {
                blocks: relief.blocks.with_a_fault(level),
                ..relief
            };
            assert!(
                met(&prepared, &wrong).0 != right,
                "a fault of level {level}"
            );
        }
    }
}
