//! `[camera]`.
//!
//! An angle of an orbit that is `"auto"`, and both where there is no `[camera]`, turns to where most faces of the cuts are seen:
//! half of all sections would show only their backs. `view` is a direction by its name.

use cutaway::error::Result;
use cutaway::scene::{
    Bounds, Camera, ClipSurface, Cut, Fit, Projection, STANDARD_VIEWS, Up, Viewpoint,
};
use glam::{DVec2, DVec3};

use super::reader::{Entry, Table};
use crate::document::Keys;
use crate::document::Value;

static KEYS: Keys = Keys::below("camera");

/// A camera, and which of its angles are to be found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) camera: Camera,
    /// Azimuth and elevation.
    pub(crate) free: [bool; 2],
    /// It looks straight at the first section, which is known when the cuts are.
    pub(super) faces_cut: bool,
}

/// Values of `view`, with azimuth and elevation; those of `cut` are not known yet.
fn named_views() -> Vec<(&'static str, Option<[f64; 2]>)> {
    let standard = STANDARD_VIEWS.map(|(name, angles)| (name, Some(angles)));
    standard.into_iter().chain([("cut", None)]).collect()
}

impl Seen {
    /// Default of a document without camera settings.
    pub(super) fn usual(fit: Fit) -> Self {
        Self {
            camera: Camera {
                fit,
                ..Camera::default()
            },
            free: [true; 2],
            faces_cut: false,
        }
    }

    /// Returns true if an angle is automatic.
    pub(crate) fn is_free(&self) -> bool {
        self.free.contains(&true)
    }

    /// The angles from which most faces are seen of the cuts that a scene has at some times; of equals those nearest to the usual.
    pub(crate) fn turned<'a>(&self, cuts: impl Iterator<Item = &'a Cut> + Clone) -> Viewpoint {
        self.camera.viewpoint_facing(cuts, self.free)
    }
}

/// Reads a camera; without a focal point it looks at the middle of the bounds.
pub(super) fn read(entry: &Entry<'_>, bounds: &Bounds, usual_fit: Fit) -> Result<Seen> {
    let table = entry.table(KEYS.all())?;
    let mut camera = Camera {
        fit: usual_fit,
        ..Camera::default()
    };
    if let Some(fit) = table.get("fit") {
        camera.fit = fit.choice(&[("kept", Fit::Kept), ("all", Fit::All)])?;
    }
    if let Some(up) = table.get("up") {
        camera.up = up.choice(&[("+Y", Up::PlusY), ("+Z", Up::PlusZ)])?;
    }
    let has_view = table.get("view").is_some();
    let free = ["azimuth_deg", "elevation_deg"].map(|key| !has_view && is_free(&table, key));
    let view = table
        .get("view")
        .map(|v| v.choice(&named_views()))
        .transpose()?;
    camera.viewpoint = match view {
        None => viewpoint(&table, (camera.viewpoint, camera.up), bounds.centre())?,
        Some(view) => {
            says_nothing_else(&table)?;
            match view {
                Some([azimuth_deg, elevation_deg]) => Viewpoint::Orbit {
                    azimuth_deg,
                    elevation_deg,
                },
                None => camera.viewpoint,
            }
        }
    };
    camera.projection = projection(&table)?;
    camera.near = table.get("near").map(|n| n.positive()).transpose()?;
    if let Some(cap) = table.get("near_cap") {
        camera.near_cap = cap.flag()?;
    }
    if let Some(zoom) = table.get("zoom") {
        camera.zoom = zoom.number()?;
        if !(1e-3..=1e3).contains(&camera.zoom) {
            let help = "2 shows the model twice as large";
            return Err(zoom.fault("it must be from 0.001 to 1000", help));
        }
    }
    if let Some(pan) = table.get("pan") {
        camera.pan = DVec2::from(pan.vector()?);
        if camera.pan.abs().max_element() > FARTHEST_PAN {
            let what = format!("it must be from -{FARTHEST_PAN} to {FARTHEST_PAN}");
            return Err(pan.fault(
                what,
                "[0.1, 0] moves the model right by a tenth of the picture's height",
            ));
        }
    }
    Ok(Seen {
        camera,
        free,
        faces_cut: view == Some(None),
    })
}

/// Most heights of the picture that it is moved.
const FARTHEST_PAN: f64 = 10.0;

/// Refuses other keys for the camera direction in addition to `view`; an automatic angle is allowed.
fn says_nothing_else(table: &Table<'_>) -> Result<()> {
    let others = [
        "azimuth_deg",
        "elevation_deg",
        "position",
        "focal_point",
        "view_up",
    ];
    let said = |key: &&str| table.get(key).filter(|_| !is_free(table, key));
    match others.iter().find_map(said) {
        Some(other) => {
            let what = "the direction is already given by `view`";
            Err(other.fault(
                what,
                "keep either `view`, or angles, or position and focal_point",
            ))
        }
        None => Ok(()),
    }
}

