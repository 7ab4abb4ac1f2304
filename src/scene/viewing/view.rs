//! Pixel rays and the meaning of depth, in scene space, for a resolved camera.
//!
//! *Depth* is the distance from the eye along the viewing direction, so a ray's direction has length 1 along `forward` and its
//! parameter is the depth. The depth buffer is reversed (near = 1) with an infinite far plane: `z = near / depth` in perspective, where
//! f32 keeps a relative precision of 2^-24 at every distance; linear in orthographic views, with the far plane behind everything.

use glam::{DMat4, DVec2, DVec3, DVec4};

use crate::scene::Bounds;

/// A camera resolved for one scene and one resolution, in scene space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Point of the picture that lies in the viewing direction: the middle, unless the picture is shifted by a fraction of a pixel.
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
    /// True if rays are parallel.
    pub orthographic: bool,
    /// Depth of the near plane.
    pub near: f64,
    /// Depth behind everything; only orthographic views use it.
    pub far: f64,
    /// True if the near plane makes caps.
    pub near_cap: bool,
    /// Index of this band's first row, and height of the whole picture ([`View::rows`]); 0 and its own height for a whole picture.
    pub band: [u32; 2],
    /// Number of rows at the top and at the bottom that are drawn only as neighbours for effects: the picture does not keep them.
    pub halo_rows: [u32; 2],
    /// Number of views along each side of a pixel that form one picture ([`View::sampled_at`]); effect filters shrink accordingly.
    pub fineness: u32,
    /// Precision of triangle placement in the evaluated picture. Plans use the precision in their
    /// [`DrawOptions`](crate::strategies::DrawOptions) instead.
    pub precision: Precision,
}

/// Precision with which a rasteriser places triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Precision {
    /// Sub-pixel bits: vertices are snapped to 2^-bits of a pixel.
    pub sub_pixel_bits: u32,
    /// True if depths are interpolated from screen-space slopes in f32, as fixed-function hardware may do; the compute rasteriser computes
    /// each sample's depth from the triangle's plane.
    pub slopes_in_f32: bool,
}

impl Precision {
    /// Precision of the compute rasteriser.
    pub const USUAL: Self = Self {
        sub_pixel_bits: USUAL_SUB_PIXEL_BITS,
        slopes_in_f32: false,
    };

    /// Returns true if there are fewer sub-pixel bits than usual.
    pub fn is_coarse(&self) -> bool {
        self.sub_pixel_bits < USUAL_SUB_PIXEL_BITS
    }

    /// Ratio of the vertex snapping distance to the distance at the usual sub-pixel bits: 16 for 4 bits.
    pub fn coarseness(&self) -> f64 {
        f64::from(1_u32 << USUAL_SUB_PIXEL_BITS.saturating_sub(self.sub_pixel_bits))
    }
}

/// Sub-pixel bits of llvmpipe and of the compute rasteriser. Vulkan guarantees 4.
pub const USUAL_SUB_PIXEL_BITS: u32 = 8;
/// Up to this picture size, in pixels along a side, f32 coordinates are as precise as the snapping of vertices.
const FINE_SIZE_PX: u32 = 2048;

impl View {
    /// Returns the reason if the view cannot be drawn: rays are computed in f32, in radii of the model, and lengths are squared.
    pub fn defect(&self) -> Option<String> {
        let axes = [self.right, self.up, self.forward];
        if let Some(axis) = axes
            .iter()
            .find(|a| (a.length() - 1.0).abs() > 1e-6 || !a.is_finite())
        {
            return Some(format!("it has the direction {axis}, not of length 1"));
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
                "half the picture's height is {:.0e} radii of the model",
                self.half_height
            )
        })
    }
}

/// Greatest distance of the eye, in radii of the model.
const FARTHEST_EYE: f64 = 1e15;

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

    /// This view with its sample points at `at` within each pixel; (0.5, 0.5) gives the same view. The views for a grid of such points
    /// together form one finer picture, without a larger frame.
    #[must_use]
    pub fn sampled_at(&self, at: DVec2) -> Self {
        Self {
            centre_px: self.centre_px - (at - 0.5),
            ..*self
        }
    }

    /// The views of a grid of `count` points along each side of a pixel, each with its grid position: together they form one picture.
    pub fn samples(&self, count: u32) -> impl Iterator<Item = ([u32; 2], Self)> + use<> {
        let view = *self;
        let places = (0..count).flat_map(move |j| (0..count).map(move |i| [i, j]));
        places.map(move |place| {
            let [x, y] = place.map(f64::from);
            let at = (DVec2::new(x, y) + 0.5) / f64::from(count);
            let sample = Self {
                fineness: count,
                ..view.sampled_at(at)
            };
            (place, sample)
        })
    }

    /// The view of some of the rows, with the same rays through them: its pixel (x, y) is pixel (x, `first` + y) of this one.
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

    /// Projects a point to pixels, with its depth. Points at depth 0 have no meaningful projection in perspective.
    pub fn project(&self, point: DVec3) -> (DVec2, f64) {
        let d = point - self.eye;
        let depth = self.depth_of(point);
        let k = 1.0 / (self.plane_per_px() * if self.orthographic { 1.0 } else { depth });
        let at = DVec2::new(d.dot(self.right), -d.dot(self.up)) * k;
        (self.centre_px + at, depth)
    }

    /// Depth of a point: its distance from the eye along the viewing direction.
    pub fn depth_of(&self, point: DVec3) -> f64 {
        (point - self.eye).dot(self.forward)
    }

    /// The depth of a box's farthest point, or the near plane's depth if the whole box is in front of that plane.
    pub(crate) fn farthest_in(&self, bounds: &Bounds) -> f64 {
        let depths = bounds.corners().map(|c| self.depth_of(c));
        depths.into_iter().fold(self.near, f64::max)
    }

    /// Distance in pixels within which an outline leaves a sample undecided. Snapping moves an edge by up to half a step along each axis;
    /// f32 rounding moves the edge by less than that again up to 2048 px, and by more in larger pictures.
    pub fn doubt_px(&self) -> f64 {
        let size_px = self.size_px[0].max(self.band[1]);
        f64::from(size_px.max(FINE_SIZE_PX))
            / f64::from(FINE_SIZE_PX << self.precision.sub_pixel_bits)
    }

    /// Edge length of a pixel at a depth, in scene units.
    pub fn pixel_size(&self, depth: f64) -> f64 {
        self.plane_per_px() * if self.orthographic { 1.0 } else { depth }
    }

    /// A depth in front of the near plane by `slack`, but never behind the eye.
    #[doc(hidden)]
    pub fn before_near(&self, slack: f64) -> f64 {
        let most = if self.orthographic {
            f64::INFINITY
        } else {
            0.5 * self.near
        };
        self.near - slack.min(most)
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

    /// Returns true if the near plane meets a box: then a solid in it may be cut by the near plane.
    pub fn near_plane_meets(&self, bounds: &Bounds) -> bool {
        let depths = bounds.corners().map(|c| self.depth_of(c));
        depths.iter().any(|d| *d < self.near) && depths.iter().any(|d| *d > self.near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Projection};

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
