//! Crossings of a ray with a clip-surface.
//!
//! `F(P) = (P - O).N + f(T(P)).Sz` is the kept height: `P` is removed iff `F < 0`. For a plane, or a relief whose texels are
//! all equal, the one root has a closed form. For any other relief see [`super::relief`].
//!
//! Crossings alternate by construction: the side at the start of a range and the number of crossings in it determine the
//! side at its end.

use cutaway::scene::{PreparedSurface, View};
use glam::{DVec2, DVec3};

use super::outline::change_per_px;
use super::relief::RayRelief;

/// The ray of a sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
}

impl Ray {
    /// The ray through a point of the picture.
    pub(super) fn through(view: &View, at_px: DVec2) -> Self {
        let (origin, direction) = view.ray(at_px);
        Self { origin, direction }
    }
}

/// A triangle of a cutter.
#[derive(Clone, Copy, Debug)]
pub(super) struct CutterTriangle {
    /// Number of the triangle.
    pub(super) triangle: u32,
    /// Range of the depths of its corners.
    pub(super) extent: f64,
}

/// A crossing of a ray with a clip-surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    /// Number of the surface.
    pub(super) surface: u16,
    /// Depth of the crossing.
    pub(super) depth: f64,
    /// True if the ray passes from the removed to the kept side.
    pub(super) to_kept: bool,
    /// Gradient of `F` in scene space.
    pub(super) gradient: DVec3,
    /// Quadratic coefficient of `F` as a function of the depth along the ray; 0 for a plane.
    pub(super) bend: f64,
    /// For a cutter, the triangle that is crossed.
    pub(super) face: Option<CutterTriangle>,
}

impl Root {
    /// Change of the root's depth when the sample moves by [`View::doubt_px`].
    pub(super) fn depth_change(&self, view: &View, ray: &Ray) -> f64 {
        let change = change_per_px(view, self.gradient, self.depth) * view.doubt_px();
        let slope = self.gradient.dot(ray.direction).abs();
        // Near a tangent point the quadratic term dominates the linear one.
        let change = (change / slope).min((change / self.bend.abs()).sqrt());
        self.face.map_or(change, |face| change.min(face.extent))
    }
}

/// A point where a ray barely misses a clip-surface, or barely crosses it twice: an extremum of `F` along the ray whose sign
/// may change when the sample moves by [`View::doubt_px`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Graze {
    /// Number of the surface.
    pub(super) surface: u16,
    /// Depth of the extremum.
    pub(super) depth: f64,
    /// True if the ray crosses the surface just before and just behind the extremum.
    pub(super) crossed: bool,
    /// True if the extremum itself is on the removed side.
    pub(super) removed: bool,
}

/// A clip-surface ready for rays.
pub(super) struct RayClipSurface {
    number: u16,
    origin: DVec3,
    normal: DVec3,
    /// Height of a flat surface over its plane.
    offset: f64,
    relief: Option<RayRelief>,
}

impl RayClipSurface {
    /// Prepares a surface for rays within a ball around the origin of scene space.
    pub(super) fn of(number: u16, surface: &PreparedSurface, radius: f64) -> Self {
        let flat = surface
            .relief
            .as_ref()
            .map(|map| map.range())
            .filter(|[lo, hi]| lo == hi);
        Self {
            number,
            origin: surface.origin,
            normal: surface.frame.normal,
            offset: flat.map_or(0.0, |[lo, _]| f64::from(lo) * surface.height_scale),
            relief: match (&surface.relief, flat) {
                (Some(map), None) => Some(RayRelief::of(surface, map.clone(), radius)),
                _ => None,
            },
        }
    }

