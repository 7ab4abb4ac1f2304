//! The selected cut's gizmo in the picture: outlines of the cut, and handles to drag.
//!
//! This module computes geometry in pixels from the view; the window paints it and reads the pointer. A handle moves along a rail in
//! space. During a drag it stores its initial value and how far the pointer has moved it, so that a snapped or clamped value continues
//! from the pointer's position, and rounding errors do not accumulate.
//!
//! Cannot: drag a surface given in the paper's form (`u`, `v`); its numbers have to be edited.

mod plane;
mod rail;
mod region;

use cutaway::scene::{Bounds, Up};
use cutaway_io::Document;
use glam::{DQuat, DVec2, DVec3};

use crate::action::Action;
use crate::editing::cuts::{self, PlaneMove};
use crate::editing::regions::{self, Region, RegionMove};
use crate::picture::world_view::WorldView;
use rail::Rail;

/// Maximum distance at which the pointer grabs a handle, in pixels.
const NEAR_PX: f64 = 10.0;

/// Factor applied to the pointer's motion during fine dragging.
const FINE: f64 = 0.1;

/// Identity of a handle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grip {
    /// The arrow that moves a plane along its normal.
    #[default]
    Along,
    /// The arc that tilts a plane about an axis of its frame: 0 is U, 1 is V.
    Tilt(usize),
    /// The arc that rotates a relief within its plane.
    Spin,
    /// The knob on a box face.
    Face {
        /// Index into the [regions](regions::regions) of the cut.
        region: usize,
        /// 0 is x.
        axis: usize,
        /// True for the face at the maximum corner.
        is_greatest: bool,
    },
    /// The knob on a wedge's half-plane.
    Angle {
        /// Index into the [regions](regions::regions) of the cut.
        region: usize,
        /// True for the half-plane where the wedge ends.
        is_end: bool,
    },
}

impl Grip {
    /// One-line help for dragging the handle.
    pub fn help(self) -> String {
        let (does, step) = match self {
            Self::Along => ("drag: move the plane along its normal", "1 %"),
            Self::Tilt(_) => ("drag: tilt the plane", "5 degrees"),
            Self::Spin => ("drag: turn the relief in its plane", "5 degrees"),
            Self::Face { .. } => ("drag: move this face of the box", "1 %"),
            Self::Angle { .. } => ("drag: turn this face of the wedge", "5 degrees"),
        };
        format!("{does}; Ctrl: in steps of {step}; Shift: finely")
    }
}

/// Linear map from the amount along a rail to the handle's value, with snapping and limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct RailScale {
    /// The value at amount 0.
    start: f64,
    /// Change of the value per unit of amount.
    unit: f64,
    /// One value to snap to, and the step between the values to snap to.
    snap: [f64; 2],
    /// The minimum and the maximum value.
    range: [f64; 2],
}

impl RailScale {
    fn value(&self, amount: f64, snaps: bool) -> f64 {
        let value = self.start + amount * self.unit;
        let [from, step] = self.snap;
        let value = match snaps && step > 0.0 {
            true => from + ((value - from) / step).round() * step,
            false => value,
        };
        value.clamp(self.range[0], self.range[1])
    }
}

/// A handle to drag.
#[derive(Clone, Debug)]
pub struct Handle {
    /// Identity of the handle.
    pub grip: Grip,
    /// Polyline that shows the handle, in pixels.
    pub line: Vec<DVec2>,
    /// Position of the handle's knob, in pixels; `None` if it has no knob.
    pub knob: Option<DVec2>,
    rail: Rail,
    scale: RailScale,
    /// Unit normal of the plane.
    normal: DVec3,
}

impl Default for Handle {
    fn default() -> Self {
        Self {
            grip: Grip::default(),
            line: Vec::new(),
            knob: None,
            rail: Rail::Line {
                from: DVec3::ZERO,
                along: DVec3::ZERO,
                length: 0.0,
            },
            scale: RailScale::default(),
            normal: DVec3::ZERO,
        }
    }
}

impl Handle {
    /// Distance from the handle to a pointer, in pixels. A knob counts as nearer than a line.
    fn distance(&self, pointer: DVec2) -> f64 {
        let to_line = (self
            .line
            .windows(2)
            .map(|ends| to_segment(pointer, [ends[0], ends[1]])))
        .fold(f64::INFINITY, f64::min);
        let to_knob = (self.knob).map_or(f64::INFINITY, |knob| (knob - pointer).length() * 0.5);
        to_line.min(to_knob)
    }

