//! The handles of a plane: an arrow along its normal, two arcs that tilt it about the axes of its frame, and, where it has a relief, a
//! third that rotates it within its plane.

use cutaway::scene::{Bounds, ClipSurface, Up};
use glam::{DQuat, DVec3};

use super::rail::Rail;
use super::region::edges_of;
use super::{Gizmo, Grip, Handle, RailScale};
use crate::picture::world_view::WorldView;

/// Length of the arrow and radius of the arcs, as a fraction of the model's diagonal.
const REACH_SHARE: f64 = 0.15;

/// Half of an arc's angle, in radians.
const HALF_ARC: f64 = 0.45;

/// Line segments per arc.
const ARC_LINES: u32 = 12;

/// Adds the handles of a plane through a point, whose normal points to the kept side.
pub(super) fn add(
    gizmo: &mut Gizmo,
    (normal, origin): (DVec3, DVec3),
    (bounds, up): (&Bounds, Up),
    view: &WorldView,
) {
    let corners = section_of(bounds, normal, origin);
    gizmo.add_outline(&corners, true, view);
    let pivot = pivot_of(&corners, origin, bounds);
    let reach = bounds.size().length() * REACH_SHARE;
    let [least, most] = extent(bounds, normal);
    let along = Rail::Line {
        from: pivot,
        along: normal,
        length: reach,
    };
    gizmo.add(
        Handle {
            grip: Grip::Along,
            rail: along,
            scale: RailScale {
                start: pivot.dot(normal),
                unit: 1.0,
                snap: [least, (most - least) / 100.0],
                range: [f64::NEG_INFINITY, f64::INFINITY],
            },
            normal,
            ..Handle::default()
        },
        // The arrow points to the removed side, the direction in which users drag.
        ([0.0, -reach], 1),
        None,
        view,
    );
    let frame = ClipSurface::upright(pivot, normal, up).frame();
    for (index, (axis, towards)) in [(frame.u_hat, frame.v_hat), (frame.v_hat, frame.u_hat)]
        .into_iter()
        .enumerate()
    {
        let arm = (towards - normal).normalize_or(towards) * reach;
        let circle = Rail::Circle {
            centre: pivot,
            axis,
            arm,
        };
        gizmo.add(
            Handle {
                grip: Grip::Tilt(index),
                rail: circle,
                scale: RailScale {
                    start: 0.0,
                    unit: 1.0,
                    snap: [0.0, 5.0_f64.to_radians()],
                    range: [f64::NEG_INFINITY, f64::INFINITY],
                },
                normal,
                ..Handle::default()
            },
            ([-HALF_ARC, HALF_ARC], ARC_LINES),
            Some(0.0),
            view,
        );
    }
}

/// Adds the arc that rotates a relief within its plane; it starts at the present angle, in degrees.
pub(super) fn add_spin(
    gizmo: &mut Gizmo,
    (normal, origin): (DVec3, DVec3),
    (axis, start): (DVec3, f64),
    (bounds, up): (&Bounds, Up),
    view: &WorldView,
) {
    let pivot = pivot_of(&section_of(bounds, normal, origin), origin, bounds);
    let level = ClipSurface::upright(pivot, axis, up).frame().u_hat;
    let arm = DQuat::from_axis_angle(axis, start.to_radians()) * level;
    gizmo.add(
        Handle {
            grip: Grip::Spin,
            rail: Rail::Circle {
                centre: pivot,
                axis,
                arm: arm * bounds.size().length() * REACH_SHARE,
            },
            scale: RailScale {
                start,
                unit: 1_f64.to_degrees(),
                snap: [0.0, 5.0],
                range: [f64::NEG_INFINITY, f64::INFINITY],
            },
            normal,
            ..Handle::default()
        },
        ([-HALF_ARC, HALF_ARC], ARC_LINES),
        Some(0.0),
        view,
    );
}

/// Pivot of a plane's handles: the plane's origin or, if that is outside the model's bounding box, the mean of the section's corners.
fn pivot_of(corners: &[DVec3], origin: DVec3, bounds: &Bounds) -> DVec3 {
    let is_within = origin.cmpge(bounds.min).all() && origin.cmple(bounds.max).all();
    match corners.is_empty() || is_within {
        true => origin,
        false => corners.iter().sum::<DVec3>() / corners.len() as f64,
    }
}

/// The minimum and the maximum coordinate of a box along a direction.
fn extent(bounds: &Bounds, along: DVec3) -> [f64; 2] {
    let ends = bounds.corners().map(|corner| corner.dot(along));
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let most = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [least, most]
}

/// Corners of the polygon in which a plane intersects a box, in order.
fn section_of(bounds: &Bounds, normal: DVec3, origin: DVec3) -> Vec<DVec3> {
    let height = |p: DVec3| (p - origin).dot(normal);
    let mut found: Vec<DVec3> = Vec::new();
    for [p, q] in edges_of(bounds) {
        let [hp, hq] = [height(p), height(q)];
        if (hp < 0.0) != (hq < 0.0) {
            found.push(p + (q - p) * (hp / (hp - hq)));
        }
    }
    let centre = found.iter().sum::<DVec3>() / found.len().max(1) as f64;
    let (u, v) = normal.any_orthonormal_pair();
    let angle = |p: &DVec3| (*p - centre).dot(v).atan2((*p - centre).dot(u));
    found.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
    found
}
