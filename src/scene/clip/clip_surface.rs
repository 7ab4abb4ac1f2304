//! Clip-surfaces: a plane, or a plane with an offset map, parametrised as in Trapp & Döllner 2013.
//!
//! Notation of the paper: `O` origin, `U`, `V` orthogonal directions whose lengths stretch the map, `S` scale, `OM` offset
//! map, `N = U/|U| x V/|V|`. A point is removed iff `(P - O).N + f(OM, T).Sz < 0`, with
//! `T = ((P_N - O).Û / |U| Sx, (P_N - O).V̂ / |V| Sy)`. Three errors of the paper are corrected here: its Eq. 2 lacks the
//! parentheses around `P_N - O` in the second coordinate, its `N = |U| x |V|` means the normalised directions, and its
//! listing 1 divides both coordinates by `|U|`. The surface therefore lies at distance `-f.Sz` along `N`, and the side
//! that `N` points to is kept.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::upright::directions;
use crate::scene::units::range;
use crate::scene::{Bounds, OffsetMap, Up, Wrap};

/// One clip-surface in world space.
#[derive(Clone, Debug)]
pub struct ClipSurface {
    /// `O`.
    pub origin: DVec3,
    /// `U`.
    pub u: DVec3,
    /// `V`, orthogonal to `U`.
    pub v: DVec3,
    /// `S`: map repeats per `|U|` and per `|V|`, and the height of a texel with value 1, in world units.
    pub scale: DVec3,
    /// `OM`; `None` for a plane.
    pub relief: Option<Arc<OffsetMap>>,
    /// Address mode of the map outside 0..1.
    pub wrap: Wrap,
}

/// The orthonormal frame of a clip-surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceFrame {
    /// `U / |U|`.
    pub u_hat: DVec3,
    /// `V / |V|`.
    pub v_hat: DVec3,
    /// `N`, toward the kept side.
    pub normal: DVec3,
}

impl ClipSurface {
    /// [`ClipSurface::upright`] with +Y up.
    pub fn plane(origin: DVec3, normal: DVec3) -> Self {
        Self::upright(origin, normal, Up::PlusY)
    }

    /// A plane through a point that keeps the side its normal points to. `U` and `V` depend only on the normal's direction: seen
    /// from the removed side `U` points right and `V` points down, so that an image on the plane is upright and not mirrored.
    /// In a level plane `U` is the x axis.
    pub fn upright(origin: DVec3, normal: DVec3, up: Up) -> Self {
        let [u, v] = directions(normal.normalize_or(DVec3::Z), up);
        Self {
            origin,
            u,
            v,
            scale: DVec3::ONE,
            relief: None,
            wrap: Wrap::Repeat,
        }
    }

    /// Returns the reason if the parameters are invalid: all numbers must be finite, the lengths of `U` and `V` between 1e-150 and 1e150 so
    /// that their squares neither overflow nor underflow, and the cosine of the angle between them at most 1e-6.
    pub fn defect(&self) -> Option<String> {
        let vectors = [
            ("origin", self.origin),
            ("u", self.u),
            ("v", self.v),
            ("scale", self.scale),
        ];
        if let Some((name, value)) = vectors.iter().find(|(_, v)| !v.is_finite()) {
            return Some(format!("{name} = {value} is not finite"));
        }
        if let Some((name, _)) = vectors[1..3]
            .iter()
            .find(|(_, v)| !(1e-300..=1e300).contains(&v.length_squared()))
        {
            return Some(format!(
                "{name} is too short or too long to give a direction"
            ));
        }
        let cosine = self.u.normalize().dot(self.v.normalize());
        (cosine.abs() > 1e-6).then(|| {
            format!(
                "u and v must be orthogonal, but the angle between them is {:.3}°",
                cosine.acos().to_degrees()
            )
        })
    }

    /// Returns the reason if the surface cannot be drawn with a model of these bounds: devices compute in f32, in units of the model's
    /// radius, and map repeats and heights must fit the range of f32.
    pub fn defect_beside(&self, model: &Bounds) -> Option<String> {
        if let Some(what) = self.defect() {
            return Some(what);
        }
        let farthest = self.origin.abs().max_element();
        if farthest > range::LARGEST {
            return Some(format!(
                "its origin has a coordinate of {farthest:.0e}, more than {:.0e}",
                range::LARGEST
            ));
        }
        let map = self.relief.as_ref()?;
        let [low, high] = map.range().map(|h| f64::from(h).abs());
        for height in [self.scale.z, self.scale.z * low.max(high)] {
            if let Some(what) = range::beside(height, model) {
                return Some(format!("its relief is {height:.2e} high, {what}"));
            }
        }
        let per_unit = (self.scale.x / self.u.length()).abs();
        let repeats = per_unit.max((self.scale.y / self.v.length()).abs()) * model.radius();
        (!(0.0..=range::MOST_RADII).contains(&repeats)).then(|| {
            let most = range::MOST_RADII;
            format!("its relief repeats {repeats:.0e} times across the model, more than {most:.0e}")
        })
    }

