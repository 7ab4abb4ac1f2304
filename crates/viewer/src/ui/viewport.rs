//! The picture: slots side by side or one over the other, with error marks, the wipe line and the handles of the selected cut.

use eframe::egui::{
    Align2, Color32, CursorIcon, FontId, Painter, PointerButton, Pos2, Rect, Response, Sense,
    Stroke, TextureId, Ui, Vec2, pos2, vec2,
};
use glam::DVec2;

use super::handles;
use super::judged::JudgeState;
use super::panels::defects;
use crate::action::Action;
use crate::inspect::Inspector;
use crate::picture::camera::CameraMove;
use crate::picture::gizmo::{Gizmo, Hold};
use crate::picture::screen::Screen;
use crate::picture::slot::{SlotLayout, SlotSide};
use crate::picture::world_view::WorldView;
use crate::state::State;

/// Degrees of orbit per point that the pointer is dragged.
const DEGREES_PER_POINT: f64 = 0.4;

/// Zoom per point of scrolling, as the exponent of e.
const ZOOM_PER_POINT: f64 = 0.003;

/// Maximum distance at which the pointer grabs the wipe line, in points.
const NEAR_LINE: f32 = 8.0;

/// What the pointer is dragging.
#[derive(Clone, Debug, Default)]
pub(super) enum Held {
    /// Nothing, or the eye.
    #[default]
    Eye,
    /// The wipe line.
    Line,
    /// A handle of the selected cut.
    Handle(Box<Hold>),
}

/// Position of the pointer in a slot's picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pointed {
    pub(super) side: SlotSide,
    pub(super) at_px: [u32; 2],
    pub(super) is_click: bool,
}

/// Width and height of a slot's picture, in pixels.
pub(super) fn size_px(rect: Rect, layout: SlotLayout, pixels_per_point: f32) -> [u32; 2] {
    let columns = if layout == SlotLayout::SideBySide {
        2.0
    } else {
        1.0
    };
    let size = vec2(rect.width() / columns, rect.height()) * pixels_per_point;
    [size.x, size.y].map(|s| (s.round() as u32).max(16))
}

