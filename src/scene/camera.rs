//! The camera as the user states it, and the [`View`] it resolves to in scene space.
//!
//! A [`View`] answers for both sides what the ray of a pixel is and what its depth means. *Depth* is the distance from the
//! eye along the viewing direction, so a ray's direction has length 1 along `forward` and its parameter is the depth.
//! The depth buffer is reversed (near = 1) with an infinite far plane: `z = near / depth` in perspective, where f32 keeps
//! a relative precision of 2^-24 at every distance; linear in orthographic views, with the far plane behind everything.

use glam::{DMat4, DVec2, DVec3, DVec4};

use super::Bounds;

/// How depth narrows the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Vertical field of view in degrees.
    Perspective {
        /// Between the lower and the upper border of the picture.
        fov_y_deg: f64,
    },
    /// Parallel rays; the height of the picture in world units, or what shows everything.
    Orthographic {
        /// World units from the lower to the upper border.
        height: Option<f64>,
    },
}

/// Which axis of the world points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Up {
    /// The habit of graphics.
    #[default]
    PlusY,
    /// The habit of CAD and printing.
    PlusZ,
}

impl Up {
    /// As a direction.
    pub fn axis(self) -> DVec3 {
        match self {
            Self::PlusY => DVec3::Y,
            Self::PlusZ => DVec3::Z,
        }
    }
}

/// Where the eye is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// On a sphere around the model, far enough to show all of it.
    Orbit {
        /// Turn about the up axis, from the front.
        azimuth_deg: f64,
        /// Height above the horizon.
        elevation_deg: f64,
    },
    /// Given outright, in world space.
    Explicit {
        /// The eye.
        position: DVec3,
        /// The point in the middle of the picture.
        focal_point: DVec3,
        /// Direction that points up in the picture; `None` is the up axis.
        view_up: Option<DVec3>,
    },
}

/// The camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub viewpoint: Viewpoint,
    /// How depth narrows the picture.
    pub projection: Projection,
    /// Which axis is up.
    pub up: Up,
    /// Distance of the near plane in world units; `None` picks one just before the model.
    pub near: Option<f64>,
    /// How much larger than so everything is shown.
    pub zoom: f64,
    /// Draw a cap where the near plane cuts a solid. Without it a ray that begins inside a solid shows what it *enters* next, a
    /// surface or a cap: neither the near plane's section nor the wall by which it leaves. Strategies tell that wall by its back,
    /// exact by counting; they agree where faces face outward and no mesh overlaps itself.
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
            zoom: 1.0,
            near_cap: true,
        }
    }
}

/// A camera resolved for one scene and one resolution, in scene space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Where in the picture the viewing direction points: the middle, unless the picture is shifted by parts of a pixel.
    pub centre_px: DVec2,
    /// The eye.
    pub eye: DVec3,
    /// Unit vector to the right border.
    pub right: DVec3,
    /// Unit vector to the upper border.
    pub up: DVec3,
    /// Unit vector into the picture.
    pub forward: DVec3,
    /// Perspective: the picture's half height at depth 1. Orthographic: the picture's half height.
    pub half_height: f64,
    /// Parallel rays.
    pub orthographic: bool,
    /// Depth of the near plane.
    pub near: f64,
    /// Depth behind everything; only orthographic views use it.
    pub far: f64,
    /// Whether the near plane makes caps.
    pub near_cap: bool,
    /// The first row and all rows of the picture that this is a band of, by [`View::rows`]; of a whole picture 0 and its height.
    pub band: [u32; 2],
    /// How many such views along each side make one picture, by [`View::sampled_at`]: effects that filter see so much less of a pixel.
    pub fineness: u32,
}

