//! An opened document: its scene is kept between calls as long as the document is unchanged.

use cutaway::scene::{Fit, Scene, View};
use cutaway::{Error, Outcome};
use cutaway_io::document::{Document, Timeline, named_style};
use cutaway_io::load::Assets;
use cutaway_lab::experiment::SceneAtTime;

use crate::door::Result;

/// Default style of pictures.
const USUAL_STYLE: &str = "technical";

/// Purpose of opening a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A picture: with the defaults of `cutaway render`.
    Picture,
    /// Measuring, slicing or dividing: without a style, and with the framing that `compare` uses.
    Measurement,
}

/// A document and its scene.
pub(crate) struct OpenedDocument {
    document: Document,
    purpose: Purpose,
    pub(crate) timeline: Timeline,
    pub(crate) scene: Scene,
    pub(crate) at: SceneAtTime,
}

impl OpenedDocument {
    /// Opens a document at the time that it sets. Data shared with the previously opened document is reused.
    pub(crate) fn of(
        mut document: Document,
        assets: &mut Assets,
        purpose: Purpose,
        last: Option<Self>,
    ) -> Result<Self> {
        if purpose == Purpose::Picture {
            document.guess_up(assets)?;
        }
        let last = match last {
            Some(last) if last.document == document && last.purpose == purpose => return Ok(last),
            last => last,
        };
        let mut timeline = document.timeline(assets)?;
        if purpose == Purpose::Picture {
            timeline = timeline
                .with_usual_style(named_style(USUAL_STYLE)?)?
                .with_usual_fit(Fit::Kept);
        }
        let scene = timeline.scene()?;
        // Hatches depend on the initial placement of parts.
        let begins = match timeline.moves() && scene.style.hatch.is_drawn() {
            true => Some(timeline.at(0.0)?),
            false => None,
        };
        let first = begins.as_ref().unwrap_or(&scene);
        let at = last.map_or_else(|| SceneAtTime::new(first), |last| last.at.anew(first));
        let at = match begins {
            Some(_) => at.updated(&scene),
            None => at,
        };
        Ok(Self {
            document,
            purpose,
            timeline,
            scene,
            at,
        })
    }
}

/// The view of a picture of the requested size; an error if its rays are not finite.
pub(crate) fn view(opened: &OpenedDocument) -> Result<View> {
    let view = (opened.at.model.prepared).view(opened.timeline.settings().size_px());
    match view.defect() {
        None => Ok(view),
        Some(what) => {
            let help = "move it nearer to the model, and give it a focal point that differs from its position";
            Err(Error::input("camera", what, help))
        }
    }
}

/// Warning about an incomplete frame.
pub(crate) fn shortfall(outcome: &Outcome) -> Option<String> {
    match outcome {
        Outcome::Complete => None,
        _ => outcome
            .reason()
            .map(|reason| format!("the frame is incomplete: {reason}")),
    }
}
