//! `--camera-...` and `--up`: the viewpoint.

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use cutaway::Result;
use cutaway::scene::Up;
use cutaway_io::document::{Document, Value};

use super::args::say;
use super::declared::declared;

/// Camera options.
#[derive(Args, Clone)]
pub(crate) struct CameraArgs {
    /// Position of the eye
    #[arg(
        long = "camera-position",
        value_name = "X,Y,Z",
        value_parser = declared("camera.position"),
        allow_hyphen_values = true,
        conflicts_with_all = ["azimuth_deg", "elevation_deg"],
        help_heading = "Camera"
    )]
    position: Option<Value>,
    /// Point that the eye looks at [default: the middle of the model]
    #[arg(
        long = "camera-focal-point",
        value_name = "X,Y,Z",
        value_parser = declared("camera.focal_point"),
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    focal_point: Option<Value>,
    /// Direction that is up in the picture
    #[arg(
        long = "camera-view-up",
        value_name = "X,Y,Z",
        value_parser = declared("camera.view_up"),
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    view_up: Option<Value>,
    /// View direction: cut looks straight at the first section, iso at equal angles to all three axes
    #[arg(
        long,
        value_name = "NAME",
        value_parser = declared("camera.view"),
        conflicts_with_all = ["position", "azimuth_deg", "elevation_deg"],
        help_heading = "Camera"
    )]
    view: Option<Value>,
    /// Azimuth around the up axis, in degrees [default: the scene's, or 35, mirrored if the cut would otherwise be hidden]
    #[arg(
        long = "camera-azimuth-angle",
        value_name = "DEG",
        value_parser = declared("camera.azimuth_deg"),
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    azimuth_deg: Option<Value>,
    /// Elevation above the horizon, in degrees [default: the scene's, or 25, from below if the cut would otherwise be hidden]
    #[arg(
        long = "camera-elevation-angle",
        value_name = "DEG",
        value_parser = declared("camera.elevation_deg"),
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    elevation_deg: Option<Value>,
    /// Parallel rays, without perspective
    #[arg(long = "camera-orthographic", help_heading = "Camera")]
    orthographic: bool,
    /// Extent fitted into the view: kept, the silhouette of the kept solid, or all, the model's bounding box [default: the scene's;
    /// kept for pictures, all where strategies are compared]
    #[arg(
        long = "camera-fit",
        value_name = "WHAT",
        value_parser = declared("camera.fit"),
        help_heading = "Camera"
    )]
    fit: Option<Value>,
    /// Magnification relative to the fitted view [default: the scene's, or 1]
    #[arg(
        long = "camera-zoom-factor",
        value_name = "FACTOR",
        value_parser = declared("camera.zoom"),
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    zoom: Option<Value>,
    /// Moves the model right and up in the picture, in picture heights: 0.1,-0.05 [default: the scene's, or 0,0]
    #[arg(
        long = "camera-pan",
        value_name = "X,Y",
        value_parser = declared("camera.pan"),
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    pan: Option<Value>,
    /// Up axis of the model [default: the scene's, or +Y; in pictures, +Z if all models are .3mf; .stl, .ply: guessed and reported]
    #[arg(
        long,
        value_name = "AXIS",
        value_parser = up_axis(),
        allow_hyphen_values = true,
        ignore_case = true,
        help_heading = "Camera"
    )]
    up: Option<Value>,
}

impl CameraArgs {
    /// Writes the options into a document and removes contradicting values; missing angles are chosen automatically.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let is_new = document.root().get("camera").is_none();
        let is_orbit = self.azimuth_deg.is_some() || self.elevation_deg.is_some();
        let all = [
            "position",
            "azimuth_deg",
            "elevation_deg",
            "focal_point",
            "view_up",
            "view",
        ];
        let contradicted = match (&self.view, &self.position, is_orbit) {
            (Some(_), _, _) => &all[..5],
            (_, Some(_), _) => &all[1..],
            (_, _, true) => &["position", "focal_point", "view_up", "view"],
            (None, None, false) => &[],
        };
        for key in contradicted {
            document.remove(&format!("camera.{key}"))?;
        }
        if self.orthographic {
            document.remove("camera.fov_y_deg")?;
        }
        let projection = self.orthographic.then(|| "orthographic".into());
        for (key, option, value) in [
            ("view", "--view", &self.view),
            ("position", "--camera-position", &self.position),
            ("focal_point", "--camera-focal-point", &self.focal_point),
            ("view_up", "--camera-view-up", &self.view_up),
            ("azimuth_deg", "--camera-azimuth-angle", &self.azimuth_deg),
            (
                "elevation_deg",
                "--camera-elevation-angle",
                &self.elevation_deg,
            ),
            ("projection", "--camera-orthographic", &projection),
            ("zoom", "--camera-zoom-factor", &self.zoom),
            ("fit", "--camera-fit", &self.fit),
            ("pan", "--camera-pan", &self.pan),
            ("up", "--up", &self.up),
        ] {
            say(document, &format!("camera.{key}"), option, value.clone())?;
        }
        if is_new {
            document.find_angles()?;
        }
        Ok(())
    }
}

/// Axes by their document names; the plus sign may be omitted.
fn up_axis() -> impl TypedValueParser<Value = Value> {
    let axes = Up::ALL.map(|(name, _)| PossibleValue::new(name).alias(&name[1..]));
    PossibleValuesParser::new(axes).map(|name| {
        let name = name.trim_start_matches('+').to_uppercase();
        Value::from(format!("+{name}"))
    })
}
