//! Options that several subcommands share.

use clap::{Args, ValueEnum};
use glam::DVec3;

use super::defects::DefectArgs;
use super::look::bytes_of;
use super::sections::SectionArgs;
use super::set::SetArgs;
use crate::Result;
use crate::gpu::{Gpu, GpuOptions};
use crate::scene::range::LARGEST;
use crate::scene::{
    Bounds, Camera, Cut, Fill, HeightFilter, Projection, Up, Viewpoint, parse_color,
};
use crate::session::Session;
use crate::strategies::{FrameOptions, Rasteriser};

/// Most pixels along a side of a picture.
const LARGEST_SIDE: u32 = 16_384;

/// A cut face counts as seen if the cosine between its normal and the view is more.
const LEAST_COSINE: f64 = 0.1;

/// What is drawn, how it is cut, and where it is seen from.
#[derive(Args)]
pub(super) struct SceneArgs {
    /// Meshes (.obj, .stl, .ply, .glb, .gltf, .gz of the first three), `shape:NAME?param=value`, or one scene (.toml)
    #[arg(required = true, value_name = "SCENE|MODEL")]
    pub(super) inputs: Vec<String>,
    #[command(flatten)]
    pub(super) set: SetArgs,
    #[command(flatten)]
    pub(super) sections: SectionArgs,
    #[command(flatten)]
    pub(super) camera: CameraArgs,
    #[command(flatten)]
    pub(super) defects: DefectArgs,
    /// Which points each mesh encloses: even-odd, where an odd number of crossings lies before them, or nonzero, wherever it
    /// winds around them, which unites shells that overlap [default: that of the scene, or even-odd]
    #[arg(long, value_name = "RULE", value_parser = parse_fill)]
    pub(super) fill: Option<Fill>,
    /// Hatch the caps that several solids share, by default in #ff00aa [default: that of the scene, or not at all]
    #[arg(
        long,
        value_name = "COLOUR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "#ff00aa",
        value_parser = parse_interference,
        help_heading = "Output"
    )]
    pub(super) interference: Option<[u8; 3]>,
    /// Width and height of the picture in pixels [default: that of the scene, or 1024,768]
    #[arg(long, value_name = "W,H", value_parser = parse_resolution, allow_hyphen_values = true, help_heading = "Output")]
    pub(super) resolution: Option<[u32; 2]>,
}

/// Where a scene is seen from.
#[derive(Args, Clone)]
pub(super) struct CameraArgs {
    /// Where the eye is
    #[arg(
        long = "camera-position",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        conflicts_with_all = ["azimuth_deg", "elevation_deg"],
        help_heading = "Camera"
    )]
    position: Option<DVec3>,
    /// What the eye looks at [default: the middle of the model]
    #[arg(
        long = "camera-focal-point",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    focal_point: Option<DVec3>,
    /// Direction that is up in the picture
    #[arg(
        long = "camera-view-up",
        value_name = "X,Y,Z",
        value_parser = parse_point,
        allow_hyphen_values = true,
        requires = "position",
        help_heading = "Camera"
    )]
    view_up: Option<DVec3>,
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
    /// How much larger than the fitted view the model is shown
    #[arg(
        long = "camera-zoom-factor",
        value_name = "FACTOR",
        default_value = "1",
        value_parser = parse_zoom,
        allow_hyphen_values = true,
        help_heading = "Camera"
    )]
    pub(super) zoom: f64,
    /// Which axis of the model is up [default: that of the scene, or +Y]
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

