//! Cutaways of a timeline: where cutouts lie, breakaways that open to the eye of a moment, and who says which role a part has.

use std::collections::BTreeMap;

use super::Timeline;
use super::read::{self, RoleBy};
use crate::error::{Error, Result};
use crate::scene::numbers::round;
use crate::scene::{AxisRule, BreakawayView, Camera, Cut, CutoutFrame, Fit, Part, Scene};

impl Timeline {
    /// A scene with its breakaways open, those that stay as they are towards the eye of the first moment.
    pub(super) fn opened(&self, mut scene: Scene) -> Result<Scene> {
        if !scene.has_breakaways() {
            return Ok(scene);
        }
        let stays = |cut: &Cut| {
            cut.breakaway
                .is_some_and(|b| b.view == BreakawayView::First)
        };
        let size_px = self.settings.size_px();
        if scene.cuts.iter().any(stays) && self.moves() {
            let (first, cuts) = (
                self.rest.view_through(&self.rest.camera, size_px),
                scene.cuts.clone(),
            );
            scene.open_breakaways_to(&first)?;
            let others = cuts.into_iter().filter(|cut| !stays(cut));
            scene.cuts = (scene.cuts.into_iter().filter(stays))
                .chain(others)
                .collect();
        }
        scene.open_breakaways(size_px)?;
        Ok(scene)
    }

    /// Who says which role each part has, in the order of the parts.
    ///
    /// # Errors
    ///
    /// None that opening the document had not.
    pub fn roles(&self) -> Result<Vec<(Part, RoleBy)>> {
        self.read_at(0.0, |root| {
            read::parts_with_roles(root, &self.stock, 0.0, &self.outwards)
        })
    }
}

/// What is to be said of where cutouts lie.
pub(super) fn notes_of(frames: &BTreeMap<usize, CutoutFrame>) -> impl Iterator<Item = String> {
    let even = frames.iter().filter(|(_, frame)| frame.is_even);
    even.map(|(number, frame)| {
        let axis = frame.along.to_array().map(round);
        let axis = axis.join(", ");
        format!(
            "cut.{number}.cutout: no axis of the model stands out, so it goes around [{axis}], the one nearest to the upright; `axis` names another"
        )
    })
}

/// Where cutouts lie, by the number of their cut, in a scene that is seen from its camera.
pub(super) fn frames_of(
    scene: &Scene,
    cutouts: Vec<(usize, AxisRule)>,
    size_px: [u32; 2],
) -> Result<BTreeMap<usize, CutoutFrame>> {
    // What is kept is not known before they lie there.
    let camera = Camera {
        fit: Fit::All,
        ..scene.camera
    };
    let view = camera.view(|p| p, 1.0, scene.bounds(), size_px);
    let frame = |(number, rule)| {
        let frame = CutoutFrame::of(scene.parts.iter(), rule, &view, camera.up.axis());
        let help = "use parts with an inside, of which one at least has the role exterior";
        let what = "there is nothing to cut out of: no exterior part, or a flat one";
        let missing = || Error::input(format!("cut.{number}.cutout"), what, help);
        Ok((number, frame.ok_or_else(missing)?))
    };
    cutouts.into_iter().map(frame).collect()
}
