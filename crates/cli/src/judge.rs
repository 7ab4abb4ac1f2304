//! Comparison of strategies on the command line's scene, with progress on the console.

use cutaway::Result;
use cutaway::session::Session;
use cutaway_lab::experiment::{
    FrameQuestion, Judgement, Renderer, SceneAtTime, error_steps, errors, times, timing_steps,
};

use super::console::Console;
use super::input::subject::SceneInput;

/// Number of progress steps of [`judge`].
pub(super) fn steps(renderers: usize, rounds: usize) -> usize {
    error_steps(renderers) + timing_steps(rounds)
}

/// Measures the errors of strategies on a scene, then their times.
pub(super) fn judge(
    session: &mut Session,
    shown: &SceneAtTime,
    subject: &SceneInput,
    renderers: &[Renderer],
    rounds: usize,
    console: &Console,
) -> Result<Judgement> {
    let question = FrameQuestion {
        name: subject.scene.name.clone(),
        shown,
        view: subject.view(&shown.model.prepared),
        truth: None,
        options: subject.options()?,
        command: command_line(),
    };
    let mut step = |what: String| console.step(what);
    let mut judgement = errors(session, &question, renderers, &mut step)?;
    times(
        session,
        &question,
        &mut judgement,
        rounds,
        &mut step,
        &|| true,
    )?;
    Ok(judgement)
}

/// This process's command line, ready to be typed again.
pub(super) fn command_line() -> String {
    quoted(std::env::args().skip(1))
}

/// A command line of these words; words that a shell would change are quoted.
pub(super) fn quoted(words: impl Iterator<Item = String>) -> String {
    let words = words.map(|word| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_=+,.:/%@".contains(c);
        if !word.is_empty() && word.chars().all(plain) {
            word
        } else {
            format!("'{}'", word.replace('\'', "'\\''"))
        }
    });
    std::iter::once("cutaway".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}
