//! The magnifier, which a click on a pixel opens while errors are shown: the pixel in the slots and the reference, and its ray's crossings.
//!
//! The magnifier follows the picture: after a change, once nothing moves, the same pixel is queried again.

use cutaway_lab::experiment::Renderer;
use eframe::egui::{
    Color32, ColorImage, Context, Grid, Key, Modifiers, Rect, RichText, ScrollArea, Sense, Stroke,
    StrokeKind, TextureHandle, Ui, Vec2, Window,
};

use super::Viewer;
use super::latest::Latest;
use super::viewport::Pointed;
use crate::judge::Subject;
use crate::judge::magnify::{DepthRow, Magnified, MagnifyQuestion, Neighbourhood, SIDE_PX};
use crate::picture::screen::PLAIN;

/// Size of a magnified pixel, in points.
const POINTS_PER_PX: f32 = 16.0;

/// Maximum height of the list of crossings, in points; a longer list scrolls.
const LIST_POINTS: f32 = 220.0;

/// Initial position of the magnifier's window, relative to the upper right corner of the viewer, in points.
const OPENS_AT: Vec2 = Vec2::new(-780.0, 40.0);

/// What a question is about; an equal one is not sent again.
#[derive(Clone, Copy, PartialEq)]
struct MagnifiedSubject {
    revision: u64,
    size_px: [u32; 2],
    renderers: [Option<Renderer>; 2],
    at_px: [u32; 2],
}

/// An answer, with the id of its question.
struct Answered {
    id: u64,
    magnified: Result<Magnified, String>,
    /// Textures of the neighbourhoods; `None` for one without a picture.
    pictures: Vec<Option<TextureHandle>>,
}

/// State of the magnifier's window.
#[derive(Default)]
pub(super) struct Magnifier {
    at_px: Option<[u32; 2]>,
    latest: Latest<MagnifiedSubject>,
    answered: Option<Answered>,
}

impl Magnifier {
    /// Opens the window for a pixel.
    pub(super) fn open(&mut self, pointed: Pointed) {
        self.at_px = Some(pointed.at_px);
    }

    /// The magnified pixel, once it is known.
    pub(super) fn magnified(&self) -> Option<&Magnified> {
        let answered = self
            .answered
            .as_ref()
            .filter(|a| a.id == self.latest.id())?;
        answered.magnified.as_ref().ok()
    }

    /// Returns true while an answer is pending.
    pub(super) fn is_busy(&self) -> bool {
        let is_answered = self
            .answered
            .as_ref()
            .is_some_and(|a| a.id == self.latest.id());
        self.at_px.is_some() && !is_answered
    }

    /// Receives an answer.
    pub(super) fn take_in(&mut self, ctx: &Context, id: u64, magnified: Result<Magnified, String>) {
        if id != self.latest.id() {
            return;
        }
        let texture = |shown: &Neighbourhood| {
            let image = shown.picture.as_ref().ok()?;
            let size = [image.width() as usize, image.height() as usize];
            let image = ColorImage::from_rgba_unmultiplied(size, image.as_raw());
            Some(ctx.load_texture(format!("magnified {}", shown.name), image, PLAIN))
        };
        let shown = magnified.iter().flat_map(|m| &m.neighbourhoods);
        self.answered = Some(Answered {
            id,
            pictures: shown.map(texture).collect(),
            magnified,
        });
    }

    fn close(&mut self) {
        self.latest.forget();
        (self.at_px, self.answered) = (None, None);
    }
}

impl Viewer {
    /// Sends a question about the magnified pixel if its subject has changed.
    pub(super) fn magnify(&mut self, ctx: &Context) {
        let Some(at_px) = self.magnifier.at_px else {
            return;
        };
        let is_within = at_px[0] < self.size_px[0] && at_px[1] < self.size_px[1];
        let subject = Subject::of(&self.state, self.size_px);
        let Some(subject) = subject.filter(|_| is_within) else {
            self.magnifier.close();
            return;
        };
        let Some(last) = self.last.filter(|_| !self.is_drawing()) else {
            return;
        };
        let about = MagnifiedSubject {
            revision: self.state.revision(),
            size_px: self.size_px,
            renderers: last.renderers,
            at_px,
        };
        let Some(id) = self.magnifier.latest.ask(about) else {
            return;
        };
        let question = MagnifyQuestion {
            id,
            subject,
            renderers: last.renderers,
            at_px,
        };
        let judge = self.judged.judge(ctx, &self.screen);
        judge.magnify(&self.state, question);
    }