    /// Begins a drag.
    pub fn hold(&self) -> Hold {
        Hold {
            handle: self.clone(),
            amount: 0.0,
        }
    }
}

/// A handle during a drag.
#[derive(Clone, Debug)]
pub struct Hold {
    /// The handle at the start of the drag.
    handle: Handle,
    /// Amount along the rail since the start of the drag.
    amount: f64,
}

impl Hold {
    /// Identity of the handle.
    pub fn grip(&self) -> Grip {
        self.handle.grip
    }

    /// Continues the drag by a pointer motion in pixels, and returns the action for it.
    pub fn drag(&mut self, by_px: DVec2, view: &WorldView, is_fine: bool, snaps: bool) -> Action {
        let Handle {
            grip,
            rail,
            scale,
            normal,
            ..
        } = &self.handle;
        let by_px = by_px * if is_fine { FINE } else { 1.0 };
        self.amount = rail.follow(self.amount, by_px, view);
        let value = scale.value(self.amount, snaps);
        match (*grip, rail) {
            (Grip::Tilt(_), Rail::Circle { centre, axis, .. }) => {
                let normal = DQuat::from_axis_angle(*axis, value) * *normal;
                Action::MovePlane(PlaneMove::Tilt(*centre, normal))
            }
            (
                Grip::Face {
                    region,
                    axis,
                    is_greatest,
                },
                _,
            ) => Action::MoveRegion(RegionMove::Face {
                region,
                axis,
                is_greatest,
                to: value,
            }),
            (Grip::Angle { region, is_end }, _) => Action::MoveRegion(RegionMove::Angle {
                region,
                is_end,
                to_deg: value,
            }),
            (Grip::Spin, _) => Action::MovePlane(PlaneMove::Spin(value)),
            (Grip::Along | Grip::Tilt(_), _) => Action::MovePlane(PlaneMove::To(value)),
        }
    }
}

/// Gizmo of a cut in a picture.
#[derive(Clone, Debug, Default)]
pub struct Gizmo {
    /// Polylines that show the cut, in pixels.
    pub outlines: Vec<Vec<DVec2>>,
    /// Handles to drag.
    pub handles: Vec<Handle>,
}

impl Gizmo {
    /// Creates the gizmo for a cut of a document, given the model's bounding box.
    pub fn of(
        document: &Document,
        cut: usize,
        (bounds, up): (&Bounds, Up),
        view: &WorldView,
    ) -> Self {
        let mut gizmo = Self::default();
        if bounds.is_empty() {
            return gizmo;
        }
        if let Ok(plane) = cuts::plane(document, cut, bounds) {
            plane::add(&mut gizmo, plane, (bounds, up), view);
            if let Some(spin) = cuts::spin(document, cut, bounds) {
                plane::add_spin(&mut gizmo, plane, spin, (bounds, up), view);
            }
        }
        let regions = regions::regions(document, cut, bounds);
        for (index, region) in regions.iter().enumerate() {
            match region {
                Region::Block { block, .. } => {
                    region::add_block(&mut gizmo, (index, block), bounds, view);
                }
                Region::Wedge { wedge, .. } => {
                    region::add_wedge(&mut gizmo, (index, wedge), bounds, view);
                }
            }
        }
        gizmo
    }

    /// The handle nearest to the pointer, if one is under it.
    pub fn at(&self, pointer: DVec2) -> Option<&Handle> {
        let distances = self.handles.iter().map(|h| (h.distance(pointer), h));
        let near = distances.filter(|(distance, _)| *distance <= NEAR_PX);
        let nearest = near.min_by(|(a, _), (b, _)| a.total_cmp(b));
        nearest.map(|(_, handle)| handle)
    }

    /// A handle by identity.
    pub fn handle(&self, grip: Grip) -> Option<&Handle> {
        self.handles.iter().find(|h| h.grip == grip)
    }

    /// Adds a polyline through the points, unless one of them is behind the eye.
    fn add_outline(&mut self, points: &[DVec3], is_closed: bool, view: &WorldView) {
        let line: Option<Vec<DVec2>> = points.iter().map(|p| view.project(*p)).collect();
        if let Some(mut line) = line.filter(|line| line.len() > 1) {
            if is_closed {
                line.push(line[0]);
            }
            self.outlines.push(line);
        }
    }

