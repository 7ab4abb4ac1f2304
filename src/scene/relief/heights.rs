//! Computes the heights of procedures.
//!
//! Every procedure gives heights in 0..=1 and is periodic over the map, so it tiles without a seam under
//! [`Wrap::Repeat`](crate::scene::Wrap::Repeat). All but `sawtooth` and `constant` are stretched to reach 0 and 1
//! exactly, so a scale of `Sz` always gives a relief of height `Sz`. Cost: one evaluation per texel, rows in parallel.

use glam::DVec2;
use rayon::prelude::*;

use super::noise;
use super::procedures::{Procedure, ProcedureKind};
use crate::scene::OffsetMap;

impl Procedure {
    /// Computes the offset map.
    pub fn map(&self) -> OffsetMap {
        let [w, h] = self.size;
        let heights: Vec<f64> = match self.kind {
            ProcedureKind::Sawtooth => vec![0.0, 1.0, 0.0, 1.0],
            ProcedureKind::Constant { value } => vec![value; w as usize * h as usize],
            _ => stretched(
                (0..h)
                    .into_par_iter()
                    .flat_map_iter(|y| (0..w).map(move |x| (x, y)))
                    .map(|(x, y)| self.height(self.centre(x, y)))
                    .collect(),
            ),
        };
        OffsetMap::of_finite(self.size, heights.into_iter().map(|h| h as f32).collect())
    }

    fn centre(&self, x: u32, y: u32) -> DVec2 {
        (extent([x, y]) + 0.5) / extent(self.size)
    }

    /// Number of cells along each axis, with `cells` along the longer side; cells are square or nearly square in texels.
    fn grid(&self, cells: u32) -> [u32; 2] {
        let longer = f64::from(self.size[0].max(self.size[1]));
        self.size
            .map(|n| (f64::from(cells) * f64::from(n) / longer).round().max(1.0) as u32)
    }

    /// The height at a point of the map, before stretching; periodic in both coordinates with period 1.
    fn height(&self, t: DVec2) -> f64 {
        match self.kind {
            ProcedureKind::Waves { count } => {
                let wave = |n: u32, t: f64| (std::f64::consts::TAU * f64::from(n) * t).cos();
                wave(count[0], t.x) + wave(count[1], t.y)
            }
            ProcedureKind::Fractal {
                cells,
                octaves,
                gain,
            } => {
                let finest = self.size[0].max(self.size[1]) / 2;
                let (mut sum, mut share) = (0.0, 1.0);
                for octave in 0..octaves {
                    let cells = cells << octave;
                    if octave > 0 && cells > finest {
                        break;
                    }
                    let grid = self.grid(cells);
                    let seed = self.seed.wrapping_add(u64::from(octave) << 32);
                    sum += share * noise::gradient(t * extent(grid), grid, seed);
                    share *= gain;
                }
                sum
            }
            ProcedureKind::Cracks { cells, width } => broken(t, self.grid(cells), width, self.seed),
            ProcedureKind::Steps { levels } => f64::from(tread(t.x, levels) + tread(t.y, levels)),
            ProcedureKind::Sawtooth => f64::from(u8::from(t.x.rem_euclid(1.0) >= 0.5)),
            ProcedureKind::Constant { value } => value,
        }
    }
}

/// Facets with grooves along the bisectors of neighbouring sites.
fn broken(t: DVec2, grid: [u32; 2], width: f64, seed: u64) -> f64 {
    let [nx, ny] = grid.map(i64::from);
    let p = t * extent(grid);
    let base = p.floor();
    let hash_of = |cell: DVec2| {
        let (x, y) = (cell.x as i64, cell.y as i64);
        noise::hash(x.rem_euclid(nx), y.rem_euclid(ny), seed)
    };
    // Sites keep off the cell borders, so that no two coincide; all neighbours of the nearest site are at most two cells away.
    let site_of = |cell: DVec2| cell + 0.05 + 0.9 * noise::pair(hash_of(cell));
    let around = |centre: DVec2| {
        (-2..=2).flat_map(move |y| {
            (-2..=2).map(move |x| centre + DVec2::new(f64::from(x), f64::from(y)))
        })
    };
    let nearest = around(base)
        .min_by(|a, b| {
            let distance = |c: DVec2| site_of(c).distance_squared(p);
            distance(*a).total_cmp(&distance(*b))
        })
        .unwrap_or(base);
    let site = site_of(nearest);
    let to_groove = around(nearest)
        .filter(|cell| *cell != nearest)
        .map(|cell| {
            let other = site_of(cell);
            ((site + other) * 0.5 - p).dot((other - site).normalize_or_zero())
        })
        .fold(f64::INFINITY, f64::min);
    let edge = (to_groove / width).clamp(0.0, 1.0);
    let own = noise::pair(hash_of(nearest).rotate_left(17));
    let tilt = (own * 2.0 - 1.0).dot(p - site);
    // Every facet drops to 0 in its grooves, so neighbours of different heights join there.
    edge * edge * (3.0 - 2.0 * edge) * (0.6 + 0.4 * own.x + 0.3 * tilt)
}