/// Viewpoint that looks straight at the first section of some cuts.
pub(super) fn facing_first(
    first: Option<&ClipSurface>,
    up: Up,
    root: &Table<'_>,
) -> Result<Viewpoint> {
    match first {
        Some(surface) => Ok(Viewpoint::facing(surface, up)),
        None => {
            let camera = root.need("camera", "{ view = \"front\" }")?;
            let view = camera.table(KEYS.all())?.need("view", "\"front\"")?;
            let help = "add a section, for example z=50%, or use another view, such as front";
            Err(view.fault("there is no plane to look at", help))
        }
    }
}

/// Returns true if an angle is `"auto"`.
fn is_free(table: &Table<'_>, key: &str) -> bool {
    let auto = Value::from("auto");
    table.get(key).is_some_and(|e| e.node.value == auto)
}

/// An angle, unless it is to be found.
fn angle(table: &Table<'_>, key: &str, usual: f64) -> Result<f64> {
    match table.get(key) {
        Some(_) if is_free(table, key) => Ok(usual),
        Some(entry) if entry.is_text() => {
            let what = "it must be a number of degrees, or \"auto\"";
            Err(entry.fault(what, format!("write for example `{key} = 20`")))
        }
        Some(entry) => entry.number(),
        None => Ok(usual),
    }
}

fn viewpoint(table: &Table<'_>, (usual, up): (Viewpoint, Up), middle: DVec3) -> Result<Viewpoint> {
    let explicit = ["position", "focal_point", "view_up"]
        .iter()
        .find_map(|key| table.get(key));
    let Some(first) = explicit else {
        let Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } = usual
        else {
            return Ok(usual);
        };
        return Ok(Viewpoint::Orbit {
            azimuth_deg: angle(table, "azimuth_deg", azimuth_deg)?,
            elevation_deg: angle(table, "elevation_deg", elevation_deg)?,
        });
    };
    for key in ["azimuth_deg", "elevation_deg"] {
        if let Some(angle) = table.get(key) {
            let what = format!("the camera is already given by `{}`", first.key);
            return Err(angle.fault(what, "keep either the angles or position and focal_point"));
        }
    }
    let eye = table.need("position", "[0, 0, 5]")?;
    let position = DVec3::from(eye.vector()?);
    let focal_point = match table.get("focal_point") {
        Some(entry) => DVec3::from(entry.vector()?),
        None => middle,
    };
    if focal_point == position {
        let help = "move one of them: the camera looks from position to focal_point";
        return Err(match table.get("focal_point") {
            Some(focal) => focal.fault("it is the camera's position", help),
            None => eye.fault("it is the point that the camera looks at", help),
        });
    }
    let view_up = match table.get("view_up") {
        None => None,
        Some(entry) => {
            let view_up = DVec3::from(entry.vector()?);
            let forward = (focal_point - position).normalize_or_zero();
            if view_up.normalize_or_zero().cross(forward).length() < 1e-9 {
                let what = "it points along the viewing direction, or nowhere";
                let help = format!(
                    "use a direction across it, for example {:?}",
                    up.axis().to_array()
                );
                return Err(entry.fault(what, help));
            }
            Some(view_up)
        }
    };
    Ok(Viewpoint::Explicit {
        position,
        focal_point,
        view_up,
    })
}

fn projection(table: &Table<'_>) -> Result<Projection> {
    let orthographic = match table.get("projection") {
        Some(p) => p.choice(&[("perspective", false), ("orthographic", true)])?,
        None => false,
    };
    let (used, stray, of) = if orthographic {
        ("height", "fov_y_deg", "perspective")
    } else {
        ("fov_y_deg", "height", "orthographic")
    };
    if let Some(entry) = table.get(stray) {
        let what = format!("it belongs to a camera with projection = \"{of}\"");
        return Err(entry.fault(
            what,
            format!("remove it, use `{used}`, or set that projection"),
        ));
    }
    let used = table.get(used);
    if orthographic {
        let height = used.map(|h| h.positive()).transpose()?;
        return Ok(Projection::Orthographic { height });
    }
    let Some(entry) = used else {
        return Ok(Camera::default().projection);
    };
    let fov_y_deg = entry.positive()?;
    if fov_y_deg > 170.0 {
        return Err(entry.fault("it must be at most 170", "30 is usual, 60 is wide"));
    }
    Ok(Projection::Perspective { fov_y_deg })
}
