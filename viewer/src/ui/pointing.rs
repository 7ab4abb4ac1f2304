//! What the pointer picks: a pixel is asked for when the picture rests, and what it shows is told when it has come. Two clicks measure.

use cutaway::experiment::Renderer;
use eframe::egui::Context;

use super::Viewer;
use super::viewport::Pointed;
use crate::action::{Action, Selection};
use crate::cuts::{NewCut, PlaneMove};
use crate::pick::Picked;
use crate::slot::Side;

/// What was asked for.
type Asked = (u64, Side, [u32; 2]);

/// What is under the pointer, and what was clicked.
#[derive(Debug, Default)]
pub(super) struct Pointing {
    asked: Option<Asked>,
    under_pointer: Option<Picked>,
    /// The last two clicks.
    clicked: Vec<Picked>,
    /// A click whose pixel is still to come.
    is_click: bool,
}

impl Pointing {
    pub(super) fn under_pointer(&self) -> Option<&Picked> {
        self.under_pointer.as_ref()
    }

    /// What is told of it in a line.
    pub(super) fn sentence(&self) -> String {
        let under = self.under_pointer.as_ref().map(Picked::sentence);
        let under = under.unwrap_or_default();
        match &self.clicked[..] {
            [from, to] => {
                let distance = (to.point - from.point).length();
                format!("{under}    distance between the last two clicks: {distance:.4}")
            }
            _ => under,
        }
    }
}

impl Viewer {
    /// Asks for what is under the pointer, and takes in what has come.
    pub(super) fn point(&mut self, ctx: &Context, at: Option<Pointed>) {
        if let (Some((at_px, layer)), Some(shown)) = (self.screen.picked(), self.state.shown()) {
            let view = shown.view(self.size_px);
            let picked = Picked::new(&layer, shown, &view, at_px);
            if std::mem::take(&mut self.pointing.is_click) {
                let clicked = &mut self.pointing.clicked;
                clicked.extend(picked.clone());
                clicked.drain(..clicked.len().saturating_sub(2));
            }
            self.pointing.under_pointer = picked;
            ctx.request_repaint();
        }
        let Some(Pointed {
            side,
            at_px,
            is_click,
        }) = at
        else {
            self.pointing.asked = None;
            return;
        };
        self.pointing.is_click |= is_click;
        let asked = (self.state.revision(), side, at_px);
        let rests = !self.is_drawing() && !self.screen.is_picking();
        if !rests || (self.pointing.asked == Some(asked) && !is_click) {
            return;
        }
        let renderers = self.last.map(|last| last.renderers);
        if let Some(Some(Renderer::Method(method))) = renderers.map(|r| r[side.index()]) {
            self.pointing.asked = Some(asked);
            if let Err(error) = self.screen.pick(method, at_px) {
                self.toasts.add(ctx, error.into());
            }
        }
        ctx.request_repaint();
    }

    /// Puts the plane of the selected cut, or a new one, through the face under the pointer.
    pub(super) fn cut_here(&mut self, actions: &mut Vec<Action>) {
        let Some(picked) = &self.pointing.under_pointer else {
            return;
        };
        if !matches!(self.state.selection(), Selection::Cut(_)) {
            actions.push(Action::Add(NewCut::Plane(0)));
        }
        // What is before the face goes: the normal of a plane points to what stays.
        let through = PlaneMove::Through(picked.point, -picked.normal);
        actions.push(Action::MovePlane(through));
    }
}
