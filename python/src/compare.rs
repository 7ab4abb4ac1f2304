//! Compares strategies on a scene: the same numbers as in the JSON of `cutaway compare`.

use std::sync::atomic::Ordering;

use cutaway::Error;
use cutaway_lab::experiment::{FrameQuestion, Renderer, check_memory, draw_options, errors, times};
use pyo3::prelude::*;

use crate::device::with_session;
use crate::door::{Result, stoppable};
use crate::opened::{OpenedDocument, Purpose, view};
use crate::scene::Scene;
use crate::state::CallSettings;

/// Compares strategies, and returns JSON. A Python interrupt ends the comparison after the current round.
pub(crate) fn compare(
    scene: &Scene,
    py: Python<'_>,
    strategies: Vec<String>,
    rounds: usize,
    asked: CallSettings,
    command: String,
) -> PyResult<String> {
    let scene = scene.shared();
    stoppable(py, move |stop| {
        let renderers = renderers(&strategies)?;
        let mut state = scene.state();
        let opened = state.open(asked, Purpose::Measurement)?;
        let goes_on = || !stop.load(Ordering::Relaxed);
        judged(opened, &renderers, rounds, command, &goes_on)
    })
}

/// The renderers with the given names, without duplicates.
fn renderers(names: &[String]) -> Result<Vec<Renderer>> {
    let mut renderers: Vec<Renderer> = Vec::new();
    for name in names {
        for renderer in Renderer::named(name)? {
            if !renderers.contains(&renderer) {
                renderers.push(renderer);
            }
        }
    }
    match renderers.is_empty() {
        false => Ok(renderers),
        true => {
            let help =
                "name some, for example [\"raycast+mask\", \"grid:256+vds:1024\"], or \"all\"";
            Err(Error::input("strategies", "there is none to compare", help))
        }
    }
}

fn judged(
    opened: &OpenedDocument,
    renderers: &[Renderer],
    rounds: usize,
    command: String,
    goes_on: &dyn Fn() -> bool,
) -> Result<String> {
    let settings = opened.timeline.settings();
    check_memory(settings.size_px(), renderers.len())?;
    let question = FrameQuestion {
        name: opened.scene.name.clone(),
        shown: &opened.at,
        view: view(opened)?,
        truth: None,
        command,
        options: draw_options(settings)?,
    };
    let mut silent = |_: String| {};
    let judgement = with_session(|session| {
        let mut judgement = errors(session, &question, renderers, &mut silent)?;
        times(
            session,
            &question,
            &mut judgement,
            rounds,
            &mut silent,
            goes_on,
        )?;
        Ok(judgement)
    })?;
    serde_json::to_string(&judgement.measurement).map_err(|e| {
        let help = "please report this, with the scene that caused it";
        Error::input("comparison", format!("cannot be encoded: {e}"), help)
    })
}
