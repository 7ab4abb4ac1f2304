//! All that a frame shows: parts, cuts, camera and style, as the user specifies them.
//!
//! Plain data in world space, in f64. Nothing is checked here: [`Prepared`](super::Prepared) flattens, recentres and ranks it.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Bounds, Camera, Cut, Outline, Part, Pose, Style};

/// Everything a frame shows, in world space.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Name for reports: the file's stem or the shape's name.
    pub name: String,
    /// The solids.
    pub parts: Vec<Part>,
    /// Removed regions; the scene removes their union.
    pub cuts: Vec<Cut>,
    /// Camera that views the scene.
    pub camera: Camera,
    /// The box used to frame, scale and section the scene; `None` means its parts' bounds. An animation uses one box for all
    /// its times, so that pictures do not jump.
    pub stage: Option<Bounds>,
    /// Outline of the kept geometry that a camera is fitted to; `None` means its present outline. An animation uses one for all its times.
    pub outline: Option<Arc<Outline>>,
    /// If set, caps where several solids overlap are hatched in this colour (sRGB, 0 to 1).
    pub interference: Option<glam::Vec3>,
    /// Rendering style.
    pub style: Style,
}

impl Scene {
    /// The stage if it is set, otherwise the bounds of all parts in world space.
    pub fn bounds(&self) -> Bounds {
        self.stage.unwrap_or_else(|| self.bounds_of_parts())
    }

    /// Outline that the camera is fitted to; `None` if it is fitted to the box of the scene.
    #[doc(hidden)]
    pub fn fitted_outline(&self) -> Option<Arc<Outline>> {
        let own = || self.outline.clone();
        let now = || Arc::new(Outline::of(self));
        self.camera.fits_kept().then(|| own().unwrap_or_else(now))
    }

    /// The same scene with every pose baked into its mesh in f64, on the same stage. Ranks may differ because mesh volumes
    /// do; [`Prepared::new`](crate::scene::Prepared::new) applies poses itself and keeps the ranks.
    #[must_use]
    pub fn posed(&self) -> Self {
        let mut posed = self.clone();
        posed.stage = Some(self.bounds());
        for part in &mut posed.parts {
            if let Cow::Owned(mut mesh) = part.posed_mesh() {
                mesh.vertex_paint.clone_from(&part.mesh.vertex_paint);
                part.mesh = Arc::new(mesh);
            }
            part.motion = None;
            part.driver = None;
            part.pose = Pose::default();
        }
        posed
    }

    /// Bounds of all parts in world space.
    pub fn bounds_of_parts(&self) -> Bounds {
        self.parts
            .iter()
            .map(Part::bounds_in_world)
            .fold(Bounds::EMPTY, Bounds::union)
    }
}
