//! The ground and the shadow on it: how much of the light from above is hidden from each point of the ground.
//!
//! Kept solids are rendered from straight below and above, with parallel rays, by the method that draws the scene, so that all cuts count.
//! Light comes from a disc of the sky: anything at height `h` above the ground casts a shadow blurred over `h` times the tangent of the
//! disc's radius. Undersides darken contacts, and tops hide half of the disc next to a wall; the darker counts. Heights are
//! sorted into [`BINS`], each blurred as a whole by three boxes, which approximates a Gaussian; a height between two bins
//! belongs to both.
//!
//! Costs two frames of [`SIDE_PX`] squared and their read-back, then a few additions per pixel and bin. Cannot: cast slanted light,
//! shade the model itself, or see anything between the lowest and the highest surface above a point of the ground.

use glam::{DVec2, DVec3};

use crate::layers::{Kind, Layer, Layers};
use crate::plan::{Contents, pack};
use crate::scene::style::Shadow;
use crate::scene::{Precision, Prepared, View};

/// Pixels along each side of the map.
const SIDE_PX: u32 = 320;
/// Number of distinct heights.
const BINS: usize = 8;
/// Ratio of a blur's standard deviation to the radius of the disc of light at that height.
const DEVIATION: f64 = 0.5;

/// A map of how dark the ground is, ready to be bound.
#[derive(Clone, Debug)]
pub struct GroundShadow {
    pub(crate) numbers: Contents,
    pub(crate) darkness: Contents,
}

impl GroundShadow {
    /// The views from below and from above that a scene's shadow is made from, if its style has one. Both have the same columns, with the
    /// rows in opposite order.
    pub fn views(prepared: &Prepared) -> [View; 2] {
        let below = Self::view_from_below(prepared);
        let way = 2.0 * below.depth_of(prepared.bounds.centre());
        let above = View {
            eye: below.eye + below.forward * way,
            up: -below.up,
            forward: -below.forward,
            ..below
        };
        [below, above].map(|view| prepared.seen_to_the_end(view))
    }

    fn view_from_below(prepared: &Prepared) -> View {
        let up = prepared.up();
        let across = up.any_orthonormal_vector();
        let right = up.cross(across);
        let level = level(prepared);
        let corners = prepared.bounds.corners();
        let height = corners
            .iter()
            .map(|c| c.dot(up) - level)
            .fold(0.0, f64::max);
        let centre = prepared.bounds.centre();
        let half = corners.iter().fold(0.0, |half: f64, c| {
            let from = *c - centre;
            half.max(from.dot(across).abs()).max(from.dot(right).abs())
        });
        let radius = prepared.bounds.radius();
        View {
            size_px: [SIDE_PX; 2],
            centre_px: DVec2::splat(f64::from(SIDE_PX) / 2.0),
            eye: centre + up * (level - centre.dot(up) - radius),
            right,
            up: across,
            forward: up,
            half_height: half + reach(&prepared.style.shadow, height).max(0.05 * half),
            orthographic: true,
            near: 0.5 * radius,
            far: 2.0 * radius + height,
            near_cap: false,
            band: [0, SIDE_PX],
            halo_rows: [0; 2],
            fineness: 1,
            precision: Precision::USUAL,
        }
    }

    /// The shadow made from the layers seen from below and from above.
    pub fn of(prepared: &Prepared, views: &[View; 2], layers: [&Layers; 2]) -> Self {
        let [view, above] = views;
        let level = level(prepared) - view.eye.dot(view.forward);
        let side = view.size_px[0];
        let shown = |l: &Layer| l.kind != Kind::Background;
        let lowest = layers[0]
            .pixels
            .iter()
            .map(|l| shown(l).then(|| (l.depth - level).max(0.0)));
        // The tops of the columns, in the row order of the view from below.
        let top = above.eye.dot(view.forward) - view.eye.dot(view.forward) - level;
        let rows = layers[1].pixels.chunks(side as usize).rev();
        let highest = rows
            .flatten()
            .map(|l| shown(l).then(|| (top - l.depth).max(0.0)));
        let reach_px = |h: f64| reach(&prepared.style.shadow, h) / view.pixel_size(0.0);
        let of = |heights: Vec<Option<f64>>| darkness(&heights, side as usize, reach_px);
        let (under, beside) = (of(lowest.collect()), of(highest.collect()));
        let darkness: Vec<f32> = under.iter().zip(&beside).map(|(a, b)| a.max(*b)).collect();
        let per_px = 1.0 / view.pixel_size(0.0);
        let row = |axis: DVec3, offset: f64| {
            let moved = offset - axis.dot(view.eye) * per_px;
            (axis * per_px).extend(moved).as_vec4().to_array()
        };
        let middle = f64::from(side) / 2.0;
        let up = view.forward.extend(-(level + view.eye.dot(view.forward)));
        Self {
            numbers: Contents::from_values(&[pack::Ground {
                x_row: row(view.right, middle),
                y_row: row(-view.up, middle),
                up: up.as_vec4().to_array(),
                side,
                strength: prepared.style.shadow.strength,
                padding_a: 0,
                padding_b: 0,
            }]),
            darkness: Contents::from_values(&darkness),
        }
    }
}