    /// Appends the crossings in `range` in order, and returns whether the ray is on the removed side at its start.
    pub(super) fn meet(
        &self,
        view: &View,
        ray: &Ray,
        range: [f64; 2],
        roots: &mut Vec<Root>,
        grazes: &mut Vec<Graze>,
    ) -> bool {
        let base = (ray.origin - self.origin).dot(self.normal) + self.offset;
        let slope = ray.direction.dot(self.normal);
        if let Some(relief) = &self.relief {
            let line = super::relief::PlaneLine { base, slope };
            return relief.meet(view, (self.number, line), ray, range, roots, grazes);
        }
        if slope == 0.0 {
            return base < 0.0;
        }
        let depth = -base / slope;
        if depth <= range[0] {
            return slope < 0.0;
        }
        if depth < range[1] {
            roots.push(Root {
                surface: self.number,
                depth,
                to_kept: slope > 0.0,
                gradient: self.normal,
                bend: 0.0,
                face: None,
            });
        }
        slope > 0.0
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::dvec3;

    use super::*;
    use cutaway::scene::{Bounds, Camera, OffsetMap, SurfaceFrame, Wrap};

    const SIZE: u32 = 8;

    fn view() -> View {
        let bounds = Bounds {
            min: DVec3::splat(-0.5),
            max: DVec3::splat(0.5),
        };
        Camera::default().view(|p| p, 1.0, bounds, [512, 512])
    }

    fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed | 1;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    /// A relief over z = 0 with eight texels per unit and heights `f * 0.5`.
    fn surface(wrap: Wrap, mut height: impl FnMut(u32, u32) -> f64) -> PreparedSurface {
        let texels = (0..SIZE * SIZE)
            .map(|i| height(i % SIZE, i / SIZE) as f32)
            .collect();
        PreparedSurface {
            origin: DVec3::ZERO,
            frame: SurfaceFrame {
                u_hat: DVec3::X,
                v_hat: DVec3::Y,
                normal: DVec3::Z,
            },
            map_per_unit: [1.0, 1.0],
            height_scale: 0.5,
            relief: Some(Arc::new(OffsetMap::new([SIZE; 2], texels).unwrap())),
            wrap,
            volume: None,
            cut: 0,
        }
    }

    fn kept_height(s: &PreparedSurface, p: DVec3) -> f64 {
        let map = s.relief.as_ref().unwrap();
        p.z + map.sample(s.wrap, p.truncate()).0 * s.height_scale
    }

    /// Intersects a ray with a surface, checks that the crossings are consistent, and returns them.
    fn met(s: &PreparedSurface, ray: Ray, range: [f64; 2]) -> Vec<Root> {
        let (mut roots, mut grazes) = (Vec::new(), Vec::new());
        let clip = RayClipSurface::of(0, s, 2.0);
        let first = clip.meet(&view(), &ray, range, &mut roots, &mut grazes);
        let at = |t: f64| kept_height(s, ray.origin + ray.direction * t);
        assert_eq!(first, at(range[0]) < 0.0, "side at the start of {ray:?}");
        let mut removed = first;
        let mut depth = range[0];
        for root in &roots {
            assert_eq!(root.to_kept, removed, "crossings of {ray:?} alternate");
            assert!(root.depth >= depth, "crossings of {ray:?} are in order");
            assert!(
                at(root.depth).abs() < 1e-12,
                "F is {} at {}",
                at(root.depth),
                root.depth
            );
            (removed, depth) = (!removed, root.depth);
        }
        assert_eq!(removed, at(range[1]) < 0.0, "side at the end of {ray:?}");
        roots
    }

    fn ray(origin: DVec3, direction: DVec3) -> Ray {
        Ray { origin, direction }
    }

    #[test]
    fn crossings_are_those_that_sampling_finds() {
        let mut next = random(11);
        let mut crossings = 0;
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let s = surface(wrap, |_, _| next() - 0.5);
            for _ in 0..300 {
                let origin = dvec3(next() * 2.0 - 1.0, next() * 2.0 - 1.0, next() - 0.5);
                let direction = dvec3(next() - 0.5, next() - 0.5, 0.3 * (next() - 0.5));
                let roots = met(&s, ray(origin, direction), [0.0, 4.0]);
                let steps = 40_000;
                let removed: Vec<bool> = (0..=steps)
                    .map(|i| {
                        kept_height(
                            &s,
                            origin + direction * (4.0 * f64::from(i) / f64::from(steps)),
                        ) < 0.0
                    })
                    .collect();
                let sampled = removed.windows(2).filter(|w| w[0] != w[1]).count();
                let narrow = roots
                    .windows(2)
                    .filter(|w| w[1].depth - w[0].depth < 4.0 / f64::from(steps))
                    .count();
                assert!(
                    roots.len() >= sampled && roots.len() <= sampled + 2 * narrow,
                    "{} crossings, {sampled} sampled, {narrow} narrow",
                    roots.len()
                );
                crossings += roots.len();
            }
        }
        assert!(crossings > 1000, "only {crossings} crossings were checked");
    }

