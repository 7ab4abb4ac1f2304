//! Results from the judge: error marks, error counts, and the pictures of slots drawn on the CPU.

use cutaway_lab::compare::Comparison;
use cutaway_lab::experiment::Renderer;
use eframe::egui::{ColorImage, Context, TextureHandle};
use image::RgbaImage;

use super::latest::Latest;
use crate::judge::{Answer, Content, ErrorQuestion, Judge, JudgeFinding, Subject};
use crate::picture::screen::{PLAIN, Screen};
use crate::picture::slot::SlotSide;
use crate::state::State;

/// The errors known for a slot.
#[derive(Default)]
struct Errors {
    /// Id of the question that they answer.
    id: u64,
    divisor: u32,
    marks: Option<TextureHandle>,
    comparison: Comparison,
    failed: Option<String>,
}

/// What a question is about; an equal one is not sent again.
#[derive(Clone, Copy, PartialEq)]
struct JudgedSubject {
    revision: u64,
    is_preclassified: bool,
    size_px: [u32; 2],
    renderers: [Option<Renderer>; 2],
    wants_errors: bool,
}

/// The judge, and the answers received from it.
#[derive(Default)]
pub(super) struct JudgeState {
    judge: Option<Judge>,
    latest: Latest<JudgedSubject>,
    /// The picture of the last question.
    subject: Option<Subject>,
    errors: [Errors; 2],
    /// For each slot drawn on the CPU: the id of the question that its picture answers, and the picture's resolution divisor.
    pictures: [(u64, u32); 2],
}

impl JudgeState {
    /// Sends a question about the visible picture if an answer is needed and the question differs from the last one.
    pub(super) fn ask(
        &mut self,
        ctx: &Context,
        state: &State,
        screen: &Screen,
        (size_px, renderers, is_preclassified): ([u32; 2], [Option<Renderer>; 2], bool),
    ) {
        let wants_errors = state.shows_errors();
        let is_on_cpu = |r: &Renderer| r.method().is_none();
        let paints = renderers.iter().flatten().any(is_on_cpu);
        let is_needed = wants_errors || paints;
        // Hatches change pictures but not errors, so they matter only for slots drawn on the CPU.
        let is_preclassified = paints && is_preclassified;
        let about = JudgedSubject {
            revision: state.revision(),
            is_preclassified,
            size_px,
            renderers,
            wants_errors,
        };
        let subject = Subject::of(state, size_px).filter(|_| is_needed);
        let Some((subject, id)) = subject.and_then(|s| Some((s, self.latest.ask(about)?))) else {
            return;
        };
        self.subject = Some(subject.clone());
        let question = ErrorQuestion {
            id,
            subject,
            renderers,
            wants_errors,
        };
        self.judge(ctx, screen).ask(state, question);
    }

    /// The judge, which is started on the first call.
    pub(super) fn judge(&mut self, ctx: &Context, screen: &Screen) -> &Judge {
        let wake = ctx.clone();
        let adapter = screen.gpu().name();
        (self.judge).get_or_insert_with(|| Judge::start(adapter, move || wake.request_repaint()))
    }

    /// New findings other than errors.
    pub(super) fn findings(&self) -> Vec<JudgeFinding> {
        self.judge.iter().flat_map(Judge::findings).collect()
    }

