//! Questions and answers as messages between a page and its worker: JSON, with pixels as separate bytes.

use bytemuck::pod_collect_to_vec;
use cutaway::Layers;
use cutaway::gpu::{layers_from_words, words_from_layers};
use cutaway_lab::compare::Comparison;
use cutaway_lab::experiment::Renderer;
use image::RgbaImage;
use js_sys::{Array, Uint8Array};
use serde::{Deserialize, Serialize};
use wasm_bindgen::{JsCast, JsValue};

use super::magnify::{DepthRow, Magnified, Neighbourhood, SIDE_PX};
use super::{Answer, Content, JudgeFinding, Subject, failed};
use crate::picture::slot::SlotSide;

/// A question.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct QuestionMessage {
    pub(super) id: u64,
    pub(super) revision: u64,
    pub(super) size_px: [u32; 2],
    renderers: [Option<String>; 2],
    pub(super) about: QuestionKind,
}

/// What a question is about.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub(super) enum QuestionKind {
    /// The pictures in the slots; `wants_errors` also requests their errors.
    Slots { wants_errors: bool },
    /// A pixel.
    Pixel([u32; 2]),
}

impl QuestionKind {
    /// Index of the kind of question. Lower kinds are answered first, and of each kind only the newest question.
    pub(super) fn kind(self) -> usize {
        match self {
            Self::Pixel(_) => 0,
            Self::Slots { .. } => 1,
        }
    }
}

impl QuestionMessage {
    pub(super) fn new(
        id: u64,
        subject: &Subject,
        renderers: [Option<Renderer>; 2],
        about: QuestionKind,
    ) -> Self {
        Self {
            id,
            revision: subject.revision,
            size_px: subject.size_px,
            renderers: renderers.map(|r| r.map(|r| r.to_string())),
            about,
        }
    }

    pub(super) fn renderers(&self) -> [Option<Renderer>; 2] {
        let renderer = |name: &Option<String>| name.as_deref()?.parse().ok();
        self.renderers.each_ref().map(renderer)
    }

    /// Replies that the worker sends if it cannot answer, with the reason.
    pub(super) fn unanswered(&self, why: &str) -> Vec<Reply> {
        match self.about {
            QuestionKind::Slots { .. } => failed(self.id, why).map(Reply::Answer).into(),
            QuestionKind::Pixel(_) => {
                vec![Reply::JudgeFinding(JudgeFinding::Magnified(
                    self.id,
                    Err(why.to_owned()),
                ))]
            }
        }
    }
}

/// A reply of the worker.
pub(super) enum Reply {
    Answer(Answer),
    JudgeFinding(JudgeFinding),
}

#[derive(Serialize, Deserialize)]
enum ReplyMessage {
    Slot {
        id: u64,
        is_b: bool,
        divisor: u32,
        content: ContentMessage,
    },
    Magnified {
        id: u64,
        magnified: Result<MagnifiedMessage, String>,
    },
}

#[derive(Serialize, Deserialize)]
enum ContentMessage {
    Layers([u32; 2]),
    Errors([u32; 2], Box<Comparison>),
    Failed(String),
}

#[derive(Serialize, Deserialize)]
struct MagnifiedMessage {
    at_px: [u32; 2],
    neighbourhoods: Vec<NeighbourhoodMessage>,
    depths: Vec<DepthRow>,
    is_undecided: bool,
}

#[derive(Serialize, Deserialize)]
struct NeighbourhoodMessage {
    /// True for slot B; `None` for the reference.
    is_b: Option<bool>,
    name: String,
    says: String,
    /// Reason why there is no picture. If there is one, it is in the separate bytes.
    refused: Option<String>,
}

/// Bytes of a neighbourhood's picture.
const NEIGHBOURHOOD_BYTES: usize = (SIDE_PX * SIDE_PX * 4) as usize;

fn side(is_b: bool) -> SlotSide {
    if is_b { SlotSide::B } else { SlotSide::A }
}

