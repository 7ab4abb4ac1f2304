//! Views from a host's camera matrices, and its depth buffer.
//!
//! A host already has a camera: its pose (`world_from_view`) and projection (`clip_from_view`), with depth from 0 to 1 as in WebGPU,
//! Direct3D and Metal. Both matrices are column-major, like glam's. A perspective camera looks along the direction of `z` in which
//! `w` grows, a parallel one along negative `z`, as in glam's right-handed matrices. Off-centre projections and sub-pixel jitter are
//! kept. Cannot: draw pixels that are not square, or a mirrored world.

use glam::{DMat4, DVec2, DVec3};

use crate::scene::{Precision, Prepared, View};
use crate::{Error, Result};

/// Tolerance for non-square pixels and for axes without unit length.
const TOLERANCE: f64 = 1e-4;

/// Map from the distance to the eye, along the viewing direction, to the depth buffer of a host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostDepth {
    /// `(x d + y) / (z d + w)` is the depth at distance `d`, in world units.
    pub coefficients: [f64; 4],
}

impl HostDepth {
    /// Depth map of a projection matrix.
    pub fn from_projection(clip_from_view: &DMat4) -> Self {
        let sign = forward_sign(clip_from_view);
        let [z, t] = [clip_from_view.z_axis, clip_from_view.w_axis];
        Self {
            coefficients: [z.z * sign, t.z, z.w * sign, t.w],
        }
    }

    /// The depth at a distance.
    pub fn at(&self, distance: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        (a * distance + b) / (c * distance + d)
    }

    /// The depth of infinitely far points, clamped to the range of a buffer.
    pub fn far(&self) -> f64 {
        let [a, _, c, _] = self.coefficients;
        let far = match c {
            0.0 if a < 0.0 => 0.0,
            0.0 => 1.0,
            c => a / c,
        };
        far.clamp(0.0, 1.0)
    }

    /// Returns true if nearer points have the greater depth.
    pub fn is_reversed(&self) -> bool {
        let [a, b, c, d] = self.coefficients;
        // The sign of the derivative, which is the same at every distance.
        a * d - b * c < 0.0
    }

    /// The distance at a depth.
    fn distance(&self, depth: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        (b - depth * d) / (depth * c - a)
    }
}

impl Prepared {
    /// The view of a host's camera, for a picture of the given size.
    ///
    /// # Errors
    ///
    /// If pixels are not square, the axes are not a rotation, or the matrix is not a projection.
    pub fn view_from(
        &self,
        world_from_view: &DMat4,
        clip_from_view: &DMat4,
        size_px: [u32; 2],
    ) -> Result<View> {
        let fault = |what: String, help: &str| Error::input("the camera of the host", what, help);
        let p = clip_from_view;
        let orthographic = p.z_axis.w == 0.0;
        let sign = forward_sign(p);
        let axes = [world_from_view.x_axis, world_from_view.y_axis].map(|a| a.truncate());
        let [right, up] = [axes[0] * p.x_axis.x.signum(), axes[1] * p.y_axis.y.signum()];
        let forward = world_from_view.z_axis.truncate() * sign;
        let lengths = [right, up, forward].map(|a| (a.length() - 1.0).abs());
        if !lengths.iter().all(|l| *l <= TOLERANCE) {
            return Err(fault(
                "its axes do not have length 1".to_owned(),
                "give a rotation and a translation, without a scale",
            ));
        }
        if (right.cross(up).dot(forward) + 1.0).abs() > TOLERANCE {
            return Err(fault(
                "its picture is mirrored, or its axes are not at right angles".to_owned(),
                "give a rotation and a translation, and a projection that does not mirror",
            ));
        }
        let [width, height] = size_px.map(f64::from);
        let (half_width, half_height) = (1.0 / p.x_axis.x.abs(), 1.0 / p.y_axis.y.abs());
        let aspect = half_width / half_height * height / width;
        let is_square = (aspect - 1.0).abs() <= TOLERANCE;
        if !is_square {
            return Err(fault(
                format!("its pixels are not square: they are {aspect} times as wide as high"),
                "give a projection with the aspect ratio of the picture",
            ));
        }
        // Where in the picture the viewing direction points.
        let middle = match orthographic {
            true => p.w_axis.truncate().truncate() / p.w_axis.w,
            false => p.z_axis.truncate().truncate() / p.z_axis.w,
        };
        let depth = HostDepth::from_projection(p);
        let near = [0.0, 1.0].map(|z| depth.distance(z));
        let near = near.into_iter().filter(|d| d.is_finite());
        let near = near.fold(f64::INFINITY, f64::min);
        if !near.is_finite() {
            return Err(fault(
                "its projection has no near plane".to_owned(),
                "give a projection with depth from 0 to 1",
            ));
        }
        let lengths = match orthographic {
            true => self.scale / p.w_axis.w,
            false => 1.0,
        };
        let scene_from_world = |point: DVec3| (point - self.centre_in_world) * self.scale;
        let view = View {
            size_px,
            centre_px: DVec2::new((middle.x + 1.0) * width, (1.0 - middle.y) * height) * 0.5,
            eye: scene_from_world(world_from_view.w_axis.truncate()),
            right: right.normalize(),
            up: up.normalize(),
            forward: forward.normalize(),
            half_height: half_height * lengths,
            orthographic,
            near: near * self.scale,
            far: near * self.scale + self.bounds.radius().max(1e-9),
            near_cap: true,
            band: [0, size_px[1]],
            halo_rows: [0; 2],
            fineness: 1,
            precision: Precision::USUAL,
        };
        let view = self.seen_to_the_end(view);
        match view.defect() {
            Some(what) => Err(fault(what, "move it nearer to the model")),
            None => Ok(view),
        }
    }
}