    /// Receives new answers. Returns true if one of them is a picture.
    pub(super) fn take_in(&mut self, ctx: &Context, state: &State, screen: &mut Screen) {
        let answers: Vec<Answer> = self.judge.iter().flat_map(Judge::answers).collect();
        for Answer {
            id,
            side,
            divisor,
            what,
        } in answers
        {
            // Errors from an older question are shown, faded, until newer ones arrive.
            let wants_difference = state.layout() == crate::picture::slot::SlotLayout::Difference;
            let by = self.renderer(side);
            let errors = &mut self.errors[side.index()];
            match what {
                Content::Layers(layers) if id == self.latest.id() => {
                    self.pictures[side.index()] = (id, divisor);
                    if let (Some(by), Some(subject)) = (by, &self.subject) {
                        let put = screen.put(side, by, subject, &layers, wants_difference);
                        if let Err(error) = put {
                            screen.refuse(side, error.to_string());
                        }
                    }
                }
                Content::Layers(_) => {}
                Content::Failed(why) => {
                    if id == self.latest.id() && by.is_some_and(|by| by.method().is_none()) {
                        screen.refuse(side, why.clone());
                    }
                    *errors = Errors {
                        id,
                        failed: Some(why),
                        ..Errors::default()
                    };
                }
                Content::Errors { marks, comparison } => {
                    let name = format!("errors of {side}");
                    let marks = Some(ctx.load_texture(name, as_egui(&marks), PLAIN));
                    *errors = Errors {
                        id,
                        divisor,
                        marks,
                        comparison,
                        failed: None,
                    };
                }
            }
        }
    }

    /// The slot's renderer in the last question.
    fn renderer(&self, side: SlotSide) -> Option<Renderer> {
        self.latest.about()?.renderers[side.index()]
    }

    /// Error marks of a slot, and true if they belong to the visible picture.
    pub(super) fn marks(&self, side: SlotSide) -> Option<(&TextureHandle, bool)> {
        let errors = &self.errors[side.index()];
        errors
            .marks
            .as_ref()
            .map(|map| (map, errors.id == self.latest.id()))
    }

    /// Returns true while an answer is pending.
    pub(super) fn is_busy(&self) -> bool {
        let Some(JudgedSubject {
            renderers,
            wants_errors,
            ..
        }) = self.latest.about()
        else {
            return false;
        };
        let whole = (self.latest.id(), 1);
        let is_open = |side: SlotSide| {
            let errors = &self.errors[side.index()];
            let has_failed = errors.failed.is_some() && errors.id == self.latest.id();
            let Some(renderer) = renderers[side.index()].filter(|_| !has_failed) else {
                return false;
            };
            let is_painted = renderer.method().is_some() || self.pictures[side.index()] == whole;
            let is_judged = !wants_errors
                || renderer == Renderer::EXACT
                || (errors.id, errors.divisor) == whole;
            !(is_painted && is_judged)
        };
        SlotSide::BOTH.into_iter().any(is_open)
    }

    /// Error counts of a slot, and the resolution divisor at which they were computed.
    pub(super) fn counts(&self, side: SlotSide) -> Option<(&Comparison, u32)> {
        let errors = &self.errors[side.index()];
        let is_known = errors.marks.is_some() && errors.id == self.latest.id();
        is_known.then_some((&errors.comparison, errors.divisor))
    }

    /// One-line status of a slot.
    pub(super) fn sentence(&self, side: SlotSide, state: &State, screen: &Screen) -> String {
        let painter = state.painter(side);
        let errors = &self.errors[side.index()];
        if let Some(why) = screen.refusal(side) {
            return format!("{side}: {painter} refuses: {why}");
        }
        if !state.shows_errors() || painter == crate::picture::slot::Painter::Named(Renderer::EXACT)
        {
            return format!("{side}: {painter}");
        }
        if let Some(why) = errors
            .failed
            .as_ref()
            .filter(|_| errors.id == self.latest.id())
        {
            return format!("{side}: {painter}: {why}");
        }
        let Some((counts, divisor)) = self.counts(side) else {
            return format!("{side}: {painter}: comparing with exact ...");
        };
        let at = match divisor {
            1 => String::new(),
            divisor => format!(" at 1/{divisor} of the resolution"),
        };
        format!(
            "{side}: {painter}: {} px decided wrong, {} missed cap, {} leaked cap, {} cracks{at}",
            counts.decided_wrong_px, counts.missed_cap_px, counts.leaked_cap_px, counts.crack_px
        )
    }
}

fn as_egui(image: &RgbaImage) -> ColorImage {
    let size = [image.width() as usize, image.height() as usize];
    ColorImage::from_rgba_unmultiplied(size, image.as_raw())
}
