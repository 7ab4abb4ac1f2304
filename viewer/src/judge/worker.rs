//! What the judge works with: a session on a device of its own, and the reference that was last evaluated.

use std::sync::Arc;

use cutaway::exact::evaluate;
use cutaway::experiment::SceneAtTime;
use cutaway::{Exact, Gpu, GpuOptions, Result, Session};
use image::RgbaImage;

use super::Subject;

/// A session, and what is kept from question to question.
pub(super) struct Worker {
    adapter: String,
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

impl Worker {
    /// One that opens the adapter of a name when it first needs it.
    pub(super) fn new(adapter: String) -> Self {
        Self {
            adapter,
            session: None,
            reference: None,
        }
    }

    /// The session.
    pub(super) fn session(&mut self) -> Result<&mut Session> {
        match &mut self.session {
            Some(session) => Ok(session),
            none => Ok(none.insert(Session::new(Gpu::open(&GpuOptions {
                adapter: Some(self.adapter.clone()),
                prefer_software: false,
            })?))),
        }
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
    pub(super) fn exact_picture(&mut self, subject: &Subject) -> Result<Arc<RgbaImage>> {
        let exact = self.exact(subject)?;
        let kept = self.reference.as_ref().and_then(|r| r.picture.as_ref());
        if let Some((_, picture)) = kept.filter(|(at, _)| Arc::ptr_eq(at, &subject.at)) {
            return Ok(picture.clone());
        }
        let view = subject.view();
        let shaded = (self.session()?).shade(&subject.at.model, &view, &exact.layers)?;
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