impl Reply {
    /// The result as a message; `None` for kinds that a worker does not produce.
    pub(super) fn into_message(self) -> Option<JsValue> {
        let (message, bytes) = match self {
            Self::Answer(Answer {
                id,
                side,
                divisor,
                what,
            }) => {
                let (content, bytes) = content_message(what);
                let message = ReplyMessage::Slot {
                    id,
                    is_b: side == SlotSide::B,
                    divisor,
                    content,
                };
                (message, bytes)
            }
            Self::JudgeFinding(JudgeFinding::Magnified(id, magnified)) => {
                let mut bytes = Vec::new();
                let magnified = magnified.map(|m| magnified_message(m, &mut bytes));
                (ReplyMessage::Magnified { id, magnified }, bytes)
            }
            Self::JudgeFinding(_) => return None,
        };
        let text = serde_json::to_string(&message).ok()?;
        Some(Array::of2(&text.into(), &Uint8Array::from(&*bytes)).into())
    }

    pub(super) fn from_message(message: &JsValue) -> Option<Self> {
        let message: &Array = message.dyn_ref()?;
        let reply: ReplyMessage = serde_json::from_str(&message.get(0).as_string()?).ok()?;
        let bytes = message.get(1).dyn_into::<Uint8Array>().ok()?.to_vec();
        Some(match reply {
            ReplyMessage::Slot {
                id,
                is_b,
                divisor,
                content,
            } => Self::Answer(Answer {
                id,
                side: side(is_b),
                divisor,
                what: content_from(content, bytes)?,
            }),
            ReplyMessage::Magnified { id, magnified } => {
                let magnified = magnified.map(|m| magnified_from(m, &bytes));
                Self::JudgeFinding(JudgeFinding::Magnified(id, magnified))
            }
        })
    }
}

fn content_message(content: Content) -> (ContentMessage, Vec<u8>) {
    match content {
        Content::Layers(layers) => {
            let words = words_from_layers(&layers);
            let bytes = bytemuck::cast_slice(&words).to_vec();
            (ContentMessage::Layers(layers.size_px), bytes)
        }
        Content::Errors { marks, comparison } => {
            let size_px = [marks.width(), marks.height()];
            let message = ContentMessage::Errors(size_px, Box::new(comparison));
            (message, marks.into_raw())
        }
        Content::Failed(why) => (ContentMessage::Failed(why), Vec::new()),
    }
}

fn content_from(content: ContentMessage, bytes: Vec<u8>) -> Option<Content> {
    Some(match content {
        ContentMessage::Layers(size_px) => Content::Layers(Layers {
            size_px,
            pixels: layers_from_words(&pod_collect_to_vec::<u8, u32>(&bytes)),
        }),
        ContentMessage::Errors([width, height], comparison) => Content::Errors {
            marks: RgbaImage::from_raw(width, height, bytes)?,
            comparison: *comparison,
        },
        ContentMessage::Failed(why) => Content::Failed(why),
    })
}

fn magnified_message(magnified: Magnified, bytes: &mut Vec<u8>) -> MagnifiedMessage {
    let neighbourhood = |shown: Neighbourhood| {
        let refused = match shown.picture {
            Ok(picture) => {
                bytes.extend(picture.into_raw());
                None
            }
            Err(why) => Some(why),
        };
        NeighbourhoodMessage {
            is_b: shown.side.map(|side| side == SlotSide::B),
            name: shown.name,
            says: shown.says,
            refused,
        }
    };
    MagnifiedMessage {
        at_px: magnified.at_px,
        neighbourhoods: (magnified.neighbourhoods.into_iter())
            .map(neighbourhood)
            .collect(),
        depths: magnified.depths,
        is_undecided: magnified.is_undecided,
    }
}

fn magnified_from(message: MagnifiedMessage, bytes: &[u8]) -> Magnified {
    let mut pictures = bytes.chunks_exact(NEIGHBOURHOOD_BYTES);
    let neighbourhood = |shown: NeighbourhoodMessage| Neighbourhood {
        side: shown.is_b.map(side),
        name: shown.name,
        says: shown.says,
        picture: match shown.refused {
            Some(why) => Err(why),
            None => {
                let bytes = pictures.next().unwrap_or_default().to_vec();
                Ok(RgbaImage::from_raw(SIDE_PX, SIDE_PX, bytes).unwrap_or_default())
            }
        },
    };
    Magnified {
        at_px: message.at_px,
        neighbourhoods: (message.neighbourhoods.into_iter())
            .map(neighbourhood)
            .collect(),
        depths: message.depths,
        is_undecided: message.is_undecided,
    }
}
