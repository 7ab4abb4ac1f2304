//! The camera as the user specifies it, and the [`View`] that it resolves to.
//!
//! An orbit looks at the model from a direction, at a distance that shows everything it is fitted to ([`Fit`]): the model's box, or the
//! silhouette of the geometry that the cuts keep. An explicit viewpoint is not moved.

use glam::{DVec2, DVec3};

use crate::scene::describe::Described;
use crate::scene::geometry::fitting::{fit_parallel, fit_perspective};
use crate::scene::{Bounds, Precision, Up, View};

/// Projection of depth onto the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Vertical field of view in degrees.
    Perspective {
        /// Between the lower and the upper border of the picture.
        fov_y_deg: f64,
    },
    /// Parallel rays; the picture's height in world units, or fitted if it is `None`.
    Orthographic {
        /// World units from the lower to the upper border.
        height: Option<f64>,
    },
}

/// Position of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// On a sphere around the model, far enough to show all parts.
    Orbit {
        /// Turn about the up axis, from the front.
        azimuth_deg: f64,
        /// Height above the horizon.
        elevation_deg: f64,
    },
    /// In an explicit direction, far enough to show everything it is fitted to.
    Along {
        /// Into the picture, in world space.
        forward: DVec3,
        /// Direction that points up in the picture.
        view_up: DVec3,
    },
    /// An explicit position in world space.
    Explicit {
        /// The eye.
        position: DVec3,
        /// The point in the middle of the picture.
        focal_point: DVec3,
        /// Direction that points up in the picture; `None` is the up axis.
        view_up: Option<DVec3>,
    },
}

/// Geometry that an orbit is fitted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Described)]
pub enum Fit {
    /// The box of the whole model, regardless of the cuts.
    #[default]
    All,
    /// The kept geometry's silhouette, centred, with a margin of 6 % of the picture's shorter side. See [`Outline`](crate::scene::Outline).
    Kept,
}

/// The camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the eye.
    pub viewpoint: Viewpoint,
    /// Projection of depth onto the picture.
    pub projection: Projection,
    /// Up axis.
    pub up: Up,
    /// Distance of the near plane in world units; `None` picks one just before the model.
    pub near: Option<f64>,
    /// Geometry that an orbit is fitted to.
    pub fit: Fit,
    /// Magnification relative to the fitted size.
    pub zoom: f64,
    /// Shift of the picture to the right and up, in picture heights. The eye does not move, so occlusion does not change.
    pub pan: DVec2,
    /// Draw a cap where the near plane cuts a solid. Without it, a ray that starts inside a solid shows the surface or cap that it *enters*
    /// next, not the near plane's section or the wall where it leaves. Strategies recognise that wall by its back faces, and `exact`
    /// recognises it by counting crossings; they agree if faces point outward and no mesh overlaps itself.
    pub near_cap: bool,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            viewpoint: Viewpoint::Orbit {
                azimuth_deg: 35.0,
                elevation_deg: 25.0,
            },
            projection: Projection::Perspective { fov_y_deg: 30.0 },
            up: Up::PlusY,
            near: None,
            fit: Fit::All,
            zoom: 1.0,
            pan: DVec2::ZERO,
            near_cap: true,
        }
    }
}

/// Smallest near distance, as a share of the scene's radius: nearer points are not drawn.
const NEAR_SHARE: f64 = 1e-3;

/// Share of the picture that the model's box fills in an orbit.
const FILL: f64 = 0.92;

impl Camera {
    /// The view of a scene. `scene_from_world` maps world points to scene space. `bounds` is the scene's box in scene space; an orbit is
    /// fitted to it.
    pub fn view(
        &self,
        scene_from_world: impl Fn(DVec3) -> DVec3,
        scale: f64,
        bounds: Bounds,
        size_px: [u32; 2],
    ) -> View {
        self.view_fitted(scene_from_world, scale, (bounds, &[]), size_px)
    }

    /// Returns true if the eye's position depends on the kept geometry.
    #[doc(hidden)]
    pub fn fits_kept(&self) -> bool {
        self.fit == Fit::Kept && !matches!(self.viewpoint, Viewpoint::Explicit { .. })
    }

