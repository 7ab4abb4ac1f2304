//! One point of an experiment, from its scene to its record.
//!
//! Errors are measured first; expectations are checked and reported before any time is taken, so that a user can end a run that has
//! already failed. Then times are taken in interleaved rounds, warnings are derived, and the pictures are drawn last.
//!
//! Progress is reported to a [`Watcher`].

use std::collections::BTreeMap;
use std::path::Path;

use cutaway::error::Diagnostic;
use cutaway::scene::doubts;
use cutaway::session::Session;
use cutaway::{Error, Result};
use cutaway_io::document::{Document, Timeline};
use cutaway_io::load::Assets;
use image::RgbaImage;

use super::definition::SceneRun;
use super::drift::flicker;
use super::expect::{Findings, reached};
use super::judge::{FrameQuestion, Judgement, error_steps, errors, times, timing_steps};
use super::sweep::Point;
use super::{
    Invocation, Machine, Reached, Record, RecordedPicture, Renderer, SceneAtTime, Warning,
    draw_options,
};

/// Observer of a run.
pub trait Watcher {
    /// A step begins.
    fn step(&self, what: String);
    /// Opening the scene gave a remark. It is reported once, even if the truth scene has the same fault.
    fn opened(&self, message: &Diagnostic);
    /// An expectation was compared with the result.
    fn reached(&self, reached: &Reached);
    /// Returns false to stop the run; a point that is not complete is then discarded.
    fn goes_on(&self) -> bool;
}

/// A point to measure, and the fields of its record that are not measured.
pub struct Assignment<'a> {
    /// Name of the experiment.
    pub experiment: &'a str,
    /// Name of the run.
    pub run_name: &'a str,
    /// The run.
    pub run: &'a SceneRun,
    /// The point.
    pub point: &'a Point,
    /// Measured rounds.
    pub rounds: usize,
    /// True if the point is measured with `--quick`.
    pub is_quick: bool,
    /// True if pictures are kept.
    pub keeps_pictures: bool,
    /// Identity of the point, see [`Record::identity`].
    pub identity: String,
    /// The command line that measures the point again.
    pub command: String,
    /// The machine on which the point is measured.
    pub machine: &'a Machine,
    /// The command that measures the point.
    pub invocation: &'a Invocation,
}

impl SceneRun {
    /// Number of steps reported while a point is measured.
    pub fn steps(&self, point: &Point, rounds: usize) -> usize {
        let drift = self.drift.map_or(0, |d| d.frames as usize);
        1 + drift + error_steps(point.trials.len()) + timing_steps(rounds)
    }
}

/// Common name of a point's files, without extension.
pub fn file_stem(run: &str, point: &Point) -> String {
    match point.stem.as_str() {
        "" => run.to_owned(),
        stem => format!("{run}.{stem}"),
    }
}

/// Pictures, each with its file name.
pub type NamedPictures = Vec<(String, RgbaImage)>;

/// A measured point.
pub struct Measured {
    /// Its record.
    pub record: Record,
    /// Its pictures, under the file names given in the record.
    pub pictures: NamedPictures,
}

/// Measures a point; returns `None` if the run was stopped. Leaves nothing in the session.
pub fn measure(
    session: &mut Session,
    assignment: &Assignment<'_>,
    watcher: &dyn Watcher,
) -> Result<Option<Measured>> {
    let measured = measure_with(session, assignment, watcher);
    session.forget();
    measured
}