    /// Shows the magnifier's window.
    pub(super) fn magnifier(&mut self, ctx: &Context) {
        let Some([x, y]) = self.magnifier.at_px else {
            return;
        };
        let is_current = !self.magnifier.is_busy();
        let mut is_open = true;
        let window = Window::new("Magnifier")
            .open(&mut is_open)
            .resizable(false)
            // Placed over the right panel, so that it does not hide the pixel.
            .default_pos(ctx.content_rect().right_top() + OPENS_AT);
        window.show(ctx, |ui| {
            ui.horizontal(|ui| {
                ui.label(format!("Pixel ({x}, {y})"));
                if !is_current {
                    ui.spinner();
                }
            });
            match &self.magnifier.answered {
                None => {
                    ui.label("comparing with exact ...");
                }
                Some(Answered {
                    magnified: Err(why),
                    ..
                }) => {
                    ui.label(why);
                }
                Some(Answered {
                    magnified: Ok(magnified),
                    pictures,
                    ..
                }) => {
                    if !is_current {
                        ui.set_opacity(0.5);
                    }
                    contents(ui, magnified, pictures);
                }
            }
        });
        let escapes = !ctx.egui_wants_keyboard_input()
            && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        if !is_open || escapes {
            self.magnifier.close();
        }
    }
}

fn contents(ui: &mut Ui, magnified: &Magnified, pictures: &[Option<TextureHandle>]) {
    ui.horizontal_top(|ui| {
        for (shown, picture) in magnified.neighbourhoods.iter().zip(pictures) {
            let width = POINTS_PER_PX * SIDE_PX as f32;
            ui.vertical(|ui| {
                ui.set_width(width);
                ui.strong(match shown.side {
                    Some(side) => format!("{side}: {}", shown.name),
                    None => shown.name.clone(),
                });
                match (picture, &shown.picture) {
                    (Some(picture), _) => neighbourhood(ui, picture),
                    (None, Err(why)) => {
                        ui.label(format!("refuses: {why}"));
                    }
                    (None, Ok(_)) => {}
                }
                ui.label(&shown.says);
            });
        }
    });
    ui.separator();
    if magnified.is_undecided {
        ui.label("Exact is undecided here: no answer can be called wrong.");
    }
    if magnified.depths.is_empty() {
        ui.label("The ray meets nothing of the model.");
        return;
    }
    ui.label("What the ray crosses, by the exact reference:");
    let list = (ScrollArea::vertical().max_height(LIST_POINTS)).min_scrolled_height(LIST_POINTS);
    list.show(ui, |ui| depths(ui, &magnified.depths));
}

/// Shows a neighbourhood, with a frame around the pixel in the middle.
fn neighbourhood(ui: &mut Ui, picture: &TextureHandle) {
    let size = Vec2::splat(POINTS_PER_PX * SIDE_PX as f32);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter_at(rect);
    let uv = Rect::from_min_max([0.0, 0.0].into(), [1.0, 1.0].into());
    painter.image(picture.id(), rect, uv, Color32::WHITE);
    let middle = Rect::from_center_size(rect.center(), Vec2::splat(POINTS_PER_PX));
    for (by, color) in [(0.0, Color32::WHITE), (1.0, Color32::BLACK)] {
        let stroke = Stroke::new(1.0, color);
        painter.rect_stroke(middle.expand(by), 0.0, stroke, StrokeKind::Outside);
    }
}

fn depths(ui: &mut Ui, rows: &[DepthRow]) {
    let grid = Grid::new("depths").num_columns(4).striped(true);
    grid.show(ui, |ui| {
        for title in ["Depth", "What", "Way", "State"] {
            ui.weak(title);
        }
        ui.end_row();
        for row in rows {
            let state = match (row.is_seen, row.is_kept) {
                (true, _) => "seen",
                (false, true) => "kept",
                (false, false) => "not kept",
            };
            for text in [&*format!("{:.5}", row.depth), &row.what, &row.way, state] {
                let text = RichText::new(text);
                ui.label(match (row.is_seen, row.is_kept) {
                    (true, _) => text.strong(),
                    (false, true) => text,
                    (false, false) => text.weak(),
                });
            }
            ui.end_row();
        }
    });
}