impl View {
    /// Why the view cannot be drawn, if it cannot: rays are computed in f32, in radii of the model, and lengths are squared.
    pub fn defect(&self) -> Option<String> {
        let axes = [self.right, self.up, self.forward];
        if let Some(axis) = axes
            .iter()
            .find(|a| (a.length() - 1.0).abs() > 1e-6 || !a.is_finite())
        {
            return Some(format!("it has the direction {axis}"));
        }
        let far = self.eye.abs().max_element();
        if !(0.0..=FARTHEST_EYE).contains(&far) {
            return Some(format!(
                "it is {far:.0e} radii from the model, more than {FARTHEST_EYE:.0e}"
            ));
        }
        let extents = 1.0 / FARTHEST_EYE..=FARTHEST_EYE;
        (!extents.contains(&self.half_height)).then(|| {
            format!(
                "the picture is {:.0e} high in radii of the model",
                self.half_height
            )
        })
    }
}

/// So many radii of the model the eye may be away.
const FARTHEST_EYE: f64 = 1e15;

/// Smallest near distance, as a share of the scene's radius: nearer points are not drawn.
const NEAR_SHARE: f64 = 1e-3;

/// Share of the picture that the model's box fills in an orbit.
const FILL: f64 = 0.92;

impl Camera {
    /// The view of a scene. `scene_from_world` takes world points to scene space; `bounds` are those of the scene there.
    pub fn view(
        &self,
        scene_from_world: impl Fn(DVec3) -> DVec3,
        scale: f64,
        bounds: Bounds,
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
            } => -orbit_direction(self.up, azimuth_deg, elevation_deg),
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
            } => up,
            _ => up_axis,
        };
        let right = forward
            .cross(up_hint)
            .try_normalize()
            .unwrap_or_else(|| forward.any_orthonormal_vector());
        let up = right.cross(forward);
        // How far the corners reach from the middle of the picture.
        let reach = bounds.corners().map(|c| {
            let d = c - centre;
            DVec3::new(d.dot(right), d.dot(up), d.dot(forward))
        });
        let height_for = |r: &DVec3| (r.x.abs() / aspect).max(r.y.abs()) / FILL;
        let half_height = match self.projection {
            Projection::Perspective { fov_y_deg } => (fov_y_deg.to_radians() * 0.5).tan(),
            Projection::Orthographic {
                height: Some(height),
            } => height * scale * 0.5,
            Projection::Orthographic { height: None } => {
                reach.iter().map(height_for).fold(1e-9, f64::max)
            }
        };
        let eye = match self.viewpoint {
            Viewpoint::Explicit { position, .. } => scene_from_world(position),
            Viewpoint::Orbit { .. } if orthographic => centre - forward * (radius * 2.0),
            Viewpoint::Orbit { .. } => {
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
            centre_px: DVec2::new(f64::from(size_px[0]), f64::from(size_px[1])) * 0.5,
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
            fineness: 1,
        }
    }
}

fn orbit_direction(up: Up, azimuth_deg: f64, elevation_deg: f64) -> DVec3 {
    let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
    let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
    match up {
        Up::PlusY => DVec3::new(sin_a * cos_e, sin_e, cos_a * cos_e),
        Up::PlusZ => DVec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e),
    }
}

impl View {
    /// Origin and direction of the ray through a point of the picture, in pixels from the upper left corner (pixel centres
    /// are at halves). The ray's parameter is the depth.
    pub fn ray(&self, at_px: DVec2) -> (DVec3, DVec3) {
        let plane = self.right * self.plane_x(at_px.x) + self.up * self.plane_y(at_px.y);
        if self.orthographic {
            (self.eye + plane, self.forward)
        } else {
            (self.eye, self.forward + plane)
        }
    }

    fn plane_x(&self, x_px: f64) -> f64 {
        (x_px - self.centre_px.x) * self.plane_per_px()
    }

    fn plane_y(&self, y_px: f64) -> f64 {
        (self.centre_px.y - y_px) * self.plane_per_px()
    }

    pub(crate) fn plane_per_px(&self) -> f64 {
        2.0 * self.half_height / f64::from(self.size_px[1])
    }

    /// The view whose pixel centres lie elsewhere in the pixels of this one: `at` is (0.5, 0.5) for the same view. All the
    /// views of a grid of such points make one picture that is finer, without a larger frame.
    #[must_use]
    pub fn sampled_at(&self, at: DVec2) -> Self {
        Self {
            centre_px: self.centre_px - (at - 0.5),
            ..*self
        }
    }