/// Shows the pictures, and handles the pointer. Returns the pixel under it.
pub(super) fn show(
    ui: &mut Ui,
    rect: Rect,
    state: &State,
    (screen, judged, inspector): (&Screen, &JudgeState, &Inspector),
    (held, flickers): (&mut Held, bool),
    actions: &mut Vec<Action>,
) -> Option<Pointed> {
    let response = ui.interact(rect, ui.scope_id().with("picture"), Sense::click_and_drag());
    let response = response.accessible_name("Picture");
    let painter = ui.painter_at(rect);
    let layout = state.layout();
    let picture = |side: SlotSide| {
        screen
            .picture(side)
            .filter(|_| screen.refusal(side).is_none())
    };
    let Some(shown) = state.shown() else {
        let font = FontId::proportional(16.0);
        let color = ui.visuals().weak_text_color();
        let text = "Drop a mesh (.obj, .stl, .ply, .glb, .gltf, .3mf) or a scene (.toml) here";
        painter.text(rect.center(), Align2::CENTER_CENTER, text, font, color);
        return None;
    };
    match layout {
        SlotLayout::Single => slot(
            &painter,
            (rect, rect),
            (SlotSide::A, picture(SlotSide::A)),
            state,
            (screen, judged),
        ),
        SlotLayout::Flicker => {
            let side = if flickers { SlotSide::B } else { SlotSide::A };
            slot(
                &painter,
                (rect, rect),
                (side, picture(side)),
                state,
                (screen, judged),
            );
        }
        SlotLayout::Wipe => {
            let x = line(rect, state.wipe());
            let (left, right) = rect.split_left_right_at_x(x);
            slot(
                &painter,
                (rect, left),
                (SlotSide::A, picture(SlotSide::A)),
                state,
                (screen, judged),
            );
            slot(
                &painter,
                (rect, right),
                (SlotSide::B, picture(SlotSide::B)),
                state,
                (screen, judged),
            );
            painter.vline(x, rect.y_range(), Stroke::new(1.5, Color32::WHITE));
            painter.circle_filled(pos2(x, rect.center().y), 5.0, Color32::WHITE);
        }
        SlotLayout::SideBySide => {
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            slot(
                &painter,
                (left, left),
                (SlotSide::A, picture(SlotSide::A)),
                state,
                (screen, judged),
            );
            slot(
                &painter,
                (right, right),
                (SlotSide::B, picture(SlotSide::B)),
                state,
                (screen, judged),
            );
        }
        SlotLayout::Difference => {
            if let Some(id) = screen.difference() {
                image(&painter, (rect, rect), id, Color32::WHITE);
            }
        }
    }
    let pictures: Vec<Rect> = match layout {
        SlotLayout::SideBySide => {
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
    let view = WorldView::of(shown, size);
    let gizmo = handles::gizmo(state, shown, &view);
    let lit = match held {
        Held::Handle(hold) => Some(hold.grip()),
        _ => (response.hover_pos().filter(|_| !response.dragged()))
            .and_then(|at| Some(gizmo.at(handles::in_picture(own, at))?.grip)),
    };
    for place in &pictures {
        if state.shows_open_edges() {
            let painter = painter.with_clip_rect(*place);
            defects::paint(&painter, *place, (shown, inspector), &view);
        }
        handles::paint(&painter.with_clip_rect(*place), *place, &gizmo, lit);
    }
    pointer(
        &response,
        (rect, own),
        state,
        (held, &gizmo, &view),
        actions,
    );
    // A click counts even if the pointer has already left the picture.
    let at = match response.clicked() {
        true => response.interact_pointer_pos(),
        false => response.hover_pos().filter(|_| !response.dragged()),
    }?;
    let side = match layout {
        SlotLayout::Wipe if at.x >= line(rect, state.wipe()) => SlotSide::B,
        SlotLayout::SideBySide if own.min.x > rect.min.x => SlotSide::B,
        SlotLayout::Flicker if flickers => SlotSide::B,
        _ => SlotSide::A,
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

/// Horizontal position of the wipe line.
fn line(rect: Rect, at: f32) -> f32 {
    rect.left() + rect.width() * at
}

/// Paints the region `part` of a slot whose picture fills `whole`, or the reason why there is no picture.
fn slot(
    painter: &Painter,
    (whole, part): (Rect, Rect),
    (side, picture): (SlotSide, Option<TextureId>),
    state: &State,
    (screen, judged): (&Screen, &JudgeState),
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
    if state.layout() != SlotLayout::Single {
        let at = part.left_top() + Vec2::splat(8.0);
        let label = format!("{side}: {}", state.painter(side));
        let galley = painter.layout_no_wrap(label, font, Color32::WHITE);
        let behind = Rect::from_min_size(at, galley.size()).expand(4.0);
        painter.rect_filled(behind, 3.0, Color32::from_black_alpha(140));
        painter.galley(at, galley, Color32::WHITE);
    }
}

/// Paints only the region `part` of a picture that fills `whole`.
fn image(painter: &Painter, (whole, part): (Rect, Rect), id: TextureId, tint: Color32) {
    let share = |p: Pos2| ((p - whole.min) / whole.size()).to_pos2();
    let uv = Rect::from_min_max(share(part.min), share(part.max));
    painter.image(id, part, uv, tint);
}

fn pointer(
    response: &Response,
    (rect, own): (Rect, Rect),
    state: &State,
    (held, gizmo, view): (&mut Held, &Gizmo, &WorldView),
    actions: &mut Vec<Action>,
) {
    let at_line = |at: Pos2| {
        state.layout() == SlotLayout::Wipe && (at.x - line(rect, state.wipe())).abs() <= NEAR_LINE
    };
    let handle = |at: Pos2| gizmo.at(handles::in_picture(own, at));
    if response.drag_started() {
        let is_primary = response.dragged_by(PointerButton::Primary);
        let at = response
            .interact_pointer_pos()
            .map(|at| at - response.drag_delta());
        *held = match at {
            Some(at) if is_primary && handle(at).is_some() => {
                let hold = handle(at).map(|handle| Box::new(handle.hold()));
                hold.map_or(Held::Eye, Held::Handle)
            }
            Some(at) if at_line(at) => Held::Line,
            _ => Held::Eye,
        };
    }
    if let Some(at) = response.hover_pos().filter(|_| !response.dragged()) {
        let cursor = if handle(at).is_some() {
            CursorIcon::Grab
        } else if at_line(at) {
            CursorIcon::ResizeHorizontal
        } else {
            CursorIcon::Default
        };
        response.ctx.set_cursor_icon(cursor);
    }
    let by = response.drag_delta();
    if by != Vec2::ZERO {
        let points = DVec2::new(f64::from(by.x), f64::from(by.y));
        let in_heights = DVec2::new(points.x, -points.y) / f64::from(own.height());
        let modifiers = response.ctx.input(|input| input.modifiers);
        let pans = response.dragged_by(PointerButton::Middle)
            || response.dragged_by(PointerButton::Secondary)
            || modifiers.shift;
        match held {
            Held::Line => {
                let x = response.interact_pointer_pos().map_or(0.0, |at| at.x);
                actions.push(Action::Wipe((x - rect.left()) / rect.width()));
            }
            Held::Handle(hold) => {
                actions.push(hold.drag(points, view, modifiers.shift, modifiers.command));
            }
            Held::Eye if pans => actions.push(Action::MoveCamera(CameraMove::Pan(in_heights))),
            Held::Eye => {
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
