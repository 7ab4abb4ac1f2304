//! Turns cameras so that cut faces are visible: from a default viewpoint, half of all sections show only their backs.

use glam::DVec3;

use crate::scene::{Bounds, Camera, ClipSurface, Cut, Up, Viewpoint};

/// A cut face counts as seen if the cosine of the angle between its normal and the view is greater than this.
const LEAST_COSINE: f64 = 0.1;

impl Viewpoint {
    /// Looks straight at a clip-surface's plane, from the side that it removes. Up in the picture is the plane's upright direction, as in
    /// [`ClipSurface::upright`].
    pub fn facing(surface: &ClipSurface, up: Up) -> Self {
        let normal = surface.frame().normal;
        let upright = ClipSurface::upright(surface.origin, normal, up);
        Self::Along {
            forward: normal,
            view_up: -upright.v,
        }
    }
}

impl Camera {
    /// This orbit, a mirrored one or one from behind, whichever sees most of the cuts' faces; in a tie, this one. An explicit
    /// viewpoint is unchanged.
    #[must_use]
    pub fn facing<'a>(self, cuts: impl IntoIterator<Item = &'a Cut, IntoIter: Clone>) -> Self {
        let viewpoint = self.viewpoint_facing(cuts.into_iter(), [true; 2]);
        Self { viewpoint, ..self }
    }

    /// As [`Camera::facing`], but `free` decides whether azimuth and elevation may change.
    #[doc(hidden)]
    pub fn viewpoint_facing<'a>(
        &self,
        cuts: impl Iterator<Item = &'a Cut> + Clone,
        free: [bool; 2],
    ) -> Viewpoint {
        let Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } = self.viewpoint
        else {
            return self.viewpoint;
        };
        let azimuths: &[f64] = match free[0] {
            true => &[
                azimuth_deg,
                -azimuth_deg,
                azimuth_deg + 180.0,
                -azimuth_deg - 180.0,
            ],
            false => &[azimuth_deg],
        };
        let elevations: &[f64] = match free[1] {
            true => &[elevation_deg, -elevation_deg],
            false => &[elevation_deg],
        };
        let mut best = (0, self.viewpoint);
        for elevation_deg in elevations.iter().copied() {
            for azimuth_deg in azimuths.iter().copied() {
                let viewpoint = Viewpoint::Orbit {
                    azimuth_deg,
                    elevation_deg,
                };
                let camera = Self { viewpoint, ..*self };
                // An orbit's viewing direction does not depend on the geometry, so any bounds will do.
                let anything = Bounds::from_points([DVec3::ZERO, DVec3::ONE]);
                let forward = camera.view(|p| p, 1.0, anything, [1, 1]).forward;
                let enabled = cuts.clone().filter(|c| c.enabled);
                let seen = enabled
                    .flat_map(|c| &c.surfaces)
                    .filter(|s| s.frame().normal.dot(forward) > LEAST_COSINE)
                    .count();
                if seen > best.0 {
                    best = (seen, viewpoint);
                }
            }
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_turns_to_whichever_side_is_cut_away() {
        for normal in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X, DVec3::NEG_Y] {
            let cut = Cut::new("cut", vec![ClipSurface::plane(DVec3::ZERO, normal)]);
            let camera = Camera::default().facing([&cut]);
            let anything = Bounds::from_points([DVec3::ZERO, DVec3::ONE]);
            let forward = camera.view(|p| p, 1.0, anything, [1, 1]).forward;
            assert!(forward.dot(normal) > LEAST_COSINE, "{normal}: {forward}");
        }
        assert_eq!(Camera::default().facing([]), Camera::default(), "no cut");
    }
}
