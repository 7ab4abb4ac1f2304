//! Breakaways of a scene, opened towards an eye.
//!
//! Cost: the hull of what is inside and one for each opening, whenever the eye moves; nothing else of the scene is looked at.

use glam::DVec3;

use super::{Breakaway, BreakawayView};
use crate::error::{Error, Result};
use crate::scene::{Camera, Cut, Role, Scene, View};

impl Scene {
    /// Opens breakaways ([`Cut::breakaway`]) towards the eye of the scene's camera in a picture of a size: they get their cutters, those with
    /// several openings as cuts beside each other. To be done again when the camera or what is inside has moved.
    ///
    /// # Errors
    ///
    /// A breakaway of a scene in which no part is interior.
    pub fn open_breakaways(&mut self, size_px: [u32; 2]) -> Result<()> {
        if !self.has_breakaways() {
            return Ok(());
        }
        // What is kept does not hang on breakaways, and is asked for once more when the scene is prepared.
        if self.camera.fits_kept() && self.outline.is_none() {
            self.outline = self.fitted_outline();
        }
        let view = self.view_through(&self.camera, size_px);
        self.open_breakaways_to(&view)
    }

    /// Whether any cut is a breakaway.
    pub(crate) fn has_breakaways(&self) -> bool {
        self.cuts.iter().any(|cut| cut.breakaway.is_some())
    }

    /// Opens breakaways towards the eye of a view in world space; those that open to the first eye alone, if they have not.
    pub(crate) fn open_breakaways_to(&mut self, view: &View) -> Result<()> {
        let bounds = self.bounds();
        let mut cuts = Vec::with_capacity(self.cuts.len());
        for cut in std::mem::take(&mut self.cuts) {
            let stays = |b: &Breakaway| b.view == BreakawayView::First && cut.volume.is_some();
            let Some(breakaway) = cut.breakaway.filter(|b| !stays(b)) else {
                cuts.push(cut);
                continue;
            };
            if cut.opening > 0 {
                continue;
            }
            let interiors = self.parts.iter().filter(|p| p.role == Role::Interior);
            let solids: Vec<Vec<DVec3>> =
                interiors.map(|p| p.points_in_world().collect()).collect();
            if solids.is_empty() {
                let help = "say which parts are, by role = \"interior\", [roles] or --roles; --split makes parts of the bodies of a mesh";
                let what = "there is nothing to show: no part is interior";
                return Err(Error::input(
                    format!("breakaway `{}`", cut.name),
                    what,
                    help,
                ));
            }
            let closed = Cut {
                volume: None,
                ..cut
            };
            let mut openings = Vec::new();
            for hull in breakaway.hulls(solids, &bounds) {
                openings.extend(breakaway.cutter(&hull, view, &bounds)?);
            }
            if openings.is_empty() {
                cuts.push(closed);
                continue;
            }
            cuts.extend(
                openings
                    .into_iter()
                    .enumerate()
                    .map(|(opening, cutter)| Cut {
                        volume: Some(cutter),
                        opening,
                        ..closed.clone()
                    }),
            );
        }
        self.cuts = cuts;
        Ok(())
    }

    /// The view of a camera in world space, fitted to what that of the scene is.
    pub(crate) fn view_through(&self, camera: &Camera, size_px: [u32; 2]) -> View {
        let outline = self.fitted_outline();
        let fitted = (self.bounds(), outline.as_deref());
        camera.view_fitted(|p| p, 1.0, fitted, size_px)
    }
}
