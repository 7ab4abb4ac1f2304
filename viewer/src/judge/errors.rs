//! The errors of the slots against the reference, coarse at first, and the layers of slots that are found on the CPU.

use cutaway::Result;
use cutaway::compare::{compare, heatmap_overlay};
use cutaway::experiment::{Evaluator, Renderer};

use super::bench::Bench;
use super::{Answer, Asker, Known, Question, Subject};
use crate::slot::Side;

/// By how much coarser the answers are that come one after the other.
const DIVISORS: [u32; 3] = [4, 2, 1];

/// Answers a question step by step, until it is outdated; whether it came to its end.
pub(super) async fn answer(bench: &mut Bench, question: &Question, asker: &impl Asker) -> bool {
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
            if asker.is_outdated().await {
                return false;
            }
            let say = |what| {
                asker.tell(Answer {
                    id,
                    side,
                    divisor,
                    what,
                });
            };
            let judged = judge(bench, &subject, renderer, question.wants_errors, &say);
            if let Err(error) = judged.await {
                say(Known::Failed(error.to_string()));
            }
        }
    }
    true
}

/// Says what is to be known of a slot at a resolution.
async fn judge(
    bench: &mut Bench,
    subject: &Subject,
    renderer: Renderer,
    wants_errors: bool,
    say: &impl Fn(Known),
) -> Result<()> {
    let (model, view) = (&subject.at.model, subject.view());
    let layers = match renderer {
        Renderer::Cpu(Evaluator::Exact) => bench.exact(subject)?.layers.clone(),
        Renderer::Cpu(evaluator) => evaluator.evaluate(subject.at.truth()?, &view).layers,
        Renderer::Method(_) if !wants_errors => return Ok(()),
        Renderer::Method(method) => {
            let session = bench.session().await?;
            match session.layers_async(model, &view, method).await? {
                Ok(layers) => layers,
                Err(refusal) => {
                    say(Known::Failed(refusal.reason));
                    return Ok(());
                }
            }
        }
    };
    if wants_errors && renderer != Renderer::EXACT {
        let exact = bench.exact(subject)?;
        let comparison = compare(&exact, &layers, &view, model.prepared.scale);
        let marks = heatmap_overlay(&exact, &layers);
        say(Known::Errors { marks, comparison });
    }
    if let Renderer::Cpu(_) = renderer {
        say(Known::Layers(layers));
    }
    Ok(())
}