    /// `Û`, `V̂` and `N`.
    pub fn frame(&self) -> SurfaceFrame {
        let u_hat = self.u.normalize_or(DVec3::X);
        let v_hat = self.v.normalize_or(DVec3::Y);
        SurfaceFrame {
            u_hat,
            v_hat,
            normal: u_hat.cross(v_hat).normalize_or(DVec3::Z),
        }
    }

    /// `T` of a point in world space.
    pub fn map_from_world(&self, point: DVec3) -> DVec2 {
        let frame = self.frame();
        let d = point - self.origin;
        DVec2::new(
            d.dot(frame.u_hat) / self.u.length() * self.scale.x,
            d.dot(frame.v_hat) / self.v.length() * self.scale.y,
        )
    }

    /// Signed height of a point over the surface: `(P - O).N + f(OM, T).Sz`, negative where removed.
    pub fn kept_height(&self, point: DVec3) -> f64 {
        let height = self.relief.as_ref().map_or(0.0, |map| {
            map.sample(self.wrap, self.map_from_world(point)).0
        });
        (point - self.origin).dot(self.frame().normal) + height * self.scale.z
    }

    /// The same surface and relief, moved along `-N` by `distance`: removed points within that distance of the old surface are now kept.
    #[must_use]
    pub fn keeping(&self, distance: f64) -> Self {
        Self {
            origin: self.origin - self.frame().normal * distance,
            ..self.clone()
        }
    }

    /// The same surface with its map rotated in the plane about its origin by an angle in radians, `U` towards `V`.
    #[must_use]
    #[doc(hidden)]
    pub fn spun(&self, angle: f64) -> Self {
        let SurfaceFrame { u_hat, v_hat, .. } = self.frame();
        let (sine, cosine) = angle.sin_cos();
        let mut spun = self.clone();
        spun.u = (u_hat * cosine + v_hat * sine) * self.u.length();
        spun.v = (v_hat * cosine - u_hat * sine) * self.v.length();
        spun
    }

