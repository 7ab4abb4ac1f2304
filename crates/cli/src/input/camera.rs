//! `--camera-...` and `--up`: where a scene is seen from.

use clap::{Args, ValueEnum};
use cutaway::Result;
use cutaway_io::document::{Document, Value};

use super::args::{parse_finite, say};

/// Camera options.
#[derive(Args, Clone)]
pub(crate) struct CameraArgs {
    /// Position of the eye
    #[arg(
        long = "camera-position",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        conflicts_with_all = ["azimuth_deg", "elevation_deg"],
        help_heading = "Camera"
    )]
    position: Option<[f64; 3]>,
    /// Point that the eye looks at [default: the middle of the model]
    #[arg(
        long = "camera-focal-point",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    focal_point: Option<[f64; 3]>,
    /// Direction that is up in the picture
    #[arg(
        long = "camera-view-up",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    view_up: Option<[f64; 3]>,
    /// View direction: cut looks straight at the first section, iso along all three axes alike
    #[arg(
        long,
        value_name = "NAME",
        value_enum,
        conflicts_with_all = ["position", "azimuth_deg", "elevation_deg"],
        help_heading = "Camera"
    )]
    view: Option<Direction>,
    /// Turn around the up axis, in degrees [default: that of the scene, or 35, mirrored to where the cut is seen]
    #[arg(
        long = "camera-azimuth-angle",
        value_name = "DEG",
        value_parser = parse_finite,
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    azimuth_deg: Option<f64>,
    /// Height above the horizon, in degrees [default: that of the scene, or 25, from below if only so the cut is seen]
    #[arg(
        long = "camera-elevation-angle",
        value_name = "DEG",
        value_parser = parse_finite,
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    elevation_deg: Option<f64>,
    /// Parallel rays, without perspective
    #[arg(long = "camera-orthographic", help_heading = "Camera")]
    orthographic: bool,
    /// Fit of the view: kept, the silhouette of what the cuts keep, or all, the box of the model [default: that of the scene;
    /// kept for pictures, all where strategies are compared]
    #[arg(
        long = "camera-fit",
        value_name = "WHAT",
        value_enum,
        help_heading = "Camera"
    )]
    fit: Option<FitTo>,
    /// Magnification of the model over the fitted view [default: that of the scene, or 1]
    #[arg(
        long = "camera-zoom-factor",
        value_name = "FACTOR",
        value_parser = parse_zoom,
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    zoom: Option<f64>,
    /// Moves the model right and up in the picture, in picture heights: 0.1,-0.05 [default: that of the scene, or 0,0]
    #[arg(
        long = "camera-pan",
        value_name = "X,Y",
        value_parser = parse_pan,
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    pan: Option<[f64; 2]>,
    /// Up axis of the model [default: that of the scene, or +Y; +Z in pictures of .3mf alone; of .stl and .ply a guess, which is reported]
    #[arg(
        long,
        value_name = "AXIS",
        value_enum,
        allow_hyphen_values = true,
        ignore_case = true,
        help_heading = "Camera"
    )]
    up: Option<UpAxis>,
}

#[derive(Clone, Copy, ValueEnum)]
enum UpAxis {
    #[value(name = "+Y", alias = "Y")]
    PlusY,
    #[value(name = "+Z", alias = "Z")]
    PlusZ,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Direction {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    Iso,
    Cut,
}

#[derive(Clone, Copy, ValueEnum)]
enum FitTo {
    Kept,
    All,
}

impl Direction {
    /// As a scene file has it.
    fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Left => "left",
            Self::Right => "right",
            Self::Top => "top",
            Self::Bottom => "bottom",
            Self::Iso => "iso",
            Self::Cut => "cut",
        }
    }
}

impl CameraArgs {
    /// Puts them into a document. What contradicts them there goes; angles that are not given are found.
    pub(crate) fn amend(&self, document: &mut Document) -> Result<()> {
        let point = |p: Option<[f64; 3]>| p.map(|p| Value::from(p.to_vec()));
        let up = self.up.map(|up| match up {
            UpAxis::PlusY => "+Y".into(),
            UpAxis::PlusZ => "+Z".into(),
        });
        let fit = self.fit.map(|fit| match fit {
            FitTo::Kept => "kept".into(),
            FitTo::All => "all".into(),
        });
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
        let contradicted = match (self.view, self.position, is_orbit) {
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
        for (path, option, value) in [
            ("camera.view", "--view", self.view.map(|v| v.name().into())),
            ("camera.position", "--camera-position", point(self.position)),
            (
                "camera.focal_point",
                "--camera-focal-point",
                point(self.focal_point),
            ),
            ("camera.view_up", "--camera-view-up", point(self.view_up)),
            (
                "camera.azimuth_deg",
                "--camera-azimuth-angle",
                self.azimuth_deg.map(Value::from),
            ),
            (
                "camera.elevation_deg",
                "--camera-elevation-angle",
                self.elevation_deg.map(Value::from),
            ),
            ("camera.projection", "--camera-orthographic", projection),
            (
                "camera.zoom",
                "--camera-zoom-factor",
                self.zoom.map(Value::from),
            ),
            ("camera.fit", "--camera-fit", fit),
            (
                "camera.pan",
                "--camera-pan",
                self.pan.map(|p| Value::from(p.to_vec())),
            ),
            ("camera.up", "--up", up),
        ] {
            say(document, path, option, value)?;
        }
        if is_new {
            document.find_angles()?;
        }
        Ok(())
    }
}

fn parse_zoom(text: &str) -> Result<f64, String> {
    let zoom = parse_finite(text)?;
    if (1e-3..=1e3).contains(&zoom) {
        Ok(zoom)
    } else {
        Err("it must be from 0.001 to 1000\n  help: 2 shows the model twice as large".to_owned())
    }
}

fn parse_pan(text: &str) -> Result<[f64; 2], String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(parse_finite).collect();
    match numbers?.as_slice() {
        [x, y] => Ok([*x, *y]),
        _ => Err("it must be two numbers\n  help: write for example 0.1,-0.05".to_owned()),
    }
}

fn parse_point(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(parse_finite).collect();
    match numbers?.as_slice() {
        [x, y, z] => Ok([*x, *y, *z]),
        _ => Err("it must be three numbers\n  help: write for example 0,0,5".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_and_zooms_are_read_or_refused_with_an_example() {
        assert_eq!(parse_point("1,-2,3e1"), Ok([1.0, -2.0, 30.0]));
        for text in ["1,2", "1,2,3,4", "1,2,nan", "1,2,inf", ""] {
            assert!(parse_point(text).is_err(), "{text}");
        }
        assert_eq!(parse_pan("0.1,-2"), Ok([0.1, -2.0]));
        for text in ["1", "1,2,3", "a,b", ""] {
            assert!(parse_pan(text).is_err(), "{text}");
        }
        assert!(parse_zoom("0").is_err(), "nothing can be shown at zoom 0");
    }
}