/// 1 if the camera looks along `z`, -1 if it looks in the opposite direction.
fn forward_sign(clip_from_view: &DMat4) -> f64 {
    match clip_from_view.z_axis.w > 0.0 {
        true => 1.0,
        false => -1.0,
    }
}

#[cfg(test)]
mod tests {
    use glam::dcamera::rh::proj::directx::{
        orthographic, perspective, perspective_infinite_reverse,
    };
    use glam::dcamera::rh::view::look_at_mat4;

    use super::*;
    use crate::generate::shapes::shape;
    use crate::scene::{Camera, Projection, Scene, Viewpoint};

    fn prepared() -> Prepared {
        Prepared::new(&Scene {
            parts: shape("crank").unwrap(),
            ..Scene::default()
        })
    }

    fn camera(projection: Projection) -> Camera {
        Camera {
            viewpoint: Viewpoint::Explicit {
                position: DVec3::new(3.0, 2.0, 4.0),
                focal_point: DVec3::new(0.1, -0.2, 0.0),
                view_up: None,
            },
            projection,
            near: Some(0.5),
            ..Camera::default()
        }
    }

    #[test]
    fn the_matrices_of_a_camera_are_that_camera() {
        let prepared = prepared();
        let size_px = [320, 200];
        let aspect = 1.6;
        let (eye, focus) = (DVec3::new(3.0, 2.0, 4.0), DVec3::new(0.1, -0.2, 0.0));
        let world_from_view = look_at_mat4(eye, focus, DVec3::Y).inverse();
        let fov = 40.0_f64.to_radians();
        for (clip_from_view, projection) in [
            (
                perspective_infinite_reverse(fov, aspect, 0.5),
                Projection::Perspective { fov_y_deg: 40.0 },
            ),
            (
                perspective(fov, aspect, 0.5, 90.0),
                Projection::Perspective { fov_y_deg: 40.0 },
            ),
            (
                orthographic(-1.6, 1.6, -1.0, 1.0, 0.5, 90.0),
                Projection::Orthographic { height: Some(2.0) },
            ),
        ] {
            let view = prepared
                .view_from(&world_from_view, &clip_from_view, size_px)
                .unwrap();
            let own = prepared.view_of(&camera(projection), size_px);
            for (a, b) in [
                (view.eye, own.eye),
                (view.right, own.right),
                (view.up, own.up),
                (view.forward, own.forward),
                (view.centre_px.extend(0.0), own.centre_px.extend(0.0)),
            ] {
                assert!((a - b).length() < 1e-9, "{a} is not {b}");
            }
            for (a, b) in [(view.half_height, own.half_height), (view.near, own.near)] {
                assert!((a - b).abs() < 1e-9, "{a} is not {b}");
            }
            assert_eq!(view.orthographic, own.orthographic);
            // A point lands where the host puts it, at the depth that the host gives it.
            let point = DVec3::new(0.2, 0.1, -0.3);
            let clip = clip_from_view * world_from_view.inverse() * point.extend(1.0);
            let ndc = clip.truncate() / clip.w;
            let in_scene = (point - prepared.centre_in_world) * prepared.scale;
            let (at, depth) = view.project(in_scene);
            let expected = DVec2::new((ndc.x + 1.0) * 160.0, (1.0 - ndc.y) * 100.0);
            assert!((at - expected).length() < 1e-6, "{at} is not {expected}");
            let host = HostDepth::from_projection(&clip_from_view).at(depth / prepared.scale);
            assert!((host - ndc.z).abs() < 1e-9, "{host} is not {}", ndc.z);
        }
    }

    #[test]
    fn depth_knows_which_end_is_far() {
        let reversed = HostDepth::from_projection(&perspective_infinite_reverse(1.0, 1.0, 0.1));
        assert!(reversed.is_reversed() && reversed.far() == 0.0);
        let usual = HostDepth::from_projection(&perspective(1.0, 1.0, 0.1, 10.0));
        assert!(!usual.is_reversed() && usual.far() == 1.0);
        let parallel = HostDepth::from_projection(&orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 10.0));
        assert!(!parallel.is_reversed() && parallel.far() == 1.0);
    }

    #[test]
    fn matrices_that_are_no_camera_are_refused() {
        let prepared = prepared();
        let good = perspective(1.0, 1.6, 0.1, 10.0);
        let mirrored = good * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        for (world_from_view, clip_from_view, what) in [
            (DMat4::from_scale(DVec3::splat(2.0)), good, "length 1"),
            (DMat4::IDENTITY, mirrored, "mirrored"),
            (
                DMat4::IDENTITY,
                perspective(1.0, 1.0, 0.1, 10.0),
                "not square",
            ),
            (DMat4::IDENTITY, DMat4::ZERO, "not square"),
        ] {
            let refused = prepared.view_from(&world_from_view, &clip_from_view, [320, 200]);
            let message = refused.unwrap_err().to_string();
            assert!(message.contains(what), "{message}");
        }
    }
}
