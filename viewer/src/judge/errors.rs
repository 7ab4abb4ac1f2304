//! The errors of the slots against the reference, coarse at first, and the pictures of slots that are drawn on the CPU.

use cutaway::compare::{compare, heatmap_overlay};
use cutaway::experiment::{Evaluator, Renderer};
use cutaway::{Outcome, Result};

use super::worker::{Worker, picture};
use super::{Answer, Known, Question, Subject};
use crate::slot::Side;

/// By how much coarser the answers are that come one after the other.
const DIVISORS: [u32; 3] = [4, 2, 1];

/// Answers a question step by step, until it is outdated.
pub(super) fn answer(
    worker: &mut Worker,
    question: &Question,
    is_outdated: &dyn Fn() -> bool,
    say: &dyn Fn(Answer),
) {
    let id = question.id;
    for divisor in DIVISORS {
        let subject = Subject {
            size_px: (question.subject.size_px).map(|s| (s / divisor).max(1)),
            ..question.subject.clone()
        };
        for side in Side::BOTH {
            let Some(renderer) = question.renderers[side.index()] else {
                continue;
            };
            if is_outdated() {
                return;
            }
            let say = |what| {
                say(Answer {
                    id,
                    side,
                    divisor,
                    what,
                });
            };
            let judged = judge(worker, &subject, renderer, question.wants_errors, &say);
            if let Err(error) = judged {
                say(Known::Failed(error.to_string()));
            }
        }
    }
}

/// Says what is to be known of a slot at a resolution.
fn judge(
    worker: &mut Worker,
    subject: &Subject,
    renderer: Renderer,
    wants_errors: bool,
    say: &dyn Fn(Known),
) -> Result<()> {
    let (model, view) = (&subject.at.model, subject.view());
    let layers = match renderer {
        Renderer::Cpu(Evaluator::Exact) => worker.exact(subject)?.layers.clone(),
        Renderer::Cpu(evaluator) => evaluator.evaluate(subject.at.truth()?, &view).layers,
        Renderer::Method(_) if !wants_errors => return Ok(()),
        Renderer::Method(method) => {
            let session = worker.session()?;
            let drawn = session.draw(model, &view, method)?;
            if let Outcome::Refused(refusal) = drawn.outcome {
                say(Known::Failed(refusal.reason));
                return Ok(());
            }
            session.layers(method)?
        }
    };
    if let Renderer::Cpu(_) = renderer {
        let rgba = worker.session()?.shade(model, &view, &layers)?;
        say(Known::Picture(picture(view.size_px, rgba)));
    }
    if wants_errors && renderer != Renderer::EXACT {
        let exact = worker.exact(subject)?;
        let comparison = compare(&exact, &layers, &view, model.prepared.scale);
        let marks = heatmap_overlay(&exact, &layers);
        say(Known::Errors { marks, comparison });
    }
    Ok(())
}
