//! State of the judge: a session on its own device, and the exact references of the present scene.
//!
//! If the device is lost, another one is opened on the same adapter, and the interrupted work is repeated.

use std::sync::Arc;

use cutaway::gpu::wgpu;
use cutaway::{Error, Gpu, GpuOptions, Result, Session};
use cutaway_lab::Exact;
use cutaway_lab::exact::evaluate;
use cutaway_lab::experiment::SceneAtTime;
use image::RgbaImage;

use super::Subject;
use super::errors::DIVISORS;
use crate::picture::device::DeviceLoss;

/// Number of references kept: one for each resolution at which errors are computed.
const MOST_REFERENCES: usize = DIVISORS.len();

/// A session, and the references kept between questions.
pub(super) struct JudgeContext {
    adapter: Option<String>,
    session: Option<(Session, DeviceLoss)>,
    /// References for one scene and viewpoint; the most recently requested one is the last.
    references: Vec<PictureReference>,
}

/// The reference of a picture.
struct PictureReference {
    subject: Subject,
    exact: Arc<Exact>,
    /// The reference's shaded picture, and the scene that it shows.
    picture: Option<(Arc<SceneAtTime>, Arc<RgbaImage>)>,
}

impl JudgeContext {
    /// Creates a context that opens the named adapter, or the default one, on first use.
    pub(super) fn new(adapter: Option<String>) -> Self {
        Self {
            adapter,
            session: None,
            references: Vec::new(),
        }
    }

    /// Releases the device and all references.
    pub(super) fn clear(&mut self) {
        (self.session, self.references) = (None, Vec::new());
    }

    /// The session.
    pub(super) async fn session(&mut self) -> Result<&mut Session> {
        if self.session.is_none() {
            let options = GpuOptions {
                adapter: self.adapter.clone(),
                prefer_software: false,
            };
            let gpu = Gpu::open_async(&options).await?;
            let loss = DeviceLoss::watch(gpu.device(), || {});
            self.session = Some((Session::new(gpu), loss));
        }
        let none = || Error::Plan("there is no session".to_owned());
        let (session, _) = self.session.as_mut().ok_or_else(none)?;
        Ok(session)
    }

    /// Runs `work`, and runs it again on another device if the session's device is lost.
    pub(super) async fn retried<T>(&mut self, mut work: impl AsyncFnMut(&mut Self) -> T) -> T {
        let done = work(self).await;
        if !self.has_lost_device() {
            return done;
        }
        self.session = None;
        work(self).await
    }

    fn has_lost_device(&self) -> bool {
        self.session.as_ref().is_some_and(|(session, loss)| {
            // The device reports a loss when it is polled.
            let _ = session.gpu().device().poll(wgpu::PollType::Poll);
            loss.reason().is_some()
        })
    }

    /// The reference of a picture.
    pub(super) fn exact(&mut self, subject: &Subject) -> Result<Arc<Exact>> {
        let is_of = |r: &PictureReference| r.subject.has_the_rays_of(subject);
        let reference = match self.references.iter().position(is_of) {
            Some(index) => self.references.remove(index),
            None => PictureReference {
                subject: subject.clone(),
                exact: Arc::new(evaluate(subject.at.truth()?, &subject.view())),
                picture: None,
            },
        };
        let exact = reference.exact.clone();
        (self.references).retain(|r| r.subject.revision == subject.revision);
        if self.references.len() == MOST_REFERENCES {
            self.references.remove(0);
        }
        self.references.push(reference);
        Ok(exact)
    }

    /// Shaded picture of the reference.
    pub(super) async fn exact_picture(&mut self, subject: &Subject) -> Result<Arc<RgbaImage>> {
        let exact = self.exact(subject)?;
        // `exact` has put the requested reference last.
        let kept = (self.references.last()).and_then(|r| r.picture.as_ref());
        if let Some((_, picture)) = kept.filter(|(at, _)| Arc::ptr_eq(at, &subject.at)) {
            return Ok(picture.clone());
        }
        let view = subject.view();
        let session = self.session().await?;
        let shaded = session.shade_async(&subject.at.model, &view, &exact.layers);
        let shaded = shaded.await?;
        let picture = Arc::new(picture(view.size_px, shaded));
        if let Some(reference) = self.references.last_mut() {
            reference.picture = Some((subject.at.clone(), picture.clone()));
        }
        Ok(picture)
    }
}

/// Pixels as an image.
pub(super) fn picture([width, height]: [u32; 2], rgba: Vec<u8>) -> RgbaImage {
    RgbaImage::from_raw(width, height, rgba).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::camera::CameraMove;
    use crate::picture::slot::{Painter, SlotLayout, SlotSide};
    use crate::{Action, State};
    use cutaway_io::Document;
    use cutaway_io::document::part;
    use cutaway_io::load::Assets;
    use cutaway_lab::experiment::Renderer;
    use glam::DVec2;

    #[test]
    fn only_another_scene_or_eye_has_another_reference() {
        let mut document = Document::new();
        document.add_part(part("shape:cube")).expect("a part");
        let mut state = State::open(document, Assets::default()).expect("a scene");
        let mut context = JudgeContext::new(None);
        let mut kept: Vec<Arc<Exact>> = Vec::new();
        let mut evaluations = |state: &State| -> usize {
            for divisor in DIVISORS {
                let subject = Subject::of(state, [64 / divisor, 48 / divisor]);
                let subject = subject.expect("a picture");
                let exact = context.exact(&subject).expect("a reference");
                if !kept.iter().any(|held| Arc::ptr_eq(held, &exact)) {
                    kept.push(exact);
                }
            }
            kept.len()
        };
        assert_eq!(evaluations(&state), 3, "one for each resolution");
        let of_slots = [
            Action::Choose(SlotSide::B, Painter::Named(Renderer::EXACT)),
            Action::Swap,
            Action::Arrange(SlotLayout::Wipe),
        ];
        for action in of_slots {
            let before = state.revision();
            state.apply(action);
            assert_ne!(state.revision(), before, "it is drawn anew");
            assert_eq!(evaluations(&state), 3);
        }
        state.apply(Action::MoveCamera(CameraMove::Orbit(DVec2::new(20.0, 0.0))));
        assert_eq!(evaluations(&state), 6, "from elsewhere all of them");
    }
}
