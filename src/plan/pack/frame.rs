//! Mapping from scene space to pixels.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

use super::Layout;
use super::layout::{matrix, row};
use crate::scene::{Bounds, Precision, View};

shared! {
    /// Mapping from scene space to pixels: `shaders/lib/frame.wgsl`.
    Frame {
        /// Maps scene space to clip space.
        clip_from_scene: [f32; 16],
        /// Ray origin at pixel (0, 0), change per pixel right, change per pixel down.
        ray_origin: [[f32; 4]; 3],
        /// Ray direction at pixel (0, 0), change per pixel right, change per pixel down.
        ray_direction: [[f32; 4]; 3],
        /// Steps of one pixel right and one pixel down, in scene space.
        ray_step: [[f32; 4]; 2],
        /// Viewing direction.
        forward: [f32; 4],
        /// Least corner of the box around the cut solids.
        box_min: [f32; 4],
        /// Greatest corner of the box around the cut solids.
        box_max: [f32; 4],
        /// Size of the picture in pixels.
        size_px: [u32; 2],
        /// Depth of the near plane.
        near: f32,
        /// A depth behind everything.
        far: f32,
        /// 1 if rays are parallel.
        orthographic: u32,
        /// 1 if the near plane makes caps.
        near_cap: u32,
        /// First row of this band, and number of rows of the whole picture.
        band: [u32; 2],
    }
}

/// Minimum margin of the box around the cut solids, so that no solid lies in a face of the box.
const BOX_MARGIN: f64 = 1e-4;

/// Maximum margin on adapters with the usual number of sub-pixel bits, for pictures of any size.
const MOST_BOX_MARGIN: f64 = 9e-4;

/// Margin in pixels at the farthest point of the box: fixed-function hardware may cover samples next to a solid, because vertices move by
/// half of 1/16 px along each axis on adapters with the fewest sub-pixel bits. If such a fragment's ray misses the box, the crossings
/// in front of it are not known.
const BOX_MARGIN_PX: f64 = 1.0 / 16.0;

/// Largest margin of the box around the cut solids: relief traversals have room for it, and tessellations extend farther
/// beyond the solids. Grid pitches depend on it, so it does not change with the camera.
pub(crate) fn most_box_margin(precision: Precision) -> f64 {
    MOST_BOX_MARGIN * precision.coarseness()
}

/// Margin of the box around the cut solids in a view.
pub(crate) fn box_margin(view: &View, cut_box: &Bounds) -> f64 {
    let most = most_box_margin(view.precision);
    (BOX_MARGIN_PX * view.pixel_size(view.farthest_in(cut_box))).clamp(BOX_MARGIN, most)
}

/// The frame of a view; `cut_box` is the box around the cut solids.
pub fn frame(view: &View, cut_box: &Bounds) -> Frame {
    let (o0, d0) = view.ray(DVec2::ZERO);
    let (ox, dx) = view.ray(DVec2::X);
    let (oy, dy) = view.ray(DVec2::Y);
    // In orthographic views the ray origin moves with the pixel, in perspective views the direction.
    let step = if view.orthographic {
        [ox - o0, oy - o0]
    } else {
        [dx - d0, dy - d0]
    };
    let margin = DVec3::splat(box_margin(view, cut_box));
    Frame {
        clip_from_scene: matrix(view.clip_from_scene()),
        ray_origin: [row(o0), row(ox - o0), row(oy - o0)],
        ray_direction: [row(d0), row(dx - d0), row(dy - d0)],
        ray_step: step.map(row),
        forward: row(view.forward),
        box_min: row(cut_box.min - margin),
        box_max: row(cut_box.max + margin),
        size_px: view.size_px,
        near: view.near as f32,
        far: view.far as f32,
        orthographic: u32::from(view.orthographic),
        near_cap: u32::from(view.near_cap),
        band: view.band,
    }
}
