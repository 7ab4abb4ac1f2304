//! Breakaways of a scene, opened towards an eye.
//!
//! Cost: one hull per opening, whenever the eye moves; the hulls of the interior parts are kept until one of them changes. The rest
//! of the scene is not touched.

use glam::DVec3;

use super::{Breakaway, BreakawayView};
use crate::error::{Error, Result};
use crate::scene::{Camera, Cut, Outline, Role, Scene, View};

impl Scene {
    /// Opens breakaways ([`Cut::breakaway`]) towards the scene camera's eye, for a picture of the given size: each gets its cutter, and
    /// one with several openings becomes several cuts. Call it again when the camera or an interior part has moved; breakaways that
    /// open only towards the first camera position ([`BreakawayView::First`]) then stay unchanged.
    ///
    /// # Errors
    ///
    /// If there is a breakaway but no interior part; the scene then stays unchanged.
    pub fn open_breakaways(&mut self, size_px: [u32; 2]) -> Result<()> {
        if !self.has_breakaways() {
            return Ok(());
        }
        let view = self.view_through(&self.camera, size_px);
        self.open_breakaways_to(|cut, breakaway| {
            let stays = breakaway.view == BreakawayView::First && cut.volume.is_some();
            (!stays).then_some(&view)
        })
    }

    /// Returns true if any cut is a breakaway.
    #[doc(hidden)]
    pub fn has_breakaways(&self) -> bool {
        self.cuts.iter().any(|cut| cut.breakaway.is_some())
    }

    /// Opens the breakaways for which there is a view, each towards its view's eye in world space.
    #[doc(hidden)]
    pub fn open_breakaways_to<'a>(
        &mut self,
        view_for: impl Fn(&Cut, &Breakaway) -> Option<&'a View>,
    ) -> Result<()> {
        let mut cuts = Vec::with_capacity(self.cuts.len());
        for cut in &self.cuts {
            let view = cut.breakaway.as_ref().and_then(|b| view_for(cut, b));
            match (&cut.breakaway, view) {
                (Some(breakaway), Some(view)) if cut.enabled => {
                    // The cuts of further openings were created from the first.
                    if cut.opening == 0 {
                        cuts.extend(self.openings(cut, breakaway, view)?);
                    }
                }
                _ => cuts.push(cut.clone()),
            }
        }
        self.cuts = cuts;
        Ok(())
    }

    /// A breakaway as one cut per opening; if there is no opening, a single cut that removes nothing.
    fn openings(&self, cut: &Cut, breakaway: &Breakaway, view: &View) -> Result<Vec<Cut>> {
        let bounds = self.bounds();
        if !self.parts.iter().any(|p| p.role == Role::Interior) {
            let help = "mark the interior parts with role = \"interior\", [roles] or --roles; --split turns a mesh's bodies into parts";
            let what = "there is nothing to show: no part is interior";
            return Err(Error::input(
                format!("breakaway `{}`", cut.name),
                what,
                help,
            ));
        }
        let hulls = cut.kept_hulls.of(breakaway, &self.parts, &bounds);
        let names = hulls.shows.iter().map(|i| self.parts[*i].name.clone());
        let closed = Cut {
            volume: None,
            opening: 0,
            shows: names.collect(),
            ..cut.clone()
        };
        let mut openings = Vec::new();
        for hull in &hulls.extended {
            openings.extend(breakaway.cutter(hull, view, &bounds)?);
        }
        if openings.is_empty() {
            return Ok(vec![closed]);
        }
        let openings = openings
            .into_iter()
            .enumerate()
            .map(|(opening, cutter)| Cut {
                volume: Some(cutter),
                opening,
                ..closed.clone()
            });
        Ok(openings.collect())
    }

    /// The view of a camera in world space, fitted to the same geometry as the scene's camera.
    #[doc(hidden)]
    pub fn view_through(&self, camera: &Camera, size_px: [u32; 2]) -> View {
        let outline = self.fitted_outline();
        let points = outline.as_deref().map_or(&[] as &[DVec3], Outline::points);
        let fitted = (self.bounds(), points);
        camera.view_fitted(|p| p, 1.0, fitted, size_px)
    }
}
