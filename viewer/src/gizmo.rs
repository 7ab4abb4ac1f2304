//! The plane of the selected cut in the picture: its outline on the box of the model, and an arrow along its normal that is dragged.
//!
//! All of it is geometry in pixels, found from the view; painting and pointers are the window's.

use cutaway::scene::{Bounds, View};
use glam::{DVec2, DVec3};

/// Length of the arrow, as a share of the diagonal of the model.
const ARROW_SHARE: f64 = 0.15;

/// So near to the arrow a pointer takes hold of it, in pixels.
const NEAR_PX: f64 = 12.0;

/// A plane in a picture.
#[derive(Clone, Debug)]
pub struct Gizmo {
    /// Corners of the plane's outline on the box, in order, in pixels.
    pub outline: Vec<DVec2>,
    /// From where to where the arrow goes, in pixels.
    pub arrow: [DVec2; 2],
    /// World units for a pixel along the arrow.
    world_per_px: f64,
}

impl Gizmo {
    /// Of the plane through a point with a normal, in world space; none where it is behind the eye.
    pub fn of(
        (normal, origin): (DVec3, DVec3),
        bounds: &Bounds,
        view: &View,
        scene_from_world: impl Fn(DVec3) -> DVec3,
    ) -> Option<Self> {
        let project = |p: DVec3| {
            let (at, depth) = view.project(scene_from_world(p));
            (view.orthographic || depth > view.near).then_some(at)
        };
        let corners = section_of(bounds, normal, origin);
        let centre = match corners.is_empty() {
            true => origin,
            false => corners.iter().sum::<DVec3>() / corners.len() as f64,
        };
        let length = (bounds.max - bounds.min).length() * ARROW_SHARE;
        // It points to what is removed, which is where the hand pulls.
        let from = project(centre)?;
        let to = project(centre - normal * length)?;
        let outline: Option<Vec<DVec2>> = corners.into_iter().map(project).collect();
        let px = (to - from).length();
        Some(Self {
            outline: outline.unwrap_or_default(),
            arrow: [from, to],
            world_per_px: if px > 1.0 { length / px } else { 0.0 },
        })
    }

    /// Whether a pointer is on the arrow.
    pub fn is_at(&self, pointer: DVec2) -> bool {
        let [from, to] = self.arrow;
        let along = to - from;
        let share = (pointer - from).dot(along) / along.length_squared().max(1e-12);
        (from + along * share.clamp(0.0, 1.0) - pointer).length() <= NEAR_PX
    }

    /// How far the plane goes along its normal, in world units, when the arrow is dragged by so many pixels. A plane that is seen from the
    /// front does not go.
    pub fn dragged(&self, by: DVec2) -> f64 {
        let [from, to] = self.arrow;
        -by.dot((to - from).normalize_or_zero()) * self.world_per_px
    }
}

/// Corners of the section of a box by a plane, in order around it.
fn section_of(bounds: &Bounds, normal: DVec3, origin: DVec3) -> Vec<DVec3> {
    let corners = bounds.corners();
    let height = |p: DVec3| (p - origin).dot(normal);
    let mut found: Vec<DVec3> = Vec::new();
    for a in 0..8 {
        for b in a + 1..8 {
            let [p, q] = [corners[a], corners[b]];
            // An edge of the box goes along one axis.
            let is_edge = (p - q).to_array().iter().filter(|d| d.abs() > 0.0).count() == 1;
            let [hp, hq] = [height(p), height(q)];
            if is_edge && (hp < 0.0) != (hq < 0.0) {
                found.push(p + (q - p) * (hp / (hp - hq)));
            }
        }
    }
    let centre = found.iter().sum::<DVec3>() / found.len().max(1) as f64;
    let (u, v) = normal.any_orthonormal_pair();
    let angle = |p: &DVec3| (*p - centre).dot(v).atan2((*p - centre).dot(u));
    found.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::scene::Camera;

    #[test]
    fn the_arrow_goes_where_the_plane_goes() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let view = Camera::default().view(|p| p, 1.0, bounds, [400, 300]);
        let normal = DVec3::new(-1.0, 0.0, 0.0);
        let at = |x: f64| {
            let plane = (normal, DVec3::X * x);
            Gizmo::of(plane, &bounds, &view, |p| p).expect("it is before the eye")
        };
        let gizmo = at(0.0);
        assert_eq!(gizmo.outline.len(), 4, "a square");
        let [from, to] = gizmo.arrow;
        assert!(gizmo.is_at((from + to) * 0.5) && !gizmo.is_at(from + DVec2::splat(40.0)));
        // Dragged to where the arrow of another plane begins, it goes nearly there; perspective takes some.
        let other = at(0.2);
        let by = gizmo.dragged(other.arrow[0] - from);
        assert!((by + 0.2).abs() < 0.03, "{by}");
    }
}