    #[test]
    fn rays_along_axes_borders_and_corners_keep_the_count() {
        let mut next = random(3);
        let s = surface(Wrap::Repeat, |_, _| next() - 0.5);
        let centre = |i: f64| (i + 0.5) / f64::from(SIZE);
        for i in -8..8 {
            let at = centre(f64::from(i));
            for z in [-0.2, -0.01, 0.0, 0.03, 0.11, 5.0] {
                // Along a row and a column of texel centres, between texel centres, and through texel corners.
                met(&s, ray(dvec3(-2.0, at, z), DVec3::X), [0.0, 4.0]);
                met(&s, ray(dvec3(at, -2.0, z), DVec3::Y), [0.0, 4.0]);
                met(&s, ray(dvec3(at, -2.0, z), DVec3::NEG_Y), [-4.0, 4.0]);
                met(
                    &s,
                    ray(dvec3(centre(0.0), at, z), dvec3(1.0, 1.0, 0.0)),
                    [-2.0, 2.0],
                );
                met(
                    &s,
                    ray(dvec3(centre(0.0), at, z), dvec3(1.0, -1.0, 0.05)),
                    [-2.0, 2.0],
                );
                met(
                    &s,
                    ray(dvec3(at, 0.3, z), dvec3(1e-18, 1.0, 1e-300)),
                    [-2.0, 2.0],
                );
            }
            // A ray parallel to N crosses once, wherever it starts.
            let down = met(&s, ray(dvec3(at, at, 3.0), DVec3::NEG_Z), [0.0, 6.0]);
            assert_eq!(down.len(), 1, "a height field is met once from above");
        }
    }

    #[test]
    fn ramps_and_saddles_have_their_analytic_roots() {
        // f = (x + 0.5) / 8 texels along a row of the ramp, so z = -(X - 1/16) / 2 between the outer texel centres.
        let ramp = surface(Wrap::Clamp, |x, _| f64::from(x) / f64::from(SIZE));
        let slanted = ray(dvec3(0.5, 0.3, 1.0), dvec3(0.1, 0.05, -1.0));
        let roots = met(&ramp, slanted, [0.0, 3.0]);
        // 1 - t + 0.5 (0.5 + 0.1 t - 1/16) = 0
        let expected = (1.0 + 0.5 * (0.5 - 1.0 / 16.0)) / (1.0 - 0.05);
        assert_eq!(roots.len(), 1, "a ramp is met once");
        assert!(
            (roots[0].depth - expected).abs() < 1e-12,
            "{}",
            roots[0].depth
        );

        // f = +-1 in a chequered pattern: a saddle in each cell, f = (1 - 2 x)(1 - 2 y) for cell coordinates x, y.
        let saddle = surface(
            Wrap::Repeat,
            |x, y| if (x + y) % 2 == 0 { 1.0 } else { -1.0 },
        );
        let corner = 0.5 / f64::from(SIZE);
        for (z, hits) in [(0.01, 0), (-0.01, 2), (-0.3, 2), (0.6, 0)] {
            // Along the diagonal f = (1 - 2 x)^2, with its vertex, 0, in the middle of the cell: F = z + f / 2.
            let along = ray(
                dvec3(corner, corner, z),
                dvec3(1.0, 1.0, 0.0) / f64::from(SIZE),
            );
            let roots = met(&saddle, along, [0.0, 1.0]);
            assert_eq!(roots.len(), hits, "at z = {z}");
            for root in roots {
                let expected = 0.5 * (1.0 - (-2.0f64 * z).sqrt());
                let off = (root.depth - expected)
                    .abs()
                    .min((root.depth - (1.0 - expected)).abs());
                assert!(off < 1e-9, "{} at z = {z}", root.depth);
            }
        }
    }

    #[test]
    fn tangent_rays_cross_twice_or_never_and_are_reported() {
        let saddle = surface(
            Wrap::Repeat,
            |x, y| if (x + y) % 2 == 0 { 1.0 } else { -1.0 },
        );
        let corner = 0.5 / f64::from(SIZE);
        let clip = RayClipSurface::of(0, &saddle, 2.0);
        for z in [
            0.0,
            f64::MIN_POSITIVE,
            -f64::MIN_POSITIVE,
            1e-16,
            -1e-16,
            1e-12,
            -1e-12,
            1e-4,
            -1e-4,
        ] {
            let along = ray(
                dvec3(corner, corner, z),
                dvec3(1.0, 1.0, 0.0) / f64::from(SIZE),
            );
            let (mut roots, mut grazes) = (Vec::new(), Vec::new());
            clip.meet(&view(), &along, [0.0, 1.0], &mut roots, &mut grazes);
            assert_eq!(roots.len() % 2, 0, "{} crossings at z = {z}", roots.len());
            assert_eq!(!grazes.is_empty(), z.abs() < 1e-5, "{grazes:?} at z = {z}");
        }
    }
}