    /// The view of some of the rows, with the same rays through them: pixel (x, y) of it is pixel (x, `first` + y) of this one.
    #[must_use]
    pub fn rows(&self, first: u32, count: u32) -> Self {
        let share = f64::from(count) / f64::from(self.size_px[1]);
        Self {
            size_px: [self.size_px[0], count],
            centre_px: self.centre_px - DVec2::Y * f64::from(first),
            half_height: self.half_height * share,
            band: [self.band[0] + first, self.band[1]],
            ..*self
        }
    }

    /// Where a point lands in the picture, in pixels, and its depth. Points at depth 0 land nowhere sensible in perspective.
    pub fn project(&self, point: DVec3) -> (DVec2, f64) {
        let d = point - self.eye;
        let depth = d.dot(self.forward);
        let k = 1.0 / (self.plane_per_px() * if self.orthographic { 1.0 } else { depth });
        let at = DVec2::new(d.dot(self.right), -d.dot(self.up)) * k;
        (self.centre_px + at, depth)
    }

    /// Edge length of a pixel at a depth, in scene units.
    pub fn pixel_size(&self, depth: f64) -> f64 {
        self.plane_per_px() * if self.orthographic { 1.0 } else { depth }
    }

    /// Value of the reversed depth buffer at a depth.
    pub fn buffer_from_depth(&self, depth: f64) -> f64 {
        if self.orthographic {
            (self.far - depth) / (self.far - self.near)
        } else {
            self.near / depth
        }
    }

    /// Depth of a value of the reversed depth buffer.
    pub fn depth_from_buffer(&self, z: f64) -> f64 {
        if self.orthographic {
            self.far - z * (self.far - self.near)
        } else {
            self.near / z
        }
    }

    /// The matrix to clip space: reversed depth, infinite far plane in perspective.
    pub fn clip_from_scene(&self) -> DMat4 {
        let aspect = f64::from(self.size_px[0]) / f64::from(self.size_px[1]);
        let (sx, sy) = (1.0 / (self.half_height * aspect), 1.0 / self.half_height);
        let view_from_scene = DMat4::from_cols(
            DVec4::new(self.right.x, self.up.x, self.forward.x, 0.0),
            DVec4::new(self.right.y, self.up.y, self.forward.y, 0.0),
            DVec4::new(self.right.z, self.up.z, self.forward.z, 0.0),
            DVec4::new(
                -self.right.dot(self.eye),
                -self.up.dot(self.eye),
                -self.forward.dot(self.eye),
                1.0,
            ),
        );
        let span = self.far - self.near;
        let clip_from_view = if self.orthographic {
            DMat4::from_cols(
                DVec4::new(sx, 0.0, 0.0, 0.0),
                DVec4::new(0.0, sy, 0.0, 0.0),
                DVec4::new(0.0, 0.0, -1.0 / span, 0.0),
                DVec4::new(0.0, 0.0, self.far / span, 1.0),
            )
        } else {
            DMat4::from_cols(
                DVec4::new(sx, 0.0, 0.0, 0.0),
                DVec4::new(0.0, sy, 0.0, 0.0),
                DVec4::new(0.0, 0.0, 0.0, 1.0),
                DVec4::new(0.0, 0.0, self.near, 0.0),
            )
        };
        // The middle of clip space is the middle of the picture, wherever the view is centred.
        let [w, h] = self.size_px.map(f64::from);
        let mut shift = DMat4::IDENTITY;
        shift.w_axis.x = 2.0 * self.centre_px.x / w - 1.0;
        shift.w_axis.y = 1.0 - 2.0 * self.centre_px.y / h;
        shift * clip_from_view * view_from_scene
    }

