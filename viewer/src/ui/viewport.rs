//! The picture: slots side by side or one over the other, with marks of what is wrong, the line of the wipe and the plane that is dragged.

use cutaway::scene::View;
use eframe::egui::{
    self, Align2, Color32, CursorIcon, FontId, Painter, PointerButton, Pos2, Rect, Response, Sense,
    Stroke, TextureId, Ui, Vec2, pos2, vec2,
};
use glam::DVec2;

use super::judged::Judged;
use crate::action::{Action, Selection};
use crate::camera::CameraMove;
use crate::cuts::{self, PlaneMove};
use crate::gizmo::Gizmo;
use crate::screen::Screen;
use crate::shown::Shown;
use crate::slot::{Layout, Side};
use crate::state::State;

/// Degrees of an orbit for a point of a drag.
const DEGREES_PER_POINT: f64 = 0.4;

/// How much a point of scrolling enlarges.
const ZOOM_PER_POINT: f64 = 0.003;

/// How near to the line of the wipe a pointer takes hold of it, in points.
const NEAR_LINE: f32 = 8.0;

/// What is held by the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Held {
    /// Nothing, or the eye.
    #[default]
    Eye,
    /// The line of the wipe.
    Line,
    /// The arrow of the plane.
    Arrow,
}

/// Where the pointer is in the picture of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pointed {
    pub(super) side: Side,
    pub(super) at_px: [u32; 2],
    pub(super) is_click: bool,
}

/// The size of the picture of a slot, in pixels.
pub(super) fn size_px(rect: Rect, layout: Layout, pixels_per_point: f32) -> [u32; 2] {
    let columns = if layout == Layout::SideBySide {
        2.0
    } else {
        1.0
    };
    let size = vec2(rect.width() / columns, rect.height()) * pixels_per_point;
    [size.x, size.y].map(|s| (s.round() as u32).max(16))
}

/// Shows the pictures, and says what the pointer does.
pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    state: &State,
    (screen, judged): (&Screen, &Judged),
    (held, flickers): (&mut Held, bool),
    actions: &mut Vec<Action>,
) -> Option<Pointed> {
    let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
    let response = response.accessible_name("Picture");
    let painter = ui.painter_at(rect);
    let layout = state.layout();
    let picture = |side: Side| {
        screen
            .picture(side)
            .filter(|_| screen.refusal(side).is_none())
    };
    let Some(shown) = state.shown() else {
        let font = FontId::proportional(16.0);
        let color = ui.visuals().weak_text_color();
        let text = "Drop a mesh (.obj, .stl, .ply, .glb, .gltf) or a scene (.toml) here";
        painter.text(rect.center(), Align2::CENTER_CENTER, text, font, color);
        return None;
    };
    match layout {
        Layout::Single => slot(
            &painter,
            (rect, rect),
            (Side::A, picture(Side::A)),
            state,
            (screen, judged),
        ),
        Layout::Flicker => {
            let side = if flickers { Side::B } else { Side::A };
            slot(
                &painter,
                (rect, rect),
                (side, picture(side)),
                state,
                (screen, judged),
            );
        }
        Layout::Wipe => {
            let x = line(rect, state.wipe());
            let (left, right) = rect.split_left_right_at_x(x);
            slot(
                &painter,
                (rect, left),
                (Side::A, picture(Side::A)),
                state,
                (screen, judged),
            );
            slot(
                &painter,
                (rect, right),
                (Side::B, picture(Side::B)),
                state,
                (screen, judged),
            );
            painter.vline(x, rect.y_range(), Stroke::new(1.5, Color32::WHITE));
            painter.circle_filled(pos2(x, rect.center().y), 5.0, Color32::WHITE);
        }
        Layout::SideBySide => {
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            slot(
                &painter,
                (left, left),
                (Side::A, picture(Side::A)),
                state,
                (screen, judged),
            );
            slot(
                &painter,
                (right, right),
                (Side::B, picture(Side::B)),
                state,
                (screen, judged),
            );
        }
        Layout::Difference => {
            if let Some(id) = screen.difference() {
                image(&painter, (rect, rect), id, Color32::WHITE);
            }
        }
    }
    let pictures: Vec<Rect> = match layout {
        Layout::SideBySide => {
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            vec![left, right]
        }
        _ => vec![rect],
    };
    let own = pictures.iter().find(|r| {
        let at = response
            .interact_pointer_pos()
            .or_else(|| response.hover_pos());
        at.is_some_and(|at| r.contains(at))
    });
    let own = own.copied().unwrap_or(pictures[0]);
    let size = [own.width(), own.height()].map(|s| (s.round() as u32).max(16));
    let view = shown.view(size);
    let gizmo = gizmo(state, shown, &view);
    if let Some(gizmo) = &gizmo {
        for place in &pictures {
            paint_gizmo(&painter, *place, gizmo);
        }
    }
    pointer(
        &response,
        (rect, own),
        state,
        (held, gizmo.as_ref()),
        actions,
    );
    let at = response.hover_pos().filter(|_| !response.dragged())?;
    let side = match layout {
        Layout::Wipe if at.x >= line(rect, state.wipe()) => Side::B,
        Layout::SideBySide if own.min.x > rect.min.x => Side::B,
        Layout::Flicker if flickers => Side::B,
        _ => Side::A,
    };
    let px = ui.ctx().pixels_per_point();
    let size_px = size_px(rect, layout, px);
    let in_picture = (at - own.min) * px;
    let at_px = [in_picture.x, in_picture.y].map(|c| c.max(0.0) as u32);
    let is_within = at_px[0] < size_px[0] && at_px[1] < size_px[1];
    is_within.then_some(Pointed {
        side,
        at_px,
        is_click: response.clicked(),
    })
}

