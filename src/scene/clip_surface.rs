//! Clip-surfaces: a plane, or a plane with an offset map, as Trapp & Döllner 2013 parametrise them.
//!
//! Notation of the paper: `O` origin, `U`, `V` orthogonal directions whose lengths stretch the map, `S` scale, `OM` offset
//! map, `N = U/|U| x V/|V|`. A point is removed iff `(P - O).N + f(OM, T).Sz < 0`, with
//! `T = ((P_N - O).Û / |U| Sx, (P_N - O).V̂ / |V| Sy)`. Three slips of the paper are mended here: its Eq. 2 lacks the
//! parentheses around `P_N - O` in the second coordinate, its `N = |U| x |V|` means the normalised directions, and its
//! listing 1 divides both coordinates by `|U|`. The surface therefore lies at distance `-f.Sz` along `N`, and the side
//! that `N` points to is kept.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{OffsetMap, Wrap};

/// One clip-surface in world space.
#[derive(Clone, Debug)]
pub struct ClipSurface {
    /// `O`.
    pub origin: DVec3,
    /// `U`.
    pub u: DVec3,
    /// `V`, orthogonal to `U`.
    pub v: DVec3,
    /// `S`: repeats of the map per `|U|` and per `|V|`, and the height of a texel of value 1 in world units.
    pub scale: DVec3,
    /// `OM`; a plane has none.
    pub relief: Option<Arc<OffsetMap>>,
    /// How the map goes on outside 0..1.
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
    /// A plane through a point that keeps the side of its normal, with `U` and `V` chosen by the direction of `N` alone.
    pub fn plane(origin: DVec3, normal: DVec3) -> Self {
        let (u, v) = normal.normalize_or(DVec3::Z).any_orthonormal_pair();
        Self {
            origin,
            u,
            v,
            scale: DVec3::ONE,
            relief: None,
            wrap: Wrap::Repeat,
        }
    }

    /// Why the parameters make no clip-surface, if they do not: the three numbers must be finite, `U` and `V` neither
    /// zero nor oblique (more than 1e-6 from a right angle).
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
            .find(|(_, v)| v.length_squared() < 1e-300)
        {
            return Some(format!("{name} has no length"));
        }
        let cosine = self.u.normalize().dot(self.v.normalize());
        (cosine.abs() > 1e-6).then(|| {
            format!(
                "u and v must be orthogonal, but the angle between them is {:.3}°",
                cosine.acos().to_degrees()
            )
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

    /// Signed amount by which a point is kept: `(P - O).N + f(OM, T).Sz`, negative where removed.
    pub fn kept_height(&self, point: DVec3) -> f64 {
        let height = self.relief.as_ref().map_or(0.0, |map| {
            map.sample(self.wrap, self.map_from_world(point)).0
        });
        (point - self.origin).dot(self.frame().normal) + height * self.scale.z
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