    /// The same surface keeping the other side: `N` and the heights change sign together, the map stays where it is.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let mut flipped = self.clone();
        flipped.v = -self.v;
        flipped.scale.y = -self.scale.y;
        flipped.scale.z = -self.scale.z;
        flipped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spun_surface_has_turned_heights() {
        let mut surface = ClipSurface::plane(DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, -2.0));
        surface.u *= 3.0;
        let before = surface.frame();
        let after = surface.spun(90_f64.to_radians()).frame();
        let near = |a: DVec3, b: DVec3| (a - b).length() < 1e-12;
        assert!(near(after.u_hat, before.v_hat) && near(after.v_hat, -before.u_hat));
        assert!(near(after.normal, before.normal));
        let spun = surface.spun(0.7);
        assert!((spun.u.length() - surface.u.length()).abs() < 1e-12);
        assert!(!near(spun.u, surface.u) && spun.defect().is_none());
    }

    const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp];

    /// Quasi-random points and directions: fractional parts of multiples of irrational numbers.
    fn scattered(count: u32) -> impl Iterator<Item = DVec3> {
        let step = DVec3::new(0.754_877_666, 0.569_840_291, 0.322_185_355);
        (1..=count).map(move |i| (step * f64::from(i)).fract() * 8.0 - 4.0)
    }

    fn relief(wrap: Wrap) -> ClipSurface {
        let heights = (0..35)
            .map(|i| ((i * 37 + 11) % 101) as f32 / 64.0)
            .collect();
        ClipSurface {
            origin: DVec3::new(0.3, -0.2, 0.7),
            u: DVec3::new(1.0, 2.0, -0.5),
            v: DVec3::new(2.0, -1.0, 0.0) * 0.3,
            scale: DVec3::new(0.7, -1.3, 0.4),
            relief: Some(Arc::new(
                OffsetMap::new([5, 7], heights).expect("finite heights"),
            )),
            wrap,
        }
    }

    #[test]
    fn the_flipped_surface_keeps_exactly_what_was_removed() {
        let mut surfaces: Vec<ClipSurface> = WRAPS.into_iter().map(relief).collect();
        surfaces.push(ClipSurface::plane(
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(1.0, -3.0, 0.2),
        ));
        for surface in surfaces {
            let flipped = surface.flipped();
            assert_eq!(
                flipped.frame().normal,
                -surface.frame().normal,
                "N of {surface:?}"
            );
            for p in scattered(2000) {
                assert_eq!(
                    flipped.kept_height(p),
                    -surface.kept_height(p),
                    "{:?} at {p}",
                    surface.wrap
                );
            }
        }
    }

    #[test]
    fn a_plane_has_the_normal_it_was_given() {
        for axis in DVec3::AXES {
            for normal in [axis, -axis, axis * 7.5] {
                let surface = ClipSurface::plane(DVec3::ZERO, normal);
                assert_eq!(surface.frame().normal, normal.normalize(), "N of {normal}");
                assert_eq!(surface.defect(), None, "plane of {normal}");
            }
        }
        for normal in scattered(2000) {
            let surface = ClipSurface::plane(DVec3::ZERO, normal);
            let off = (surface.frame().normal - normal.normalize()).length();
            assert!(off < 1e-15, "N of {normal} is off by {off}");
            assert_eq!(surface.defect(), None, "plane of {normal}");
        }
    }

    #[test]
    fn a_flat_relief_is_a_plane_bit_for_bit() {
        for wrap in WRAPS {
            for height in [0.0, 0.375] {
                let mut flat = relief(wrap);
                flat.relief = Some(Arc::new(
                    OffsetMap::new([5, 7], vec![height; 35]).expect("finite heights"),
                ));
                let mut plane = flat.clone();
                plane.relief = None;
                for p in scattered(2000) {
                    let raised = f64::from(height) * flat.scale.z;
                    assert_eq!(
                        flat.kept_height(p),
                        plane.kept_height(p) + raised,
                        "{wrap:?} {p}"
                    );
                }
            }
        }
    }

    /// Listing 1 of the paper divides both coordinates by `|U|`.
    fn map_as_printed(surface: &ClipSurface, point: DVec3) -> DVec2 {
        let (frame, d) = (surface.frame(), point - surface.origin);
        let length = surface.u.length();
        DVec2::new(
            d.dot(frame.u_hat) / length * surface.scale.x,
            d.dot(frame.v_hat) / length * surface.scale.y,
        )
    }

    #[test]
    fn the_printed_listing_stretches_the_map_unless_u_and_v_are_alike() {
        let mut surface = relief(Wrap::Repeat);
        // By definition the end of V is one repeat away, whatever its length.
        let end_of_v = surface.origin + surface.v;
        assert!(
            (surface.map_from_world(end_of_v).y - surface.scale.y).abs() < 1e-12,
            "V is not one step of the map"
        );
        let differing = |s: &ClipSurface| {
            scattered(1000)
                .filter(|p| (map_as_printed(s, *p) - s.map_from_world(*p)).length() > 1e-9)
                .count()
        };
        assert!(
            differing(&surface) > 990,
            "the listing should differ where |U| is not |V|"
        );
        surface.v = surface.v.normalize() * surface.u.length();
        assert_eq!(
            differing(&surface),
            0,
            "the listing is right where |U| = |V|"
        );
    }

    #[test]
    fn the_projection_onto_the_plane_leaves_t_alone() {
        // T is defined by P_N, the projection of P onto the plane; N is orthogonal to U and V, so P itself gives the same T.
        let surface = relief(Wrap::Mirror);
        let n = surface.frame().normal;
        for p in scattered(500) {
            let foot = p - n * (p - surface.origin).dot(n);
            let off = (surface.map_from_world(foot) - surface.map_from_world(p)).length();
            assert!(off < 1e-12, "T moves by {off} at {p}");
        }
    }

    #[test]
    fn senseless_parameters_have_a_defect() {
        let good = relief(Wrap::Repeat);
        assert_eq!(good.defect(), None, "the surface the others are made from");
        let change = |f: fn(&mut ClipSurface)| {
            let mut surface = good.clone();
            f(&mut surface);
            surface.defect()
        };
        for (phrase, defect) in [
            ("origin", change(|s| s.origin.y = f64::NAN)),
            ("scale", change(|s| s.scale.z = f64::INFINITY)),
            ("u is too", change(|s| s.u = DVec3::ZERO)),
            ("v is too", change(|s| s.v *= 1e160)),
            ("orthogonal", change(|s| s.v += s.u * 1e-3)),
        ] {
            let defect = defect.expect(phrase);
            assert!(
                defect.contains(phrase),
                "{defect} does not speak of {phrase}"
            );
        }
    }
}