/// Where the line of the wipe is.
fn line(rect: Rect, at: f32) -> f32 {
    rect.left() + rect.width() * at
}

/// A part of a picture that fills `whole`, or why there is none.
fn slot(
    painter: &Painter,
    (whole, part): (Rect, Rect),
    (side, picture): (Side, Option<TextureId>),
    state: &State,
    (screen, judged): (&Screen, &Judged),
) {
    if let Some(id) = picture {
        image(painter, (whole, part), id, Color32::WHITE);
    }
    if let Some((map, is_current)) = judged.marks(side).filter(|_| state.shows_errors()) {
        let alpha = if is_current { 255 } else { 80 };
        image(
            painter,
            (whole, part),
            map.id(),
            Color32::from_white_alpha(alpha),
        );
    }
    let painter = painter.with_clip_rect(part);
    let font = FontId::proportional(14.0);
    if let Some(why) = screen.refusal(side) {
        let text = format!("{} does not draw this scene: {why}", state.painter(side));
        let galley = painter.layout(text, font.clone(), Color32::GRAY, part.width() * 0.8);
        painter.galley(part.center() - galley.size() * 0.5, galley, Color32::GRAY);
    }
    if state.layout() != Layout::Single {
        let at = part.left_top() + Vec2::splat(8.0);
        let label = format!("{side}: {}", state.painter(side));
        let galley = painter.layout_no_wrap(label, font, Color32::WHITE);
        let behind = Rect::from_min_size(at, galley.size()).expand(4.0);
        painter.rect_filled(behind, 3.0, Color32::from_black_alpha(140));
        painter.galley(at, galley, Color32::WHITE);
    }
}

/// Paints that part of a picture that fills `whole` which lies in `part`.
fn image(painter: &Painter, (whole, part): (Rect, Rect), id: TextureId, tint: Color32) {
    let share = |p: Pos2| ((p - whole.min) / whole.size()).to_pos2();
    let uv = Rect::from_min_max(share(part.min), share(part.max));
    painter.image(id, part, uv, tint);
}

/// The plane of the selected cut, in points of a picture.
fn gizmo(state: &State, shown: &Shown, view: &View) -> Option<Gizmo> {
    let Selection::Cut(index) = state.selection() else {
        return None;
    };
    let bounds = state.bounds();
    let plane = cuts::plane(state.document(), index, &bounds).ok()?;
    let prepared = &shown.at.model.prepared;
    let to_scene = |p| (p - prepared.centre_in_world) * prepared.scale;
    Gizmo::of(plane, &bounds, view, to_scene)
}