fn extent(size: [u32; 2]) -> DVec2 {
    DVec2::new(f64::from(size[0]), f64::from(size[1]))
}

/// Index of the tread at `t`: 0, 1, .. `levels - 1`, and down again to 1, within one period.
fn tread(t: f64, levels: u32) -> u32 {
    let treads = 2 * (levels - 1);
    let k = ((t.rem_euclid(1.0) * f64::from(treads)) as u32).min(treads - 1);
    if k < levels { k } else { treads - k }
}

/// Heights shifted and scaled to span 0..=1; one half if all are equal.
fn stretched(mut heights: Vec<f64>) -> Vec<f64> {
    let lo = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let span = hi - lo;
    for h in &mut heights {
        *h = if span > 1e-12 { (*h - lo) / span } else { 0.5 };
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Wrap;
    use crate::scene::describe::Described;

    fn all() -> Vec<Procedure> {
        Procedure::NAMES
            .iter()
            .filter_map(|name| Procedure::named(name))
            .collect()
    }

    #[test]
    fn heights_span_zero_to_one_and_depend_on_nothing_but_the_description() {
        for procedure in all() {
            let map = procedure.map();
            let [lo, hi] = map.range();
            let flat = matches!(procedure.kind, ProcedureKind::Constant { .. });
            assert_eq!(
                [lo, hi],
                if flat { [0.5, 0.5] } else { [0.0, 1.0] },
                "{procedure:?} spans {lo}..{hi}"
            );
            assert_eq!(
                map,
                procedure.map(),
                "{procedure:?} differs when computed again"
            );
        }
    }

    #[test]
    fn the_seed_changes_the_random_ones() {
        for name in ["fractal", "cracks"] {
            let one = Procedure::named(name).expect(name);
            let other = Procedure { seed: 2, ..one };
            assert_ne!(one.map(), other.map(), "the seed of {name} does nothing");
        }
    }

    #[test]
    fn every_procedure_has_period_one() {
        for procedure in all() {
            for i in 0..300 {
                let t = noise::pair(noise::hash(i, 2, 9));
                let here = procedure.height(t);
                for shift in [DVec2::X, DVec2::Y, DVec2::new(-1.0, 2.0)] {
                    let there = procedure.height(t + shift);
                    assert!(
                        (here - there).abs() < 1e-9,
                        "{procedure:?} is {here} at {t} but {there} a period on"
                    );
                }
            }
        }
    }

    #[test]
    fn the_step_over_the_seam_is_no_larger_than_those_inside() {
        for procedure in all() {
            let map = procedure.map();
            let [w, h] = map.size().map(i64::from);
            let step = |x: i64, y: i64, dx: i64, dy: i64| {
                let here = map.texel(Wrap::Repeat, x, y);
                (map.texel(Wrap::Repeat, x + dx, y + dy) - here).abs()
            };
            let inside = (0..h)
                .flat_map(|y| (0..w - 1).map(move |x| (x, y)))
                .map(|(x, y)| step(x, y, 1, 0))
                .chain(
                    (0..w)
                        .flat_map(|x| (0..h - 1).map(move |y| (x, y)))
                        .map(|(x, y)| step(x, y, 0, 1)),
                )
                .fold(0.0, f64::max);
            let seam = (0..h)
                .map(|y| step(w - 1, y, 1, 0))
                .chain((0..w).map(|x| step(x, h - 1, 0, 1)))
                .fold(0.0, f64::max);
            assert!(
                seam <= inside * 1.000_001,
                "{procedure:?}: {seam} over {inside}"
            );
        }
    }

    #[test]
    fn any_size_is_taken() {
        for size in [[1, 1], [1, 37], [37, 1], [3, 200], [255, 129]] {
            for mut procedure in all() {
                if procedure.fields().iter().any(|f| f.key == "size") {
                    procedure.size = size;
                    let map = procedure.map();
                    assert_eq!(map.size(), size, "{procedure:?}");
                    OffsetMap::new(map.size(), map.texels().to_vec()).expect("finite and complete");
                }
            }
        }
    }
}