    /// Like [`Camera::view`], but if the outline, in world space, is not empty, an orbit is fitted to the outline.
    pub(crate) fn view_fitted(
        &self,
        scene_from_world: impl Fn(DVec3) -> DVec3,
        scale: f64,
        (bounds, outline): (Bounds, &[DVec3]),
        size_px: [u32; 2],
    ) -> View {
        let radius = bounds.radius().max(1e-9);
        let centre = bounds.centre();
        let up_axis = self.up.axis();
        let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
        let orthographic = matches!(self.projection, Projection::Orthographic { .. });
        let forward = match self.viewpoint {
            Viewpoint::Orbit {
                azimuth_deg,
                elevation_deg,
            } => -self.up.direction([azimuth_deg, elevation_deg]),
            Viewpoint::Along { forward, .. } => forward.normalize_or(-DVec3::Z),
            Viewpoint::Explicit {
                position,
                focal_point,
                ..
            } => {
                (scene_from_world(focal_point) - scene_from_world(position)).normalize_or(-DVec3::Z)
            }
        };
        let up_hint = match self.viewpoint {
            Viewpoint::Explicit {
                view_up: Some(up), ..
            }
            | Viewpoint::Along { view_up: up, .. } => up,
            _ => up_axis,
        };
        let right = forward
            .cross(up_hint)
            .try_normalize()
            .unwrap_or_else(|| forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let axes = [right, up, forward];
        let is_kept = self.fits_kept() && !outline.is_empty();
        let kept: Option<Vec<DVec3>> = is_kept.then(|| {
            let points = outline.iter().map(|p| scene_from_world(*p));
            points
                .map(|p| DVec3::from_array(axes.map(|axis| p.dot(axis))))
                .collect()
        });
        // Extent of the corners from the picture's centre.
        let reach = bounds.corners().map(|c| {
            let d = c - centre;
            DVec3::new(d.dot(right), d.dot(up), d.dot(forward))
        });
        let height_for = |r: &DVec3| (r.x.abs() / aspect).max(r.y.abs()) / FILL;
        let parallel = kept
            .as_ref()
            .filter(|_| orthographic)
            .map(|points| fit_parallel(points, size_px));
        let half_height = match (self.projection, parallel) {
            (Projection::Perspective { fov_y_deg }, _) => (fov_y_deg.to_radians() * 0.5).tan(),
            (
                Projection::Orthographic {
                    height: Some(height),
                },
                _,
            ) => height * scale * 0.5,
            (Projection::Orthographic { height: None }, Some((_, half_height))) => half_height,
            (Projection::Orthographic { height: None }, None) => {
                reach.iter().map(height_for).fold(1e-9, f64::max)
            }
        };
        let eye = match (self.viewpoint, &kept) {
            (Viewpoint::Explicit { position, .. }, _) => scene_from_world(position),
            (_, Some(points)) => {
                let at = match parallel {
                    Some((middle, _)) => middle.extend(centre.dot(forward) - radius * 2.0),
                    None => fit_perspective(points, half_height, size_px),
                };
                right * at.x + up * at.y + forward * at.z
            }
            (_, None) if orthographic => centre - forward * (radius * 2.0),
            (_, None) => {
                let distances = reach.iter().map(|r| height_for(r) / half_height - r.z);
                centre - forward * distances.fold(1e-6, f64::max)
            }
        };
        let depths = bounds.corners().map(|c| (c - eye).dot(forward));
        let nearest = depths.iter().copied().fold(f64::INFINITY, f64::min);
        let farthest = depths.iter().copied().fold(NEAR_SHARE * radius, f64::max);
        let near = match self.near {
            Some(near) => near * scale,
            None => (nearest * 0.99).max(NEAR_SHARE * radius),
        };
        View {
            size_px,
            centre_px: DVec2::new(f64::from(size_px[0]), f64::from(size_px[1])) * 0.5
                + DVec2::new(self.pan.x, -self.pan.y) * f64::from(size_px[1]),
            eye,
            right,
            up,
            forward,
            half_height: half_height / self.zoom,
            orthographic,
            near,
            far: near + 2.0 * (farthest - near).max(radius),
            near_cap: self.near_cap,
            band: [0, size_px[1]],
            halo_rows: [0; 2],
            fineness: 1,
            precision: Precision::USUAL,
        }
    }
}

/// Named viewing directions, as azimuth and elevation in degrees.
pub const STANDARD_VIEWS: [(&str, [f64; 2]); 7] = [
    ("front", [0.0, 0.0]),
    ("back", [180.0, 0.0]),
    ("left", [-90.0, 0.0]),
    ("right", [90.0, 0.0]),
    ("top", [0.0, 90.0]),
    ("bottom", [0.0, -90.0]),
    // All three axes are foreshortened equally: the elevation is atan(1 / sqrt 2).
    ("iso", [45.0, 35.264_389_682_754_654]),
];