impl CameraArgs {
    /// The usual camera, from where most of the cut's faces are seen: half of all sections would show only their backs.
    pub(super) fn usual(&self, cuts: &[Cut], bounds: &Bounds) -> Result<Camera> {
        let plain = self.apply(Camera::default(), bounds)?;
        let Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } = plain.viewpoint
        else {
            return Ok(plain);
        };
        let azimuths = match self.azimuth_deg {
            Some(given) => vec![given],
            None => [0.0, 180.0]
                .iter()
                .flat_map(|back| [azimuth_deg + back, -azimuth_deg - back])
                .collect(),
        };
        let elevations = match self.elevation_deg {
            Some(given) => vec![given],
            None => vec![elevation_deg, -elevation_deg],
        };
        let mut best = (0, plain);
        for elevation_deg in elevations {
            for azimuth_deg in &azimuths {
                let viewpoint = Viewpoint::Orbit {
                    azimuth_deg: *azimuth_deg,
                    elevation_deg,
                };
                let camera = Camera { viewpoint, ..plain };
                let forward = camera.view(|p| p, 1.0, *bounds, [1, 1]).forward;
                let enabled = cuts.iter().filter(|c| c.enabled);
                let seen = enabled
                    .flat_map(|c| &c.surfaces)
                    .filter(|s| s.frame().normal.dot(forward) > LEAST_COSINE)
                    .count();
                if seen > best.0 {
                    best = (seen, camera);
                }
            }
        }
        Ok(best.1)
    }

    /// The axis that is up: what the option says, or else that of the scene.
    pub(super) fn up_axis(&self, of_scene: Up) -> Up {
        match self.up {
            Some(UpAxis::PlusY) => Up::PlusY,
            Some(UpAxis::PlusZ) => Up::PlusZ,
            None => of_scene,
        }
    }

    /// The scene's camera with what the options say instead.
    pub(super) fn apply(&self, mut camera: Camera, bounds: &Bounds) -> Result<Camera> {
        camera.up = self.up_axis(camera.up);
        if self.orthographic && !matches!(camera.projection, Projection::Orthographic { .. }) {
            camera.projection = Projection::Orthographic { height: None };
        }
        if let Some(position) = self.position {
            camera.viewpoint = self.explicit_viewpoint(position, bounds, camera.up.axis())?;
        } else if self.azimuth_deg.is_some() || self.elevation_deg.is_some() {
            let (azimuth, elevation) = match (camera.viewpoint, Camera::default().viewpoint) {
                (
                    Viewpoint::Orbit {
                        azimuth_deg,
                        elevation_deg,
                    },
                    _,
                )
                | (
                    _,
                    Viewpoint::Orbit {
                        azimuth_deg,
                        elevation_deg,
                    },
                ) => (azimuth_deg, elevation_deg),
                _ => (0.0, 0.0),
            };
            camera.viewpoint = Viewpoint::Orbit {
                azimuth_deg: self.azimuth_deg.unwrap_or(azimuth),
                elevation_deg: self.elevation_deg.unwrap_or(elevation),
            };
        }
        Ok(camera)
    }

    fn explicit_viewpoint(&self, position: DVec3, bounds: &Bounds, up: DVec3) -> Result<Viewpoint> {
        let focal_point = self.focal_point.unwrap_or(bounds.centre());
        if focal_point == position {
            return Err(crate::Error::input(
                "--camera-position",
                "it is the point that the camera looks at",
                "move it away, or give another --camera-focal-point",
            ));
        }
        let forward = (focal_point - position).normalize_or_zero();
        if let Some(view_up) = self.view_up
            && view_up.normalize_or_zero().cross(forward).length() < 1e-9
        {
            let across = if up.cross(forward).length() < 1e-9 {
                DVec3::new(up.z, up.x, up.y)
            } else {
                up
            };
            return Err(crate::Error::input(
                "--camera-view-up",
                "it points along the viewing direction, or nowhere",
                format!(
                    "give a direction across it, for example {},{},{}",
                    across.x, across.y, across.z
                ),
            ));
        }
        Ok(Viewpoint::Explicit {
            position,
            focal_point,
            view_up: self.view_up,
        })
    }
}

/// Which device draws, and by what.
#[derive(Args)]
pub(super) struct DeviceArgs {
    #[command(flatten)]
    adapter: AdapterArgs,
    #[command(flatten)]
    pub(super) means: MeansArgs,
}

impl DeviceArgs {
    /// A session on the device.
    pub(super) fn open(&self) -> Result<Session> {
        let gpu = self.adapter.open()?;
        Ok(Session::with_options(gpu, self.means.options()))
    }
}

/// Which device draws.
#[derive(Args)]
pub(super) struct AdapterArgs {
    /// Part of the adapter's name [default: the fastest]
    #[arg(long, value_name = "NAME", help_heading = "Device")]
    pub(super) adapter: Option<String>,
}

impl AdapterArgs {
    /// The device.
    pub(super) fn open(&self) -> Result<Gpu> {
        Gpu::open(&GpuOptions {
            adapter: self.adapter.clone(),
            prefer_software: false,
        })
    }
}

