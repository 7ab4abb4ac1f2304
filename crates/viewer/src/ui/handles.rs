//! Paints the selected cut's handles over the picture. The handle that is held or under the pointer is bright.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, vec2};
use glam::DVec2;

use crate::action::Selection;
use crate::picture::gizmo::{Gizmo, Grip, Handle};
use crate::picture::shown::Shown;
use crate::picture::world_view::WorldView;
use crate::state::State;

const COLOR: Color32 = Color32::from_rgb(230, 120, 30);
const LIT: Color32 = Color32::from_rgb(255, 214, 64);
/// Colour of the outline around a handle, which makes the handle visible on any cap.
const RIM: Color32 = Color32::from_rgb(40, 24, 10);

/// The selected cut's gizmo, in points of the picture.
pub(super) fn gizmo(state: &State, shown: &Shown, view: &WorldView) -> Gizmo {
    let Selection::Cut(index) = state.selection() else {
        return Gizmo::default();
    };
    let up = shown.scene.camera.up;
    Gizmo::of(state.posed(), index, (&state.bounds(), up), view)
}

/// Converts a point of the window to picture coordinates.
pub(super) fn in_picture(picture: Rect, at: Pos2) -> DVec2 {
    let at = at - picture.min;
    DVec2::new(f64::from(at.x), f64::from(at.y))
}

/// Paints the handles over a picture, and the help text of the highlighted handle.
pub(super) fn paint(painter: &Painter, picture: Rect, gizmo: &Gizmo, lit: Option<Grip>) {
    let at = |p: &DVec2| picture.min + vec2(p.x as f32, p.y as f32);
    for line in &gizmo.outlines {
        let line: Vec<Pos2> = line.iter().map(at).collect();
        painter.add(Shape::line(line, Stroke::new(1.5, COLOR)));
    }
    for handle in &gizmo.handles {
        let (color, width) = match lit == Some(handle.grip) {
            true => (LIT, 4.0),
            false => (COLOR, 3.0),
        };
        let line: Vec<Pos2> = handle.line.iter().map(at).collect();
        match (handle, &line[..]) {
            (Handle { knob: None, .. }, [from, .., to]) => {
                painter.arrow(*from, *to - *from, Stroke::new(width, color));
            }
            _ => {
                painter.add(Shape::line(line, Stroke::new(width, color)));
            }
        }
        if let Some(knob) = handle.knob.as_ref().map(at) {
            painter.circle(knob, width + 2.0, color, Stroke::new(1.5, RIM));
        }
    }
    if let Some(grip) = lit {
        let at = picture.left_bottom() + vec2(8.0, -8.0);
        let font = FontId::proportional(13.0);
        let galley = painter.layout_no_wrap(grip.help(), font, Color32::WHITE);
        let own = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        painter.rect_filled(own.expand(4.0), 3.0, Color32::from_black_alpha(140));
        painter.galley(own.min, galley, Color32::WHITE);
    }
}
