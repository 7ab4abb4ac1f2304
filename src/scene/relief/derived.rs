//! Data derived from an offset map (Trapp and Döllner 2013, section 4.2): normals and sky visibility, per texel.
//!
//! Normals use the gradient at texel centres, the mean of the four adjacent cells' gradients. The sky is sampled in slices through the
//! plane's normal; each slice searches the horizon on both sides in growing steps up to two repeats, and the sky between the horizons is
//! integrated in closed form, weighted by the cosine to the surface (the ground-truth occlusion integral of Jimenez et al. 2016).
//!
//! Cost: two texels per normal; [`SLICES`] times twice [`STEPS`] heights per sky value, on all cores. Cannot: detect occluders beyond
//! two repeats; ridges thinner than the last steps may be missed.

use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::scene::{ClipSurface, OffsetMap, Wrap};

/// Number of slices, each searched on both sides.
const SLICES: u32 = 12;
/// Number of heights sampled on each side of a slice.
const STEPS: u32 = 48;

/// Placement of a map on its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapScale {
    /// Length of one repeat along `U` and `V`, in world units.
    pub repeat: DVec2,
    /// World units for a height of 1.
    pub height: f64,
    /// Address mode outside the map.
    pub wrap: Wrap,
}

impl MapScale {
    /// Scale of a clip-surface's relief.
    pub fn of(surface: &ClipSurface) -> Self {
        let lengths = DVec2::new(surface.u.length(), surface.v.length());
        Self {
            repeat: lengths / surface.scale.truncate(),
            height: surface.scale.z,
            wrap: surface.wrap,
        }
    }
}

impl OffsetMap {
    /// Unit normals at texel centres, along `U`, `V` and the normal of the plane, row by row.
    pub fn normals(&self, scale: &MapScale) -> Vec<Vec3> {
        let places = self
            .places()
            .map(|[x, y]| self.normal(scale, x, y).as_vec3());
        places.collect()
    }

    /// Share of a uniform sky's light that reaches each texel centre, 0 to 1, row by row.
    pub fn visibility(&self, scale: &MapScale) -> Vec<f32> {
        let places: Vec<[u32; 2]> = self.places().collect();
        let visibility = places
            .par_iter()
            .map(|[x, y]| self.sky(scale, *x, *y) as f32);
        visibility.collect()
    }

    /// The same heights on a grid with at least `texels` texels along each side: a smaller map is repeated and interpolated.
    #[must_use]
    pub fn at_least(&self, texels: u32) -> Self {
        let size = self.size().map(|n| n.max(1) * texels.div_ceil(n.max(1)));
        let extent = DVec2::from(size.map(f64::from));
        let heights = (0..size[1])
            .flat_map(|y| (0..size[0]).map(move |x| DVec2::new(f64::from(x), f64::from(y))));
        let heights = heights.map(|p| self.sample(Wrap::Repeat, (p + 0.5) / extent).0 as f32);
        Self::new(size, heights.collect()).unwrap_or_else(|_| self.clone())
    }

