//! Cutaways of a timeline: the positions of cutouts, breakaways that open to the current camera, and the source of each part's role.

use std::collections::BTreeMap;
use std::sync::{OnceLock, PoisonError};

use cutaway::error::{Diagnostic, Error, Result};
use cutaway::scene::numbers::round;
use cutaway::scene::{
    AxisRule, Breakaway, BreakawayView, Camera, CutoutFrame, Fit, Part, Scene, View,
};

use super::Timeline;
use super::read::{self, RoleBy};

impl Timeline {
    /// Opens the scene's breakaways to the current camera, or to the camera at time 0 for those with a fixed view.
    pub(super) fn opened(&self, mut scene: Scene) -> Result<Scene> {
        if !scene.has_breakaways() {
            return Ok(scene);
        }
        let size_px = self.settings.size_px();
        if scene.camera.fits_kept() && scene.outline.is_none() {
            // Cached, because preparing the scene needs it again.
            scene.outline = scene.fitted_outline();
        }
        let each = scene.view_through(&scene.camera, size_px);
        let stays = |b: &Breakaway| b.view == BreakawayView::First;
        let mut breakaways = scene.cuts.iter().filter_map(|c| c.breakaway.as_ref());
        let first = match breakaways.any(stays) {
            true => self.first_view()?,
            false => each,
        };
        scene.open_breakaways_to(|_, b| Some(if stays(b) { &first } else { &each }))?;
        Ok(scene)
    }

    /// The view at time 0, in world space.
    fn first_view(&self) -> Result<View> {
        if let Some(view) = self.first_view.get() {
            return Ok(*view);
        }
        let first = self.closed_at(0.0)?;
        let view = first.view_through(&first.camera, self.settings.size_px());
        Ok(*self.first_view.get_or_init(|| view))
    }

    /// Places the cutouts of these cuts for the scene at time 0.
    pub(super) fn place_cutouts(&mut self, cutouts: Vec<(usize, AxisRule)>) -> Result<()> {
        let first = self.closed_at(0.0)?;
        self.scene_assets.frames = frames_of(&first, cutouts, self.settings.size_px())?;
        self.notes.extend(notes_of(&self.scene_assets.frames));
        // Results computed without the cutouts are discarded. The camera is kept, because the cutouts open towards it.
        self.outline = OnceLock::new();
        let parts = (self.rest.parts.clone(), None);
        let reliefs = self
            .reliefs
            .get_mut()
            .unwrap_or_else(PoisonError::into_inner);
        let root = read::root(&self.path, &self.root, None)?;
        let (rest, _) = read::scene(&root, &self.scene_assets, parts, reliefs, &mut Vec::new())?;
        self.rest.cuts = rest.cuts;
        Ok(())
    }

    /// Returns the parts in their order, each with the source of its role.
    ///
    /// # Errors
    ///
    /// The errors of opening the document, and no others.
    pub fn roles(&self) -> Result<Vec<(Part, RoleBy)>> {
        self.read_at(0.0, |root| {
            read::parts_with_roles(root, &self.scene_assets, 0.0, &self.outwards)
        })
    }
}

/// Notes about the positions of cutouts.
fn notes_of(frames: &BTreeMap<usize, CutoutFrame>) -> impl Iterator<Item = Diagnostic> {
    let even = frames.iter().filter(|(_, frame)| frame.is_even);
    even.map(|(number, frame)| {
        let axis = frame.along.to_array().map(round);
        let axis = axis.join(", ");
        let text = format!(
            "no axis of the model stands out, so the cutout turns around the upright axis [{axis}]; set `axis` to choose another"
        );
        Diagnostic::note("cutout-axis", text).about(format!("cut.{number}.cutout"))
    })
}

/// Computes the frames of cutouts, by the index of their cut, for the scene's camera.
fn frames_of(
    scene: &Scene,
    cutouts: Vec<(usize, AxisRule)>,
    size_px: [u32; 2],
) -> Result<BTreeMap<usize, CutoutFrame>> {
    // The geometry that the cuts keep is unknown before the cutouts are placed.
    let camera = Camera {
        fit: Fit::All,
        ..scene.camera
    };
    let view = camera.view(|p| p, 1.0, scene.bounds(), size_px);
    let frame = |(number, rule)| {
        let frame = CutoutFrame::of(scene.parts.iter(), rule, &view, camera.up.axis());
        let help = "use solid parts, at least one of them with the role exterior";
        let what = "there is nothing to cut: there is no exterior part, or it is flat";
        let missing = || Error::input(format!("cut.{number}.cutout"), what, help);
        Ok((number, frame.ok_or_else(missing)?))
    };
    cutouts.into_iter().map(frame).collect()
}
