//! Chooses how rays walk through reliefs, cell by cell or over a pyramid, by the expected number of cells that a ray passes.
//!
//! The number of cells that a ray passes is texel density x distance through the height slab x sine of the ray's angle to the normal. It
//! varies over the picture: the mean is taken over a grid of rays, counting those that meet the box of the cut solids and the slab.
//!
//! Once a session has chosen the pyramid it keeps it: otherwise a camera near the threshold would rebuild it in every other frame. The cost
//! is a few percent to a quarter of the walk, in later views that meet few cells.

use glam::{DVec2, DVec3};

use crate::passes::{Input, ReliefWalk};
use crate::scene::{Bounds, PreparedSurface, View};

/// Expected number of cells from which the pyramid is used. Measured on Mesa's llvmpipe, time of the cell walk relative to the pyramid: 17
/// cells 0.8, 27 and 42 about 1, 60 to 150 0.9 to 1.7 (256 x 256 texels, fractal); 65 cells 1.4, 106 1.6, 319 2.4, 600 3.0 (1024 x 1024);
/// on smooth maps the pyramid is slower up to about 70 cells. A map that is rebuilt in every frame needs more.
const CELLS_FOR_PYRAMID: f64 = 40.0;
/// Rays along each side of the picture, or of the rectangle that may contain the box of the cut solids.
const RAYS: u32 = 12;

/// The choice and its reason, worded for readers of the plan.
pub(super) struct WalkChoice {
    pub(super) walk: ReliefWalk,
    pub(super) reason: String,
}

/// The choice for the reliefs of a frame, or the walk that the options request.
pub(super) fn of(input: &Input<'_>) -> WalkChoice {
    if !input.pyramids_fit() {
        return WalkChoice {
            walk: ReliefWalk::Cells,
            reason: "reliefs are walked cell by cell: their pyramids are too large".to_owned(),
        };
    }
    let cells = expected_cells(input);
    let (walk, asked) = match input.relief_walk {
        Some(walk) => (walk, ", as asked for"),
        None if input.capacities.pyramids => (ReliefWalk::Pyramid, ", as in frames before"),
        None if cells < CELLS_FOR_PYRAMID => (ReliefWalk::Cells, ""),
        None => (ReliefWalk::Pyramid, ""),
    };
    let how = match walk {
        ReliefWalk::Cells => "walked cell by cell",
        ReliefWalk::Pyramid => "passed over by a pyramid",
    };
    WalkChoice {
        walk,
        reason: format!("reliefs are {how}{asked}: a ray meets about {cells:.0} cells"),
    }
}

/// The mean number of relief cells passed by a ray that meets the slab.
fn expected_cells(input: &Input<'_>) -> f64 {
    let cut_box = &input.active_cuts.cut_box;
    let [low, high] = seen(cut_box, input.view);
    let numbers = input.active_cuts.surfaces.iter();
    let surfaces = numbers.filter(|s| input.model.is_relief(**s));
    let (mut cells, mut met) = (0.0, 0_u32);
    for surface in surfaces.map(|s| &input.model.prepared.surfaces[*s]) {
        for ray in 0..RAYS * RAYS {
            let at = DVec2::new(f64::from(ray % RAYS), f64::from(ray / RAYS)) + 0.5;
            let at = low + (high - low) * at / f64::from(RAYS);
            let (origin, direction) = input.view.ray(at);
            let interval = within(cut_box, origin, direction, input.view.near);
            if let Some(passed) = interval.and_then(|i| passed(surface, origin, direction, i)) {
                cells += passed;
                met += 1;
            }
        }
    }
    if met == 0 {
        0.0
    } else {
        cells / f64::from(met)
    }
}

/// The rectangle of the picture, in pixels, that may contain a box: the whole picture if part of the box is behind the eye.
fn seen(bounds: &Bounds, view: &View) -> [DVec2; 2] {
    let size = DVec2::from(view.size_px.map(f64::from));
    let clip = bounds
        .corners()
        .map(|c| view.clip_from_scene() * c.extend(1.0));
    if clip.iter().any(|c| c.w <= 0.0) {
        return [DVec2::ZERO, size];
    }
    let at = clip.map(|c| (DVec2::new(c.x, -c.y) / c.w * 0.5 + 0.5) * size);
    let low = at.into_iter().fold(size, DVec2::min).max(DVec2::ZERO);
    let high = at.into_iter().fold(DVec2::ZERO, DVec2::max).min(size);
    [low.min(high), high]
}

/// Depths at which a ray enters and leaves a box.
fn within(bounds: &Bounds, origin: DVec3, direction: DVec3, near: f64) -> Option<[f64; 2]> {
    let (a, b) = (
        (bounds.min - origin) / direction,
        (bounds.max - origin) / direction,
    );
    let enter = a.min(b).max_element().max(near);
    let leave = a.max(b).min_element();
    (enter < leave).then_some([enter, leave])
}

/// The number of relief cells that a ray passes inside an interval of depths, if it meets the slab there.
fn passed(
    surface: &PreparedSurface,
    origin: DVec3,
    direction: DVec3,
    [enter, leave]: [f64; 2],
) -> Option<f64> {
    let map = surface.relief.as_ref()?;
    let height = (origin - surface.origin).dot(surface.frame.normal);
    let slope = direction.dot(surface.frame.normal);
    let [a, b] = surface.slab().map(|h| (-h - height) / slope);
    let (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    let axes = [surface.frame.u_hat, surface.frame.v_hat];
    let per_depth: f64 = (0..2)
        .map(|i| {
            let texels_per_unit = surface.map_per_unit[i] * f64::from(map.size()[i]);
            (direction.dot(axes[i]) * texels_per_unit).abs()
        })
        .sum();
    (enter < leave).then_some(1.0 + (leave - enter) * per_depth)
}
