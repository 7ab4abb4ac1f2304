//! The handles of boxes and wedges: a knob on each bounded face of a box, and one on each half-plane of a wedge.

use cutaway::scene::{Block, Bounds, Wedge};
use glam::{DQuat, DVec3};

use super::rail::Rail;
use super::{Gizmo, Grip, Handle, RailScale};
use crate::picture::world_view::WorldView;

/// Length of the line that shows in which direction a knob moves, as a fraction of the model's diagonal.
const STUB_SHARE: f64 = 0.06;

/// Minimum distance between opposite faces of a box, as a fraction of the model's size.
const LEAST_SHARE: f64 = 1e-3;

/// Minimum angle between the half-planes of a wedge, in degrees.
const LEAST_DEG: f64 = 1.0;

/// Line segments of a knob's arc, and the arc's extent to each side of the knob in radians.
const ARC_LINES: u32 = 6;
const HALF_ARC: f64 = 0.12;

/// Adds the outlines and handles of a box.
pub(super) fn add_block(
    gizmo: &mut Gizmo,
    (region, block): (usize, &Block),
    bounds: &Bounds,
    view: &WorldView,
) {
    let size = bounds.size();
    let end = |given: [Option<f64>; 3], usual: DVec3| {
        DVec3::from_array([0, 1, 2].map(|i| given[i].unwrap_or(usual[i])))
    };
    let drawn = Bounds {
        min: end(block.min, bounds.min),
        max: end(block.max, bounds.max),
    };
    for [a, b] in edges_of(&drawn) {
        gizmo.add_outline(&[a, b], false, view);
    }
    let stub = size.length() * STUB_SHARE;
    for axis in 0..3 {
        for is_greatest in [false, true] {
            let ends = [block.min[axis], block.max[axis]];
            let Some(at) = ends[usize::from(is_greatest)] else {
                continue;
            };
            let mut from = (drawn.min + drawn.max) * 0.5;
            from[axis] = at;
            let least = size[axis] * LEAST_SHARE;
            let range = match is_greatest {
                false => [
                    f64::NEG_INFINITY,
                    ends[1].map_or(f64::INFINITY, |b| b - least),
                ],
                true => [
                    ends[0].map_or(f64::NEG_INFINITY, |a| a + least),
                    f64::INFINITY,
                ],
            };
            let outward = if is_greatest { stub } else { -stub };
            gizmo.add(
                Handle {
                    grip: Grip::Face {
                        region,
                        axis,
                        is_greatest,
                    },
                    rail: Rail::Line {
                        from,
                        along: DVec3::AXES[axis],
                        length: stub,
                    },
                    scale: RailScale {
                        start: at,
                        unit: 1.0,
                        snap: [bounds.min[axis], size[axis] / 100.0],
                        range,
                    },
                    ..Handle::default()
                },
                ([0.0, outward], 1),
                Some(0.0),
                view,
            );
        }
    }
}

/// Adds the outlines and handles of a wedge.
pub(super) fn add_wedge(
    gizmo: &mut Gizmo,
    (region, wedge): (usize, &Wedge),
    bounds: &Bounds,
    view: &WorldView,
) {
    let along = wedge.along;
    let corners = bounds.corners();
    let from_axis = |p: DVec3| {
        let d = p - wedge.origin;
        (d - along * d.dot(along)).length()
    };
    let radius = corners.iter().map(|p| from_axis(*p)).fold(0.0, f64::max) * 0.75;
    let heights = corners.map(|p| (p - wedge.origin).dot(along));
    let [own, least, most] = [
        wedge.origin.dot(along),
        heights.iter().copied().fold(f64::INFINITY, f64::min),
        heights.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ];
    let ends = [
        wedge.min.map_or(least, |at| at - own),
        wedge.max.map_or(most, |at| at - own),
    ];
    let [low, high] = ends.map(|height| wedge.origin + along * height);
    gizmo.add_outline(&[low, high], false, view);
    let turned =
        |degrees: f64| DQuat::from_axis_angle(along, degrees.to_radians()) * wedge.zero * radius;
    for is_end in [false, true] {
        let own_deg = if is_end { wedge.to_deg } else { wedge.from_deg };
        let arm = turned(own_deg);
        gizmo.add_outline(&[low, low + arm, high + arm, high], false, view);
        let range = match is_end {
            false => [wedge.to_deg - 360.0, wedge.to_deg - LEAST_DEG],
            true => [wedge.from_deg + LEAST_DEG, wedge.from_deg + 360.0],
        };
        gizmo.add(
            Handle {
                grip: Grip::Angle { region, is_end },
                rail: Rail::Circle {
                    centre: (low + high) * 0.5,
                    axis: along,
                    arm,
                },
                scale: RailScale {
                    start: own_deg,
                    unit: 1.0_f64.to_degrees(),
                    snap: [0.0, 5.0],
                    range,
                },
                ..Handle::default()
            },
            ([-HALF_ARC, HALF_ARC], ARC_LINES),
            Some(0.0),
            view,
        );
    }
}

/// The edges of a box.
pub(super) fn edges_of(bounds: &Bounds) -> Vec<[DVec3; 2]> {
    let corners = bounds.corners();
    let mut edges = Vec::with_capacity(12);
    for a in 0..8 {
        for b in a + 1..8 {
            let [p, q] = [corners[a], corners[b]];
            // The ends of an edge differ along exactly one axis.
            if (p - q).to_array().iter().filter(|d| d.abs() > 0.0).count() == 1 {
                edges.push([p, q]);
            }
        }
    }
    edges
}
