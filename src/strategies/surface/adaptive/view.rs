//! View-dependent part of a tessellation: the error tolerated at each depth, and which part is visible.
//!
//! A point of the surface that is off by e along the normal appears off by at most `f sqrt(1 + r²) e / (w - e)` pixels, where f is the
//! focal length in pixels, r the tangent of the angle between the viewing direction and the farthest corner of the picture, and w the depth
//! of the point: this is the norm of the matrix that maps a step in space to one in the picture, at the least depth on the way. So e may be
//! `TAU w / (f sqrt(1 + r²) + TAU)`. With parallel rays e appears as at most e / pixel, at every depth.

use glam::{DVec2, DVec3};

use crate::passes::Input;
use crate::plan::pack::{BORDERS_OF_DOMAIN, Domain, Refinement, box_margin};
use crate::scene::{PreparedSurface, View};

/// The range of depths is divided into this many units: half the range of i32.
const DEPTH_UNITS: f64 = (1_u32 << 30) as f64;
/// Rounding error of f32 in border values, in scene units.
const BORDER_MARGIN: f64 = 1e-4;

/// The row of the clip-surface at the given table index.
pub(super) fn refinement(
    input: &Input<'_>,
    index: usize,
    row: &Domain,
    tau_px: f64,
    capacity: u32,
) -> Refinement {
    let view = input.view;
    let number = input.active_cuts.surfaces[index];
    let surface = &input.model.prepared.surfaces[number];
    let heights = surface.slab();
    let mut refinement: Refinement = bytemuck::Zeroable::zeroed();
    refinement.capacity = capacity;
    refinement.borders = borders(input, row, heights, surface);
    // A plane is never halved.
    if input.model.is_relief(number) {
        let (depth, unit) = depths(view, row, heights, surface);
        refinement.depth = depth;
        let per_depth = error_per_depth(view, tau_px) * unit / surface.height_scale.abs();
        refinement.error_per_depth = (per_depth * 0.999_999) as f32;
    }
    refinement
}

/// The error in scene units that is invisible at depth 1, or at any depth if rays are parallel.
fn error_per_depth(view: &View, tau_px: f64) -> f64 {
    let pixel = view.pixel_size(1.0);
    if view.orthographic {
        return tau_px * pixel;
    }
    let [width, height] = view.size_px.map(f64::from);
    let corners = [
        DVec2::ZERO,
        DVec2::new(width, 0.0),
        DVec2::new(0.0, height),
        DVec2::new(width, height),
    ];
    let widest = corners
        .map(|c| view.ray(c).1.length())
        .into_iter()
        .fold(1.0, f64::max);
    tau_px / (widest / pixel + tau_px)
}

/// Least depth of the surface in whole units, and the depth of one unit.
fn depths(
    view: &View,
    row: &Domain,
    heights: [f64; 2],
    surface: &PreparedSurface,
) -> ([i32; 4], f64) {
    if view.orthographic {
        return ([1, 0, 0, 1], 1.0);
    }
    let [corner, step_x, step_y] = [row.corner, row.step_x, row.step_y].map(vector);
    let [x, y] = [step_x, step_y].map(|step| step.dot(view.forward));
    let steps = row
        .patches
        .map(|n| f64::from(n) * f64::from(1_u32 << (row.patch_bits + row.step_bits)));
    let tilt = surface.frame.normal.dot(view.forward);
    let nearest = (heights.map(|h| -h * tilt).into_iter()).fold(f64::INFINITY, f64::min);
    let first = view.depth_of(corner) + nearest;
    // Bound on all intermediate sums, including boxes around middles, which extend beyond the domain.
    let greatest = first.abs()
        + 3.0 * (steps[0] * x.abs() + steps[1] * y.abs())
        + view.near
        + 3.0 * steps[0].max(steps[1]) * (x.abs() + y.abs());
    let unit = greatest.max(1e-6) / DEPTH_UNITS;
    // The rounding of the slopes, accumulated over the whole domain, is subtracted.
    let slack = 1.5 * (steps[0] + steps[1]) + 2.0;
    let row = [
        (first / unit - slack).floor() as i32,
        (x / unit).round() as i32,
        (y / unit).round() as i32,
        (view.near / unit).floor() as i32,
    ];
    (row, unit)
}

/// The borders, as functions of vertices: the greatest value over the map's height range.
fn borders(
    input: &Input<'_>,
    row: &Domain,
    heights: [f64; 2],
    surface: &PreparedSurface,
) -> [[f32; 4]; BORDERS_OF_DOMAIN] {
    let view = input.view;
    let cut_box = &input.active_cuts.cut_box;
    let mut planes: Vec<(DVec3, f64)> = sides_of_view(view).to_vec();
    let beyond = box_margin(view, cut_box);
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        planes.push((axis, beyond - cut_box.min.dot(axis)));
        planes.push((-axis, beyond + cut_box.max.dot(axis)));
    }
    let [corner, step_x, step_y] = [row.corner, row.step_x, row.step_y].map(vector);
    let mut borders = [[0.0; 4]; BORDERS_OF_DOMAIN];
    for (border, (normal, offset)) in borders.iter_mut().zip(planes) {
        let tilt = surface.frame.normal.dot(normal);
        let relief = (heights.map(|h| -h * tilt).into_iter()).fold(f64::NEG_INFINITY, f64::max);
        let margin = BORDER_MARGIN * (1.0 + normal.length());
        *border = [
            (corner.dot(normal) + offset + relief + margin) as f32,
            step_x.dot(normal) as f32,
            step_y.dot(normal) as f32,
            0.0,
        ];
    }
    borders
}

/// The near plane and the four sides of the picture as normal and offset: positive inside.
fn sides_of_view(view: &View) -> [(DVec3, f64); 5] {
    let [width, height] = view.size_px.map(f64::from);
    let middle = DVec2::new(width, height) * 0.5;
    let side = |at: DVec2, along: DVec3| {
        // A plane contains the rays through one side of the picture; the picture's centre is inside.
        let (origin, ray) = view.ray(at);
        let normal = along.cross(ray).normalize_or(view.forward);
        let (eye, towards) = view.ray(middle);
        let is_inside = normal.dot(eye + towards * (2.0 * view.near.max(1e-3)) - origin);
        let normal = if is_inside < 0.0 { -normal } else { normal };
        (normal, -normal.dot(origin))
    };
    [
        (view.forward, -view.forward.dot(view.eye) - view.near),
        side(DVec2::new(0.0, middle.y), view.up),
        side(DVec2::new(width, middle.y), view.up),
        side(DVec2::new(middle.x, 0.0), view.right),
        side(DVec2::new(middle.x, height), view.right),
    ]
}

fn vector(row: [f32; 4]) -> DVec3 {
    let [x, y, z, _] = row.map(f64::from);
    DVec3::new(x, y, z)
}