    /// Whether the near plane meets a box: then a solid in it may be cut by the near plane.
    pub fn near_plane_meets(&self, bounds: &Bounds) -> bool {
        let depths = bounds.corners().map(|c| (c - self.eye).dot(self.forward));
        depths.iter().any(|d| *d < self.near) && depths.iter().any(|d| *d > self.near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn views() -> Vec<View> {
        let bounds = Bounds {
            min: DVec3::splat(-0.5),
            max: DVec3::splat(0.5),
        };
        [
            Projection::Perspective { fov_y_deg: 40.0 },
            Projection::Orthographic { height: None },
        ]
        .map(|projection| {
            Camera {
                projection,
                ..Camera::default()
            }
            .view(|p| p, 1.0, bounds, [320, 200])
        })
        .into_iter()
        .flat_map(|view| [view, view.sampled_at(DVec2::new(0.125, 0.875))])
        .collect()
    }

    #[test]
    fn ray_project_and_matrix_agree() {
        for view in views() {
            for at in [
                DVec2::new(0.5, 0.5),
                DVec2::new(160.0, 100.0),
                DVec2::new(300.25, 17.0),
            ] {
                let (origin, direction) = view.ray(at);
                let depth = view.near * 1.7;
                let point = origin + direction * depth;
                let (landed, landed_depth) = view.project(point);
                assert!((landed - at).length() < 1e-9, "{landed} is not {at}");
                assert!(
                    (landed_depth - depth).abs() < 1e-12,
                    "{landed_depth} is not {depth}"
                );
                let clip = view.clip_from_scene() * point.extend(1.0);
                let ndc = clip / clip.w;
                assert!(
                    (ndc.x - (2.0 * at.x / 320.0 - 1.0)).abs() < 1e-9,
                    "x of {ndc}"
                );
                assert!(
                    (ndc.y - (1.0 - 2.0 * at.y / 200.0)).abs() < 1e-9,
                    "y of {ndc}"
                );
                assert!(
                    (ndc.z - view.buffer_from_depth(depth)).abs() < 1e-12,
                    "z of {ndc}"
                );
                assert!(
                    (view.depth_from_buffer(ndc.z) - depth).abs() < 1e-9,
                    "depth of {ndc}"
                );
            }
        }
    }

    #[test]
    fn views_of_one_pixel_make_a_finer_picture() {
        let bounds = Bounds {
            min: DVec3::splat(-0.5),
            max: DVec3::splat(0.5),
        };
        let of = |size| Camera::default().view(|p| p, 1.0, bounds, size);
        let (view, finer) = (of([320, 200]), of([640, 400]));
        for [i, j] in [[0, 0], [1, 0], [0, 1], [1, 1]].map(|s| s.map(f64::from)) {
            let sampled = view.sampled_at((DVec2::new(i, j) + 0.5) / 2.0);
            let (_, ray) = sampled.ray(DVec2::new(17.5, 33.5));
            let (_, expected) = finer.ray(DVec2::new(34.5 + i, 66.5 + j));
            assert!((ray - expected).length() < 1e-12, "{ray} is not {expected}");
        }
    }

    #[test]
    fn rows_of_a_view_have_its_rays() {
        for view in views() {
            for (first, count) in [(0, 200), (0, 50), (50, 50), (100, 100), (33, 67)] {
                let band = view.rows(first, count);
                let at = DVec2::new(17.5, 13.5);
                let [(origin, ray), (o, d)] =
                    [band.ray(at), view.ray(at + DVec2::Y * f64::from(first))];
                let apart = (origin - o).length() + (ray - d).length();
                assert!(apart < 1e-12, "rows from {first}: {apart} apart");
                let clip = band.clip_from_scene() * (o + d * view.near * 2.0).extend(1.0);
                let px = (clip.y / clip.w * -0.5 + 0.5) * f64::from(count);
                assert!((px - at.y).abs() < 1e-9, "rows from {first}: at {px}");
            }
        }
    }

    #[test]
    fn all_of_the_model_is_in_the_picture() {
        for view in views() {
            let bounds = Bounds {
                min: DVec3::splat(-0.5),
                max: DVec3::splat(0.5),
            };
            for corner in bounds.corners() {
                let (at, depth) = view.project(corner);
                assert!(
                    at.cmpge(DVec2::ZERO).all() && at.cmple(DVec2::new(320.0, 200.0)).all(),
                    "{corner} lands at {at}"
                );
                assert!(depth > view.near, "{corner} is before the near plane");
            }
        }
    }
}
