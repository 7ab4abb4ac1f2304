//! The frames of an animation: drawn one after the other by one session, and reported.

use std::ops::Range;

use cutaway::Result;
use cutaway::layers::Layers;
use cutaway::scene::numbers::round;
use cutaway::scene::{Breakaway, BreakawayView, Cut, Scene};
use cutaway::session::{Outcome, Session};
use cutaway_lab::compare::FrameCounts;
use cutaway_lab::experiment::picture::{self, LayersNote};
use cutaway_lab::experiment::{Renderer, SceneAtTime, Stopwatch};
use serde_json::{Value, json};

use super::AnimateArgs;
use super::report::{self, FrameReport};
use super::target::AnimationOutput;
use super::times::Times;
use super::turntable::turned;
use crate::console::Console;
use crate::input::subject::SceneInput;
use crate::notes::warn_of_doubt;
use crate::renderer_request::RendererChoice;
use crate::verdict::Verdict;

/// If no progress bar shows the expected time, it is reported in advance when it is at least this many seconds.
const PATIENCE_S: f64 = 10.0;

/// Everything needed to draw the frames.
pub(super) struct Film<'a> {
    pub(super) args: &'a AnimateArgs,
    pub(super) subject: &'a SceneInput,
    pub(super) times: Times,
    /// The frames to draw: all, or a share.
    pub(super) own: Range<u32>,
    pub(super) chosen: RendererChoice,
    /// The prepared scene at the time of the last frame.
    pub(super) shown: SceneAtTime,
    pub(super) scene: Scene,
    /// True if a frame failed for a reason other than a defect of the mesh.
    pub(super) has_failed: bool,
}

impl Film<'_> {
    /// Draws a frame and returns it with its report.
    pub(super) fn draw(
        &mut self,
        frame: u32,
        session: &mut Session,
        console: &Console,
    ) -> Result<(image::RgbaImage, FrameReport)> {
        let watch = Stopwatch::start();
        let (subject, time_s) = (self.subject, self.times.at(frame));
        let is_first = frame == self.own.start;
        // The first frame's scene is already open; whatever does not move is reused.
        if frame > 0 && subject.timeline.moves() {
            self.scene = subject.timeline.at(time_s)?;
            self.shown = self.shown.updated(&self.scene);
        }
        let outline = self.shown.model.prepared.outline();
        let camera = match self.args.turn_deg {
            Some(turn_deg) => {
                let share = self.times.share(frame);
                turned(
                    &self.scene.camera,
                    (&subject.scene.bounds(), outline),
                    subject.size_px(),
                    turn_deg,
                    share,
                )
            }
            None => self.scene.camera,
        };
        // The turntable is not part of the timeline.
        let follows = |b: &Breakaway| b.view == BreakawayView::Each;
        let mut breakaways = self.scene.cuts.iter().filter_map(|c| c.breakaway.as_ref());
        if self.args.turn_deg.is_some() && breakaways.any(follows) {
            let view = self.scene.view_through(&camera, subject.size_px());
            let opened = |_: &Cut, b: &Breakaway| follows(b).then_some(&view);
            self.scene.open_breakaways_to(opened)?;
            self.shown = self.shown.updated(&self.scene);
        }
        let prepared = &self.shown.model.prepared;
        let view = prepared.view_of(&camera, subject.size_px());
        let fineness = subject.supersample();
        let (shown, renderer) = (&self.shown, self.chosen.renderer);
        let mut counts = FrameCounts::default();
        let mut count = |layers: &Layers, row| counts.add(layers, prepared, &view, row);
        let note: Option<LayersNote<'_>> = match renderer {
            Renderer::Method(_) if is_first => Some(&mut count),
            _ => None,
        };
        let drawn = picture::draw_noting(session, shown, &view, renderer, fineness, note)?;
        let report = FrameReport::of(time_s, &drawn.frames, watch.ms());
        if let (true, Renderer::Method(_), Outcome::Complete) =
            (is_first, renderer, &report.outcome)
        {
            let drawn = (&self.scene, &self.shown.model);
            let verdict = warn_of_doubt(counts.may_be_wrong, renderer, drawn, console);
            self.has_failed |= matches!(verdict, Verdict::Failed);
        }
        Ok((drawn.image, report))
    }

    /// Reports the estimated time of the remaining frames, from the time of the last frame: the first also builds what all frames share.
    pub(super) fn announce(&self, frames: &[FrameReport], console: &Console) {
        let left = self.own.len() - frames.len();
        let Some(ms) = frames.last().and_then(|f| f.drawn_ms) else {
            return;
        };
        let left_s = left as f64 * ms / 1000.0;
        if left_s > PATIENCE_S {
            console.milestone(format!(
                "{left} frames remain, {ms:.0} ms each: about {left_s:.0} s; a smaller --resolution, --fps or --supersample takes less"
            ));
        }
    }

    /// Report of the run and its frames as JSON.
    pub(super) fn json(
        &self,
        session: &Session,
        target: &AnimationOutput,
        frames: &[FrameReport],
    ) -> Value {
        let options = self.chosen.renderer.options();
        json!({
            "scene": self.subject.scene.name,
            "output": target.path(),
            "format": target.name(),
            "resolution": self.subject.size_px(),
            "supersample": self.subject.supersample(),
            "fps": self.times.fps,
            "start_s": self.times.start_s,
            "duration_s": self.times.duration_s(),
            "clip": self.subject.timeline.settings().clip,
            "turntable_deg": self.args.turn_deg,
            "adapter": session.gpu().report(),
            "strategy": picture::strategy_name(self.chosen.renderer),
            "chosen_for": self.chosen.reason,
            "rasteriser": options.rasteriser.unwrap_or_default().to_string(),
            "height_filter": options.height_filter.unwrap_or_default().to_string(),
            "median_drawn_ms": report::median_ms(frames),
            "frames": frames.iter().map(FrameReport::json).collect::<Vec<_>>(),
        })
    }

    /// Reports all frames in one line.
    pub(super) fn say(&self, frames: &[FrameReport], console: &Console) {
        let [width, height] = self.subject.size_px();
        let clocks = report::clocks(frames);
        let clocks = if clocks.is_empty() {
            clocks
        } else {
            format!("; clocks that ran: {clocks}")
        };
        let kept = match frames.iter().filter(|f| f.is_kept()).count() {
            0 => String::new(),
            kept => format!("; {kept} already existed, from an earlier run of this command"),
        };
        console.note(format!(
            "{} frames of {width} x {height}, {} s at {} a second, drawn in {:.0} ms each{clocks}{kept}",
            frames.len(),
            round(self.times.duration_s()),
            round(self.times.fps),
            report::median_ms(frames),
        ));
    }
}
