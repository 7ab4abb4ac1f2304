//! `[camera]`.

use cutaway::scene::describe::{Described, OrWord, joined, words};
use cutaway::scene::range::SMALLEST;
use cutaway::scene::{Fit, STANDARD_VIEWS, Up};
use glam::{DVec2, DVec3};

/// Words that `view` accepts: the standard views, and `cut`, which faces the first section.
const VIEWS: [&str; STANDARD_VIEWS.len() + 1] = joined(&words(&STANDARD_VIEWS), &["cut"]);

/// Projection by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described)]
pub(crate) enum ProjectionKind {
    #[default]
    Perspective,
    Orthographic,
}

/// The camera as stored in a file.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct CameraDesc {
    /// Rotation around the up axis, or "auto" to face the cuts.
    #[value(words = ["auto"], unit = "degrees", example = 35)]
    pub(crate) azimuth_deg: Option<OrWord<f64>>,
    /// Angle above the horizon, or "auto" to face the cuts.
    #[value(words = ["auto"], unit = "degrees", example = 25)]
    pub(crate) elevation_deg: Option<OrWord<f64>>,
    /// Named viewing direction, used instead of angles; `cut` faces the first section.
    #[value(choice = VIEWS, example = "iso")]
    pub(crate) view: Option<String>,
    /// Position of the eye, used instead of angles.
    #[value(unit = "units", example = [0, 0, 5])]
    pub(crate) position: Option<DVec3>,
    /// Point in the middle of the picture, by default the middle of the model.
    #[value(unit = "units", example = [0, 0, 0])]
    pub(crate) focal_point: Option<DVec3>,
    /// Direction that points up in the picture.
    #[value(example = [0, 1, 0])]
    pub(crate) view_up: Option<DVec3>,
    /// Up axis of the world.
    #[value(example = "+Z")]
    pub(crate) up: Up,
    /// Perspective or orthographic.
    #[value(example = "orthographic")]
    pub(crate) projection: ProjectionKind,
    /// Vertical field of view of a perspective camera.
    #[value(range = SMALLEST..=170.0, unit = "degrees", example = 30)]
    pub(crate) fov_y_deg: Option<f64>,
    /// Height of an orthographic picture, by default fitted to the model.
    #[value(range = SMALLEST.., unit = "units", example = 3)]
    pub(crate) height: Option<f64>,
    /// What an orbit frames: the silhouette of the geometry that the cuts keep, or the box of the whole model.
    #[value(example = "kept")]
    pub(crate) fit: Option<Fit>,
    /// Magnification relative to the fitted view.
    #[value(range = 1e-3..=1e3, example = 1.5)]
    pub(crate) zoom: Option<f64>,
    /// Offset by which the model moves right and up in the picture.
    #[value(range = -10.0..=10.0, unit = "heights", example = [0.1, 0])]
    pub(crate) pan: DVec2,
    /// Distance of the near plane.
    #[value(range = SMALLEST.., unit = "units", example = 0.5)]
    pub(crate) near: Option<f64>,
    /// Draws a cap where the near plane cuts a solid.
    #[value(example = false)]
    pub(crate) near_cap: Option<bool>,
}
