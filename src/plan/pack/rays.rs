//! Clip-surfaces in coordinates along the rays of a view, with the cancellation between eye and plane done in f64.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};

use super::{Layout, MAX_SURFACES, slab_over_row, texels_per_unit};
use crate::scene::{PreparedSurface, View};

/// Maximum number of clip-surfaces that are evaluated four at a time: `shaders/lib/along_ray/planes.wgsl`.
pub const MOST_PLANES: usize = 8;

/// Error of a height over the plane, as a fraction of the terms that it is summed from: 16 roundings of f32, where 8 suffice.
const HEIGHT_ROUNDING: f64 = 1e-6;

shared! {
    /// A value that is linear in pixel position and depth: `shaders/lib/along_ray/rays.wgsl`.
    RayRow {
        /// Value at depth 0 and pixel (0, 0), change per pixel right, change per pixel down.
        origin: [f32; 4],
        /// The same three numbers for the change per unit of depth.
        direction: [f32; 4],
    }
}

shared! {
    /// A clip-surface in ray form: `shaders/lib/along_ray/rays.wgsl`.
    RaySurface {
        /// Height over the plane.
        height: RayRow,
        /// x texel coordinate.
        texel_x: RayRow,
        /// y texel coordinate.
        texel_y: RayRow,
    }
}

shared! {
    /// Heights over four planes in ray form, a component of each vector for each plane: `shaders/lib/along_ray/rays.wgsl`.
    RaysOfFour {
        /// The numbers of `RayRow::origin`.
        origin: [[f32; 4]; 3],
        /// The numbers of `RayRow::direction`.
        direction: [[f32; 4]; 3],
        /// Heights above which a point is kept for certain.
        kept_above: [f32; 4],
        /// Heights below which a point is removed for certain.
        removed_below: [f32; 4],
        /// Error of a height per unit of depth.
        rounding: [f32; 4],
    }
}

shared! {
    /// All clip-surfaces in ray form: `shaders/lib/along_ray/rays.wgsl`.
    RayTable {
        /// The clip-surfaces.
        surfaces: [RaySurface; MAX_SURFACES],
        /// Heights over the first of them once more.
        planes: [RaysOfFour; MOST_PLANES / 4],
    }
}

/// Clip-surfaces in a view's ray form.
pub fn ray_table<'a>(surfaces: impl Iterator<Item = &'a PreparedSurface>, view: &View) -> RayTable {
    let mut table = RayTable::zeroed();
    for four in &mut table.planes {
        // Where there is no clip-surface, everything is kept, and the order of the two shows that there is no slab.
        (four.kept_above, four.removed_below) = ([-2.0; 4], [-1.0; 4]);
    }
    for (i, surface) in surfaces.enumerate() {
        let rays = ray_surface(surface, view);
        table.surfaces[i] = rays;
        if let Some(four) = table.planes.get_mut(i / 4) {
            let RayRow { origin, direction } = rays.height;
            for row in 0..3 {
                four.origin[row][i % 4] = origin[row];
                four.direction[row][i % 4] = direction[row];
            }
            let [least, greatest] = slab_over_row(surface);
            let [at_eye, per_depth] = [origin, direction].map(|row| most_in_picture(row, view));
            let margin = HEIGHT_ROUNDING * (least.abs() + greatest.abs() + 1.25 * at_eye);
            four.kept_above[i % 4] = (margin - least) as f32;
            four.removed_below[i % 4] = (-greatest - margin) as f32;
            four.rounding[i % 4] = (HEIGHT_ROUNDING * per_depth) as f32;
        }
    }
    table
}

/// The largest sum of the magnitudes of a linear value's terms in the picture.
fn most_in_picture(row: [f32; 4], view: &View) -> f64 {
    let [width, height] = view.size_px.map(f64::from);
    let [value, right, down, _] = row.map(|c| f64::from(c).abs());
    value + width * right + height * down
}

/// A clip-surface in a view's ray form, with the cancellation between eye and plane done in f64.
fn ray_surface(surface: &PreparedSurface, view: &View) -> RaySurface {
    let (o0, d0) = view.ray(DVec2::ZERO);
    let (ox, dx) = view.ray(DVec2::X);
    let (oy, dy) = view.ray(DVec2::Y);
    let linear = |direction: DVec3, factor: f64, offset: f64| {
        let n = direction * factor;
        RayRow {
            origin: [
                (o0 - surface.origin).dot(n) + offset,
                (ox - o0).dot(n),
                (oy - o0).dot(n),
                0.0,
            ]
            .map(|c| c as f32),
            direction: [d0.dot(n), (dx - d0).dot(n), (dy - d0).dot(n), 0.0].map(|c| c as f32),
        }
    };
    let t = texels_per_unit(surface);
    RaySurface {
        height: linear(
            surface.frame.normal,
            1.0,
            surface.flat_height().unwrap_or(0.0),
        ),
        texel_x: linear(surface.frame.u_hat, t[0], -0.5),
        texel_y: linear(surface.frame.v_hat, t[1], -0.5),
    }
}