/// By which means frames are drawn.
#[derive(Args)]
pub(super) struct MeansArgs {
    /// Who rasterises the mesh: hardware, or compute (mask, abuffer and kbuffer, and raycast with ldi)
    #[arg(
        long,
        value_name = "WHO",
        default_value = "hardware",
        value_parser = parse_rasteriser,
        help_heading = "Device"
    )]
    rasteriser: Rasteriser,
    /// Who interpolates the heights of reliefs: exact, from four texels, or hardware, the sampler of the GPU (grid alone, for
    /// the error that it makes) [default: that of the scene, or exact]
    #[arg(long, value_name = "WHO", value_parser = parse_height_filter, help_heading = "Device")]
    height_filter: Option<HeightFilter>,
}

impl MeansArgs {
    /// As options of frames.
    pub(super) fn options(&self) -> FrameOptions {
        FrameOptions {
            height_filter: self.height_filter,
            ..FrameOptions::by(self.rasteriser)
        }
    }
}

pub(super) fn parse_fill(text: &str) -> Result<Fill, String> {
    text.parse().map_err(|_: crate::Error| {
        "there is no such rule\n  help: say even-odd or nonzero".to_owned()
    })
}

fn parse_interference(text: &str) -> Result<[u8; 3], String> {
    let color = parse_color(text).ok_or_else(|| {
        "it is no colour\n  help: write #rrggbb, for example --interference=#ff00aa".to_owned()
    })?;
    Ok(bytes_of(color))
}

fn parse_rasteriser(text: &str) -> Result<Rasteriser, String> {
    text.parse().map_err(|_: crate::Error| {
        "there is no such rasteriser\n  help: say hardware or compute".to_owned()
    })
}

fn parse_height_filter(text: &str) -> Result<HeightFilter, String> {
    text.parse().map_err(|_: crate::Error| {
        "there is no such filter\n  help: say exact or hardware".to_owned()
    })
}

/// Reads `W,H`.
pub(super) fn parse_resolution(text: &str) -> Result<[u32; 2], String> {
    let fault = || {
        format!(
            "it must be two whole numbers from 1 to {LARGEST_SIDE}\n  help: write for example --resolution 1024,768"
        )
    };
    let (width, height) = text.split_once([',', 'x']).ok_or_else(fault)?;
    let side = |t: &str| {
        t.trim()
            .parse()
            .ok()
            .filter(|n| (1..=LARGEST_SIDE).contains(n))
    };
    match (side(width), side(height)) {
        (Some(width), Some(height)) => Ok([width, height]),
        _ => Err(fault()),
    }
}

pub(super) fn parse_finite(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    let number = number.filter(|n| n.abs() <= LARGEST);
    number.ok_or_else(|| {
        format!("it must be a finite number, {LARGEST:.0e} at most, for example 1.5")
    })
}

fn parse_zoom(text: &str) -> Result<f64, String> {
    let zoom = parse_finite(text)?;
    if (1e-3..=1e3).contains(&zoom) {
        Ok(zoom)
    } else {
        Err("it must be from 0.001 to 1000\n  help: 2 shows the model twice as large".to_owned())
    }
}

fn parse_point(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(parse_finite).collect();
    match numbers?.as_slice() {
        [x, y, z] => Ok(DVec3::new(*x, *y, *z)),
        _ => Err("it must be three numbers\n  help: write for example 0,0,5".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_points_are_read_or_refused_with_an_example() {
        assert_eq!(parse_resolution("640,480"), Ok([640, 480]));
        assert_eq!(parse_resolution("640x480"), Ok([640, 480]));
        for text in ["640", "0,480", "640,-1", "640,480,2", "99999,1", "a,b", ""] {
            assert!(parse_resolution(text).is_err(), "{text}");
        }
        assert_eq!(parse_point("1,-2,3e1"), Ok(DVec3::new(1.0, -2.0, 30.0)));
        for text in ["1,2", "1,2,3,4", "1,2,nan", "1,2,inf", ""] {
            assert!(parse_point(text).is_err(), "{text}");
        }
        assert!(parse_zoom("0").is_err(), "nothing can be shown at zoom 0");
    }
}
