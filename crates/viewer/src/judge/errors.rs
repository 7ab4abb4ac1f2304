//! Compares the slots with the reference at increasing resolution, and computes the layers of slots drawn on the CPU.

use cutaway::Result;
use cutaway_lab::compare::{compare, heatmap_overlay};
use cutaway_lab::experiment::{Evaluator, Renderer};

use super::context::JudgeContext;
use super::{Answer, AnswerSink, Content, ErrorQuestion, Subject};
use crate::picture::slot::SlotSide;

/// Resolution divisors of the successive answers.
pub(super) const DIVISORS: [u32; 3] = [4, 2, 1];

/// Answers a question step by step, until it is outdated. Returns true if it was completed.
pub(super) async fn answer(
    context: &mut JudgeContext,
    question: &ErrorQuestion,
    sink: &impl AnswerSink,
) -> bool {
    let id = question.id;
    for divisor in DIVISORS {
        let subject = Subject {
            size_px: (question.subject.size_px).map(|s| (s / divisor).max(1)),
            ..question.subject.clone()
        };
        for side in SlotSide::BOTH {
            let Some(renderer) = question.renderers[side.index()] else {
                continue;
            };
            if sink.is_superseded().await {
                return false;
            }
            let say = |what| {
                sink.send(Answer {
                    id,
                    side,
                    divisor,
                    what,
                });
            };
            let judged = context.retried(async |context| {
                judge(context, &subject, renderer, question.wants_errors, &say).await
            });
            if let Err(error) = judged.await {
                say(Content::Failed(error.to_string()));
            }
        }
    }
    true
}

/// Answers for a slot at one resolution.
async fn judge(
    context: &mut JudgeContext,
    subject: &Subject,
    renderer: Renderer,
    wants_errors: bool,
    say: &impl Fn(Content),
) -> Result<()> {
    let (model, view) = (&subject.at.model, subject.view());
    let layers = match renderer {
        Renderer::Cpu(Evaluator::Exact) => context.exact(subject)?.layers.clone(),
        Renderer::Cpu(evaluator) => evaluator.evaluate(subject.at.truth()?, &view).layers,
        Renderer::Method(_) if !wants_errors => return Ok(()),
        Renderer::Method(method) => {
            let session = context.session().await?;
            match session.layers_async(model, &view, method).await? {
                Ok(layers) => layers,
                Err(refusal) => {
                    say(Content::Failed(refusal.reason));
                    return Ok(());
                }
            }
        }
    };
    if wants_errors && renderer != Renderer::EXACT {
        let exact = context.exact(subject)?;
        let comparison = compare(&exact, &layers, &view, model.prepared.scale);
        let marks = heatmap_overlay(&exact, &layers);
        say(Content::Errors { marks, comparison });
    }
    if let Renderer::Cpu(_) = renderer {
        say(Content::Layers(layers));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    use crate::State;
    use cutaway::strategies::Strategy;
    use cutaway_io::Document;
    use cutaway_io::document::part;
    use cutaway_io::load::Assets;
    use cutaway_lab::compare::Comparison;
    use pollster::block_on;

    #[derive(Default)]
    struct Collected(RefCell<Vec<Answer>>);

    impl AnswerSink for Collected {
        fn send(&self, answer: Answer) {
            self.0.borrow_mut().push(answer);
        }

        async fn is_superseded(&self) -> bool {
            false
        }
    }

    #[test]
    fn a_lost_device_is_replaced_and_the_errors_are_as_before() {
        let mut document = Document::new();
        document.add_part(part("shape:cube")).expect("a part");
        let state = State::open(document, Assets::default()).expect("a scene");
        let method = Strategy::all()[0].into();
        let question = ErrorQuestion {
            id: 1,
            subject: Subject::of(&state, [64, 48]).expect("a picture"),
            renderers: [Some(Renderer::Method(method)), None],
            wants_errors: true,
        };
        let mut context = JudgeContext::new(None);
        let mut ask = |loses: bool| -> Vec<(u32, Comparison)> {
            if loses {
                let session = block_on(context.session()).expect("a device");
                session.gpu().device().destroy();
            }
            let collected = Collected::default();
            assert!(
                block_on(answer(&mut context, &question, &collected)),
                "to its end"
            );
            let answers = collected.0.into_inner().into_iter();
            let counts = answers.map(|answer| match answer.what {
                Content::Errors { comparison, .. } => (answer.divisor, comparison),
                other => panic!("{other:?}"),
            });
            counts.collect()
        };
        let first = ask(false);
        assert_eq!(first.len(), DIVISORS.len());
        assert_eq!(ask(true), first);
    }
}