fn paint_gizmo(painter: &Painter, rect: Rect, gizmo: &Gizmo) {
    let at = |p: DVec2| rect.min + vec2(p.x as f32, p.y as f32);
    let color = Color32::from_rgb(230, 120, 30);
    let mut outline: Vec<Pos2> = gizmo.outline.iter().map(|p| at(*p)).collect();
    outline.extend(outline.first().copied());
    painter.add(egui::Shape::line(outline, Stroke::new(1.5, color)));
    let [from, to] = gizmo.arrow.map(at);
    painter.arrow(from, to - from, Stroke::new(3.0, color));
}

fn pointer(
    response: &Response,
    (rect, own): (Rect, Rect),
    state: &State,
    (held, gizmo): (&mut Held, Option<&Gizmo>),
    actions: &mut Vec<Action>,
) {
    let in_picture =
        |at: Pos2| DVec2::new(f64::from(at.x - own.left()), f64::from(at.y - own.top()));
    let at_line = |at: Pos2| {
        state.layout() == Layout::Wipe && (at.x - line(rect, state.wipe())).abs() <= NEAR_LINE
    };
    let at_arrow = |at: Pos2| gizmo.is_some_and(|g| g.is_at(in_picture(at)));
    let under = |at: Pos2| {
        if at_arrow(at) {
            Held::Arrow
        } else if at_line(at) {
            Held::Line
        } else {
            Held::Eye
        }
    };
    if response.drag_started() {
        let at = response
            .interact_pointer_pos()
            .map(|at| at - response.drag_delta());
        *held = at.map_or(Held::Eye, under);
    }
    if let Some(at) = response.hover_pos().filter(|_| !response.dragged()) {
        let cursor = match under(at) {
            Held::Arrow => CursorIcon::Grab,
            Held::Line => CursorIcon::ResizeHorizontal,
            Held::Eye => CursorIcon::Default,
        };
        response.ctx.set_cursor_icon(cursor);
    }
    let by = response.drag_delta();
    if by != Vec2::ZERO {
        let points = DVec2::new(f64::from(by.x), f64::from(by.y));
        let in_heights = DVec2::new(points.x, -points.y) / f64::from(own.height());
        let shift = response.ctx.input(|input| input.modifiers.shift);
        let pans = response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Secondary)
            || shift && *held == Held::Eye;
        match (*held, gizmo) {
            (Held::Line, _) => {
                let x = response.interact_pointer_pos().map_or(0.0, |at| at.x);
                actions.push(Action::Wipe((x - rect.left()) / rect.width()));
            }
            (Held::Arrow, Some(gizmo)) => {
                let fine = if shift { 0.1 } else { 1.0 };
                let distance = gizmo.dragged(points) * fine;
                actions.push(Action::MovePlane(PlaneMove::Along(distance)));
            }
            _ if pans => actions.push(Action::MoveCamera(CameraMove::Pan(in_heights))),
            _ => {
                let degrees = DVec2::new(points.x, -points.y) * DEGREES_PER_POINT;
                actions.push(Action::MoveCamera(CameraMove::Orbit(degrees)));
            }
        }
    }
    if response.drag_stopped() {
        *held = Held::Eye;
        actions.push(Action::Release);
    }
    let (scroll, pinch) = response
        .ctx
        .input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
    let factor = (f64::from(scroll) * ZOOM_PER_POINT).exp() * f64::from(pinch);
    if let Some(at) = response.hover_pos().filter(|_| (factor - 1.0).abs() > 1e-6) {
        let from_middle = at - own.center();
        let about = DVec2::new(f64::from(from_middle.x), -f64::from(from_middle.y));
        let about = about / f64::from(own.height());
        actions.push(Action::MoveCamera(CameraMove::Zoom { factor, about }));
    }
}