    fn places(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [width, rows] = self.size();
        (0..rows).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    fn normal(&self, scale: &MapScale, x: u32, y: u32) -> DVec3 {
        let [x, y] = [x, y].map(i64::from);
        let rise = DVec2::new(
            self.texel(scale.wrap, x + 1, y) - self.texel(scale.wrap, x - 1, y),
            self.texel(scale.wrap, x, y + 1) - self.texel(scale.wrap, x, y - 1),
        );
        let run = 2.0 * scale.repeat / DVec2::from(self.size().map(f64::from));
        (-rise * scale.height / run).extend(1.0).normalize()
    }

    fn sky(&self, scale: &MapScale, x: u32, y: u32) -> f64 {
        let size = DVec2::from(self.size().map(f64::from));
        let at = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / size;
        let height = |t: DVec2| self.sample(scale.wrap, t).0 * scale.height;
        let own = height(at);
        let normal = self.normal(scale, x, y);
        let reach = 2.0 * scale.repeat.abs().max_element();
        let slices = (0..SLICES).map(|slice| {
            let turn = std::f64::consts::PI * (f64::from(slice) + 0.5) / f64::from(SLICES);
            let along = DVec2::from_angle(turn);
            // Angle from the plane's normal, negative backwards.
            let horizon = |way: f64| {
                let steepest = (0..STEPS).fold(f64::NEG_INFINITY, |steepest: f64, step| {
                    let share = (f64::from(step) + 1.0) / f64::from(STEPS);
                    let far = reach * share * share;
                    let rise = height(at + along * (way * far) / scale.repeat) - own;
                    steepest.max(rise / far)
                });
                way * (std::f64::consts::FRAC_PI_2 - steepest.atan())
            };
            let (sideways, upright) = (normal.truncate().dot(along), normal.z);
            let tilt = sideways.atan2(upright);
            let quarter = std::f64::consts::FRAC_PI_2;
            let behind = tilt + (horizon(-1.0) - tilt).max(-quarter);
            let ahead = tilt + (horizon(1.0) - tilt).min(quarter);
            let side = |h: f64| -(2.0 * h - tilt).cos() + tilt.cos() + 2.0 * h * tilt.sin();
            sideways.hypot(upright) / 4.0 * (side(behind) + side(ahead))
        });
        (slices.sum::<f64>() / f64::from(SLICES)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(width: f64, height: f64) -> MapScale {
        MapScale {
            repeat: DVec2::new(width, 1.0),
            height,
            wrap: Wrap::Repeat,
        }
    }

    fn profile(count: u32, height: impl Fn(f64) -> f64) -> OffsetMap {
        let texels = (0..count).map(|i| height((f64::from(i) + 0.5) / f64::from(count)) as f32);
        OffsetMap::new([count, 1], texels.collect()).unwrap_or_else(|e| panic!("{e}"))
    }

    #[test]
    fn normals_are_those_of_the_heights() {
        let tau = std::f64::consts::TAU;
        let map = profile(4096, |t| 0.5 + 0.5 * (tau * t).cos());
        let scale = scale(3.0, 0.4);
        let normals = map.normals(&scale);
        let most = normals.iter().enumerate().map(|(i, normal)| {
            let t = (i as f64 + 0.5) / 4096.0;
            let slope = -0.5 * tau * (tau * t).sin() * scale.height / scale.repeat.x;
            let truth = DVec3::new(-slope, 0.0, 1.0).normalize();
            truth.angle_between(normal.as_dvec3())
        });
        let most = most.fold(0.0, f64::max);
        assert!(most < 1e-3, "{most}");
        // If heights are linear within cells, normals match the slope of the heights, except for the rounding of texels.
        let ramp = profile(64, |t| t);
        let normals = ramp.normals(&scale);
        let truth = DVec3::new(-scale.height / scale.repeat.x, 0.0, 1.0).normalize();
        for normal in &normals[1..63] {
            assert!(truth.angle_between(normal.as_dvec3()) < 1e-5, "{normal}");
        }
        let seam = truth.angle_between(normals[0].as_dvec3());
        assert!(seam > 0.1, "the control: the seam is steep, by {seam}");
    }

    #[test]
    fn the_sky_over_a_saw_tooth_has_its_closed_form() {
        // Slopes of 45 degrees, twice as wide as deep.
        let map = profile(256, |t| {
            if t < 0.5 {
                1.0 - 2.0 * t
            } else {
                2.0 * t - 1.0
            }
        });
        let sky = map.visibility(&scale(2.0, 1.0));
        let mut squares = 0.0;
        for (i, visible) in sky.iter().enumerate() {
            let x = 2.0 * (i as f64 + 0.5) / 256.0;
            let depth = if x < 1.0 { x } else { 2.0 - x };
            // Down the point's own slope, and up to the ridge beyond the valley.
            let own = DVec2::new(1.0, -1.0).normalize();
            let ridge = DVec2::new(2.0 - depth, depth).normalize();
            let truth = (1.0 + own.dot(ridge)) / 2.0;
            squares += (f64::from(*visible) - truth).powi(2);
        }
        let rms = (squares / 256.0).sqrt();
        assert!(rms < 0.02, "{rms}");
        let (least, most) = sky
            .iter()
            .fold((1.0_f32, 0.0_f32), |(a, b), v| (a.min(*v), b.max(*v)));
        assert!(least < 0.53 && most > 0.83, "{least} to {most}");
        let flat = profile(8, |_| 0.5).visibility(&scale(2.0, 1.0));
        assert!(flat.iter().all(|v| (v - 1.0).abs() < 1e-6), "{flat:?}");
    }
}
