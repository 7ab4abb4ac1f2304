//! What the judge works with: a session on a device of its own, and the reference that was last evaluated.

use std::sync::Arc;

use cutaway::exact::evaluate;
use cutaway::experiment::SceneAtTime;
use cutaway::{Error, Exact, Gpu, GpuOptions, Result, Session};
use image::RgbaImage;

use super::Subject;

/// A session, and what is kept from question to question.
pub(super) struct Bench {
    adapter: Option<String>,
    session: Option<Session>,
    reference: Option<Reference>,
}

/// The reference of a picture at its whole resolution.
struct Reference {
    subject: Subject,
    exact: Arc<Exact>,
    /// With the scene that it is of.
    picture: Option<(Arc<SceneAtTime>, Arc<RgbaImage>)>,
}

impl Bench {
    /// One that opens the adapter of a name, or the one that there is, when it first needs it.
    pub(super) fn new(adapter: Option<String>) -> Self {
        Self {
            adapter,
            session: None,
            reference: None,
        }
    }

    /// The session.
    pub(super) async fn session(&mut self) -> Result<&mut Session> {
        if self.session.is_none() {
            let options = GpuOptions {
                adapter: self.adapter.clone(),
                prefer_software: false,
            };
            self.session = Some(Session::new(Gpu::open_async(&options).await?));
        }
        let none = || Error::Plan("there is no session".to_owned());
        self.session.as_mut().ok_or_else(none)
    }

    /// The reference of a picture.
    pub(super) fn exact(&mut self, subject: &Subject) -> Result<Arc<Exact>> {
        let is_kept = |r: &&Reference| r.subject.has_the_rays_of(subject);
        if let Some(reference) = self.reference.as_ref().filter(is_kept) {
            return Ok(reference.exact.clone());
        }
        let exact = Arc::new(evaluate(subject.at.truth()?, &subject.view()));
        self.reference = Some(Reference {
            subject: subject.clone(),
            exact: exact.clone(),
            picture: None,
        });
        Ok(exact)
    }

    /// What the reference of a picture looks like.
    pub(super) async fn exact_picture(&mut self, subject: &Subject) -> Result<Arc<RgbaImage>> {
        let exact = self.exact(subject)?;
        let kept = self.reference.as_ref().and_then(|r| r.picture.as_ref());
        if let Some((_, picture)) = kept.filter(|(at, _)| Arc::ptr_eq(at, &subject.at)) {
            return Ok(picture.clone());
        }
        let view = subject.view();
        let shaded = (self.session().await?).shade(&subject.at.model, &view, &exact.layers)?;
        let picture = Arc::new(picture(view.size_px, shaded));
        if let Some(reference) = &mut self.reference {
            reference.picture = Some((subject.at.clone(), picture.clone()));
        }
        Ok(picture)
    }
}

/// Pixels as an image.
pub(super) fn picture([width, height]: [u32; 2], rgba: Vec<u8>) -> RgbaImage {
    RgbaImage::from_raw(width, height, rgba).unwrap_or_default()
}
