//! Picking with the pointer: a pixel is requested while the picture is at rest, and described once known. Two clicks measure; a click
//! while errors are shown opens the magnifier.

use cutaway::scene::View;
use eframe::egui::Context;

use super::Viewer;
use super::viewport::Pointed;
use crate::action::Action;
use crate::picture::pick::Picked;

/// A requested pixel.
#[derive(Clone, Copy, Debug)]
struct PixelRequest {
    revision: u64,
    pointed: Pointed,
    view: View,
}

/// State of picking: the pixel under the pointer, and the last clicks.
#[derive(Debug, Default)]
pub(super) struct Pointing {
    asked: Option<PixelRequest>,
    under_pointer: Option<Picked>,
    /// The pixels of the last two clicks.
    clicked: Vec<Picked>,
    /// A click that happened while another pixel was pending.
    waiting: Option<Pointed>,
}

impl Pointing {
    pub(super) fn under_pointer(&self) -> Option<&Picked> {
        self.under_pointer.as_ref()
    }

    /// One-line description of the picked pixel.
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
    /// Requests the pixel under the pointer, and receives a pixel that has arrived.
    pub(super) fn point(&mut self, ctx: &Context, at: Option<Pointed>) {
        let revision = self.state.revision();
        if let (Some((at_px, layer)), Some(asked)) = (self.screen.picked(), self.pointing.asked) {
            let shown = self.state.shown().filter(|_| asked.revision == revision);
            let picked = shown.and_then(|shown| Picked::new(&layer, shown, &asked.view, at_px));
            if asked.pointed.is_click {
                let clicked = &mut self.pointing.clicked;
                clicked.extend(picked.clone());
                clicked.drain(..clicked.len().saturating_sub(2));
            }
            self.pointing.under_pointer = picked;
            ctx.request_repaint();
        }
        if self.screen.is_picking() {
            ctx.request_repaint();
        }
        let at = at.filter(|at| self.screen.refusal(at.side).is_none());
        if let Some(click) = at.filter(|at| at.is_click) {
            self.pointing.waiting = Some(click);
            if self.state.shows_errors() {
                self.magnifier.open(click);
            }
        }
        let waiting = self.pointing.waiting;
        let Some(pointed) = waiting.or(at) else {
            // A click counts even if the pointer has moved away before its pixel arrives.
            let is_picking = self.screen.is_picking();
            let asked = self.pointing.asked;
            self.pointing.asked = asked.filter(|asked| asked.pointed.is_click && is_picking);
            self.pointing.under_pointer = None;
            return;
        };
        let is_known = |asked: PixelRequest| asked.revision == revision && asked.pointed == pointed;
        let rests = !self.is_drawing() && !self.screen.is_picking();
        if !rests || self.pointing.asked.is_some_and(is_known) && waiting.is_none() {
            return;
        }
        self.pointing.waiting = None;
        let renderers = self.last.map(|last| last.renderers);
        let renderer = renderers.and_then(|r| r[pointed.side.index()]);
        let method = renderer.and_then(|renderer| renderer.method());
        let (Some(method), Some(view)) = (method, self.screen.view()) else {
            // For a slot drawn on the CPU, the screen has no layers to pick from.
            (self.pointing.asked, self.pointing.under_pointer) = (None, None);
            return;
        };
        self.pointing.asked = Some(PixelRequest {
            revision,
            pointed,
            view: *view,
        });
        if let Err(error) = self.screen.pick(method, pointed.at_px) {
            self.toasts.add(ctx, error.into());
        }
        ctx.request_repaint();
    }

    /// Puts the plane of the selected cut, or a new one, through the face under the pointer.
    pub(super) fn cut_here(&mut self, actions: &mut Vec<Action>) {
        let Some(picked) = &self.pointing.under_pointer else {
            return;
        };
        // The part in front of the face is removed, so the normal points into the solid, to the kept side.
        actions.push(Action::CutThrough(picked.point, -picked.normal));
    }
}