fn measure_with(
    session: &mut Session,
    assignment: &Assignment<'_>,
    watcher: &dyn Watcher,
) -> Result<Option<Measured>> {
    let point = assignment.point;
    watcher.step(format!("opening {}", point.scene.name()));
    let mut assets = Assets::default();
    let mut reported: Vec<Diagnostic> = Vec::new();
    let mut open = |document: &Document| -> Result<(Timeline, SceneAtTime)> {
        let timeline = document.timeline(&mut assets)?;
        let scene = timeline.scene()?;
        for message in timeline.notes().iter().cloned().chain(doubts(&scene)) {
            if !reported.contains(&message) {
                watcher.opened(&message);
                reported.push(message);
            }
        }
        Ok((timeline, SceneAtTime::new(&scene)))
    };
    let (timeline, shown) = open(&point.scene)?;
    let truth = point.truth.as_ref().map(&mut open).transpose()?;
    let truth = truth.map(|(_, truth)| truth);
    must_be_framed_alike(&shown, truth.as_ref())?;
    let question = FrameQuestion {
        name: point.scene.name(),
        view: shown.model.prepared.view(timeline.settings().size_px()),
        shown: &shown,
        truth: truth.as_ref(),
        options: draw_options(timeline.settings())?,
        command: assignment.command.clone(),
    };
    let renderers: Vec<Renderer> = point.trials.iter().map(|e| e.renderer).collect();
    let mut step = |what| watcher.step(what);
    let goes_on = || watcher.goes_on();
    let figures = match assignment.run.drift {
        None => vec![BTreeMap::new(); renderers.len()],
        Some(drift) => {
            let found = flicker(session, &question, &renderers, drift, &mut step, &goes_on)?;
            let Some(found) = found else {
                return Ok(None);
            };
            found
        }
    };
    let mut judgement = errors(session, &question, &renderers, &mut step)?;
    let found = Findings {
        measurement: &judgement.measurement,
        figures: &figures,
    };
    let expectations = reached(assignment.run, point, &found);
    for reached in &expectations {
        watcher.reached(reached);
    }
    let rounds = assignment.rounds;
    if !times(
        session,
        &question,
        &mut judgement,
        rounds,
        &mut step,
        &goes_on,
    )? {
        return Ok(None);
    }
    let (pictures, images) = if assignment.keeps_pictures {
        pictures(
            session,
            &question,
            &judgement,
            &file_stem(assignment.run_name, point),
        )?
    } else {
        Default::default()
    };
    let measurement = judgement.measurement;
    let mut warnings = Warning::all_of(&measurement, assignment.machine, assignment.is_quick);
    let of_opening = |m: &Diagnostic| Warning::of_opening(&m.to_string());
    warnings.extend(reported.iter().map(of_opening));
    let record = Record {
        format: Record::FORMAT,
        experiment: assignment.experiment.to_owned(),
        run: assignment.run_name.to_owned(),
        parameters: point.parameters.clone(),
        is_quick: assignment.is_quick,
        identity: assignment.identity.clone(),
        scene: point.scene.moved_to(Path::new("scene.toml"))?,
        truth: (point.truth.as_ref())
            .map(|truth| truth.moved_to(Path::new("scene.toml")))
            .transpose()?,
        families: (point.trials.iter())
            .map(|e| {
                e.families
                    .iter()
                    .map(|(_, member)| member.clone())
                    .collect()
            })
            .collect(),
        figures,
        expectations,
        warnings,
        pictures,
        invocation: Some(assignment.invocation.clone()),
        measurement,
    };
    Ok(Some(Measured {
        record,
        pictures: images,
    }))
}

/// Checks that both scenes have the same centre and scale, as otherwise the same pixel shows different positions in them.
fn must_be_framed_alike(shown: &SceneAtTime, truth: Option<&SceneAtTime>) -> Result<()> {
    let Some(truth) = truth else {
        return Ok(());
    };
    let [a, b] = [shown, truth].map(|s| &s.model.prepared);
    let apart = (a.centre_in_world - b.centre_in_world).length() * a.scale;
    if apart < 1e-9 && (a.scale / b.scale - 1.0).abs() < 1e-9 {
        return Ok(());
    }
    Err(Error::input(
        "truth",
        "its bounds are not those of the scene, so that cameras and sections in percent differ",
        "give both scenes the same bounds",
    ))
}

/// Pictures of exact and of all renderers that drew a frame, with their file names.
fn pictures(
    session: &mut Session,
    question: &FrameQuestion<'_>,
    judgement: &Judgement,
    stem: &str,
) -> Result<(Vec<RecordedPicture>, NamedPictures)> {
    let [width, height] = question.view.size_px;
    let image = |rgba| RgbaImage::from_raw(width, height, rgba).unwrap_or_default();
    let exact = session.shade(
        &question.shown.model,
        &question.view,
        &judgement.exact.layers,
    )?;
    let file = format!("{stem}.exact.png");
    let mut images = vec![(file.clone(), image(exact))];
    let mut pictures = vec![RecordedPicture {
        drawer: "exact".to_owned(),
        file,
        heatmap: None,
    }];
    for frame in &judgement.frames {
        let Some(heatmap) = judgement.heatmap(frame) else {
            continue;
        };
        let renderer = frame.renderer.to_string();
        let safe = renderer.replace([':', ',', '@'], "-");
        let (file, map) = (
            format!("{stem}.{safe}.png"),
            format!("{stem}.{safe}.heatmap.png"),
        );
        images.push((file.clone(), image(judgement.picture(session, frame)?)));
        images.push((map.clone(), heatmap));
        pictures.push(RecordedPicture {
            drawer: renderer,
            file,
            heatmap: Some(map),
        });
    }
    Ok((pictures, images))
}