/// Level of the ground along the up direction: below everything that the camera is fitted to, or else below the whole scene.
fn level(prepared: &Prepared) -> f64 {
    let up = prepared.up();
    let kept = prepared.outline().map(|outline| {
        let points = outline.points().iter();
        points.map(|p| (*p - prepared.centre_in_world) * prepared.scale)
    });
    let lowest = |points: &mut dyn Iterator<Item = DVec3>| {
        points.map(|p| p.dot(up)).fold(f64::INFINITY, f64::min)
    };
    match kept {
        Some(mut points) => lowest(&mut points),
        None => lowest(&mut prepared.bounds.corners().into_iter()),
    }
}

/// Distance that the shadow of a point at a given height reaches from the point on the ground directly below.
fn reach(shadow: &Shadow, height: f64) -> f64 {
    height * f64::from(shadow.spread_deg).to_radians().tan()
}

/// Share of the sky hidden from each point by geometry at these heights.
fn darkness(heights: &[Option<f64>], side: usize, reach_px: impl Fn(f64) -> f64) -> Vec<f32> {
    let tallest = heights.iter().flatten().copied().fold(0.0, f64::max);
    let mut dark = vec![0.0_f64; heights.len()];
    for bin in 0..BINS {
        // Bins are closer near the ground, where shadows are sharp.
        let place = |h: f64| (h / tallest.max(1e-12)).sqrt() * (BINS - 1) as f64;
        let mut cover: Vec<f64> = (heights.iter())
            .map(|h| h.map_or(0.0, |h| (1.0 - (place(h) - bin as f64).abs()).max(0.0)))
            .collect();
        if cover.iter().all(|c| *c <= 0.0) {
            continue;
        }
        let height = tallest * (bin as f64 / (BINS - 1) as f64).powi(2);
        blur(&mut cover, side, (DEVIATION * reach_px(height)).max(1.0));
        // A column has one height: what it hides in one bin it does not hide in the other.
        dark.iter_mut().zip(cover).for_each(|(dark, c)| *dark += c);
    }
    dark.into_iter().map(|d| d.min(1.0) as f32).collect()
}

/// Blurs a square picture by three boxes along each axis; values outside are 0.
fn blur(values: &mut [f64], side: usize, deviation_px: f64) {
    // A box of width 2r + 1 has variance r (r + 1) / 3, and three boxes three times that.
    let radius = ((deviation_px * deviation_px + 0.25).sqrt() - 0.5)
        .round()
        .max(1.0) as usize;
    let mut line = vec![0.0; side];
    for stride in [1, side] {
        let across = if stride == 1 { side } else { 1 };
        for _ in 0..3 {
            for first in (0..side).map(|i| i * across) {
                let at = |i: usize| first + i * stride;
                let mut sum: f64 = (0..radius.min(side)).map(|i| values[at(i)]).sum();
                for (i, slot) in line.iter_mut().enumerate() {
                    if i + radius < side {
                        sum += values[at(i + radius)];
                    }
                    if i > radius {
                        sum -= values[at(i - radius - 1)];
                    }
                    *slot = sum / (2 * radius + 1) as f64;
                }
                for (i, value) in line.iter().enumerate() {
                    values[at(i)] = *value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blur_keeps_the_sum_and_has_its_deviation() {
        let side = 101;
        let mut values = vec![0.0; side * side];
        values[50 * side + 50] = 1.0;
        blur(&mut values, side, 6.0);
        let sum: f64 = values.iter().sum();
        let along = |i: usize| (i % side) as f64 - 50.0;
        let variance: f64 = (values.iter().enumerate())
            .map(|(i, v)| v * along(i) * along(i))
            .sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
        assert!((variance.sqrt() - 6.0).abs() < 0.5, "{}", variance.sqrt());
    }

    #[test]
    fn what_is_higher_has_a_softer_shadow() {
        let side = 64;
        let slab = |h: f64| -> Vec<Option<f64>> {
            let inside =
                |i: usize| (24..40).contains(&(i % side)) && (24..40).contains(&(i / side));
            // A mast that raises the range of heights, so that all cases use the same bins.
            let mut heights: Vec<_> = (0..side * side).map(|i| inside(i).then_some(h)).collect();
            heights[0] = Some(16.0);
            heights
        };
        // A slope belongs to two bins nearly everywhere, and is as dark.
        let slope: Vec<Option<f64>> = (0..side * side)
            .map(|i| Some((i % side) as f64 * 0.1))
            .collect();
        let dark = darkness(&slope, side, |h| h * 0.1);
        let middle = &dark[32 * side..][8..56];
        assert!(middle.iter().all(|d| *d > 0.97), "{middle:?}");
        let edge = |h: f64| {
            let dark = darkness(&slab(h), side, |h| h * 0.5);
            [dark[32 * side + 32], dark[32 * side + 43]]
        };
        let ([under, beside], [under_high, beside_high]) = (edge(0.0), edge(12.0));
        assert!(under > 0.99 && beside < 0.01, "{under} {beside}");
        assert!(
            under_high < under && beside_high > 0.05,
            "{under_high} {beside_high}"
        );
    }
}