    /// Adds a handle unless part of it is behind the eye. A polyline shows the range `shown` of its rail; `knob_at` is its knob's amount.
    fn add(
        &mut self,
        mut handle: Handle,
        (shown, lines): ([f64; 2], u32),
        knob_at: Option<f64>,
        view: &WorldView,
    ) {
        let points = handle.rail.between(shown, lines);
        let line: Option<Vec<DVec2>> = points.into_iter().map(|p| view.project(p)).collect();
        let knob = knob_at.map(|amount| view.project(handle.rail.at(amount)));
        if let Some(line) = line.filter(|_| knob != Some(None)) {
            handle.line = line;
            handle.knob = knob.flatten();
            self.handles.push(handle);
        }
    }
}

/// Distance of a point from a segment.
fn to_segment(point: DVec2, [from, to]: [DVec2; 2]) -> f64 {
    let along = to - from;
    let share = (point - from).dot(along) / along.length_squared().max(1e-12);
    (from + along * share.clamp(0.0, 1.0) - point).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::scene::Camera;

    fn view(bounds: Bounds) -> WorldView {
        WorldView::plain(Camera::default().view(|p| p, 1.0, bounds, [400, 300]))
    }

    fn gizmo(document: &Document, bounds: &Bounds) -> Gizmo {
        Gizmo::of(document, 0, (bounds, Up::PlusY), &view(*bounds))
    }

    fn document(cut: &str) -> Document {
        let text = format!("[[part]]\nshape = \"cube\"\n\n[[cut]]\n{cut}\n");
        Document::parse("scene.toml", &text).expect("a scene")
    }

    fn carry_out(document: &mut Document, action: Action, bounds: &Bounds) {
        match action {
            Action::MovePlane(by) => cuts::move_plane(document, 0, by, bounds).expect("a plane"),
            Action::MoveRegion(by) => {
                regions::move_region(document, 0, by, bounds).expect("a region");
            }
            other => panic!("{other:?} is no move of a handle"),
        }
    }

    /// Drags a handle by some pixels in a number of steps, and returns the document after it.
    fn drag(cut: &str, grip: Grip, by_px: DVec2, (is_fine, snaps): (bool, bool)) -> Document {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let mut document = document(cut);
        let gizmo = gizmo(&document, &bounds);
        let mut hold = gizmo.handle(grip).expect("a handle").hold();
        for _ in 0..8 {
            let action = hold.drag(by_px / 8.0, &view(bounds), is_fine, snaps);
            carry_out(&mut document, action, &bounds);
        }
        document
    }

    #[test]
    fn a_handle_follows_the_pointer() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        for (cut, grips) in [
            (
                "surfaces = [{ section = \"-x=50%\" }]",
                vec![Grip::Along, Grip::Tilt(0), Grip::Tilt(1)],
            ),
            (
                "surfaces = [{ section = \"-x=50%\", relief = \"r\", spin_deg = 30, flip = true }]",
                vec![Grip::Spin],
            ),
            (
                "box = { min = [\"50%\", 0, 0], max = [0.9, 1, 1] }",
                vec![Grip::Face {
                    region: 0,
                    axis: 0,
                    is_greatest: true,
                }],
            ),
            (
                "wedge = { axis = \"y\", from_deg = -45, to_deg = 45 }",
                vec![Grip::Angle {
                    region: 0,
                    is_end: true,
                }],
            ),
        ] {
            let before = gizmo(&document(cut), &bounds);
            for grip in grips {
                let handle = before.handle(grip).expect("a handle");
                let at = handle.knob.unwrap_or(handle.line[0]);
                assert_eq!(before.at(at).map(|h| h.grip), Some(grip), "{cut}");
                // Drag along the visible part of the rail.
                let [a, b] = [handle.line[0], handle.line[handle.line.len() - 1]];
                let by = (b - a).normalize() * 12.0;
                let after = gizmo(&drag(cut, grip, by, (false, false)), &bounds);
                // The arcs of a plane turn with its frame, which stays upright, so the arrow shows how far the plane turned.
                let end = |gizmo: &Gizmo, grip| {
                    let handle = gizmo.handle(grip).expect("a handle");
                    handle.knob.unwrap_or(handle.line[0])
                };
                if !matches!(grip, Grip::Tilt(_)) {
                    let missed = end(&after, grip) - end(&before, grip) - by;
                    assert!(missed.length() < 1.0, "{grip:?} missed by {missed}");
                } else {
                    let moved = after.handle(Grip::Along).expect("an arrow").line[1]
                        - before.handle(Grip::Along).expect("an arrow").line[1];
                    assert!(moved.length() > 3.0, "{grip:?} turned by {moved}");
                }
            }
        }
    }

    #[test]
    fn what_is_far_from_all_handles_holds_none() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let gizmo = gizmo(&document("surfaces = [{ section = \"x=50%\" }]"), &bounds);
        assert_eq!(gizmo.outlines[0].len(), 5, "a square and its beginning");
        assert!(gizmo.at(DVec2::splat(2.0)).is_none());
    }

    #[test]
    fn values_snap_are_fine_and_end() {
        let plane = "surfaces = [{ section = \"-x=50%\" }]";
        let percent = |document: &Document| {
            let node = document.get("cut.0.surfaces.0.section").expect("a section");
            let text = node.text().expect("a text").to_owned();
            text.trim_start_matches("-x=")
                .trim_end_matches('%')
                .parse::<f64>()
                .unwrap_or(f64::NAN)
        };
        let by = DVec2::new(23.0, 7.0);
        let moved = |is_fine, snaps| percent(&drag(plane, Grip::Along, by, (is_fine, snaps)));
        let [free, snapped, fine] = [moved(false, false), moved(false, true), moved(true, false)];
        assert!(free.fract().abs() > 1e-3, "{free} is no whole percent");
        assert_eq!(snapped, free.round(), "the next whole percent");
        let ratio = (free - 50.0) / (fine - 50.0);
        assert!((ratio - 10.0).abs() < 1.0, "a tenth: {free} and {fine}");

        let tilted = drag(plane, Grip::Tilt(0), DVec2::new(10.0, -40.0), (false, true));
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        let (normal, _) = cuts::plane(&tilted, 0, &bounds).expect("a plane");
        let degrees = normal.dot(DVec3::NEG_X).acos().to_degrees();
        assert!(degrees > 4.0, "it is tilted");
        let off = (degrees / 5.0 - (degrees / 5.0).round()).abs();
        assert!(off < 1e-3, "{degrees} degrees");

        let block = "box = { min = [\"50%\", 0, 0], max = [0.9, 1, 1] }";
        let face = Grip::Face {
            region: 0,
            axis: 0,
            is_greatest: false,
        };
        for by in [DVec2::X, DVec2::NEG_X] {
            let document = drag(block, face, by * 4000.0, (false, false));
            let regions = regions::regions(&document, 0, &bounds);
            let Some(Region::Block { block, .. }) = regions.first() else {
                panic!("{document}");
            };
            let [min, max] = [block.min, block.max].map(|corner| corner[0].expect("a face"));
            assert!(min < max && max == 0.9, "{min} to {max}");
            assert_ne!(min, 0.0, "it was moved");
        }
        let wedge = "wedge = { axis = \"y\", from_deg = 0, to_deg = 90 }";
        let end = Grip::Angle {
            region: 0,
            is_end: true,
        };
        for by in [DVec2::X, DVec2::NEG_X] {
            let document = drag(wedge, end, by * 20_000.0, (false, false));
            let regions = regions::regions(&document, 0, &bounds);
            let Some(Region::Wedge { wedge, .. }) = regions.first() else {
                panic!("{document}");
            };
            assert_eq!(wedge.from_deg, 0.0);
            assert!((1.0..=360.0).contains(&wedge.to_deg), "{}", wedge.to_deg);
        }
    }

    #[test]
    fn surfaces_of_the_papers_form_have_no_handles() {
        let bounds = Bounds::from_points([DVec3::splat(-1.0), DVec3::splat(1.0)]);
        for cut in [
            "surfaces = [{ u = [1, 0, 0], v = [0, 1, 0] }]",
            "cutout = { angle_deg = 90 }",
            "breakaway = { distance = \"1%\" }",
        ] {
            assert!(gizmo(&document(cut), &bounds).handles.is_empty(), "{cut}");
        }
    }
}
