//! `[camera]`.
//!
//! If an orbit angle is `"auto"`, or if there is no `[camera]`, the camera turns to where most faces of the cuts are visible. A fixed
//! default would show only the backs of half of all sections. `view` is a named direction.

use cutaway::error::Result;
use cutaway::scene::describe::OrWord;
use cutaway::scene::{
    Bounds, Camera, ClipSurface, Cut, Fit, Projection, STANDARD_VIEWS, Up, Viewpoint,
};
use glam::DVec3;

use super::described;
use super::reader::{Entry, Table};
use crate::document::Keys;
use crate::document::Value;
use crate::document::describe::{CameraDesc, ProjectionKind};

static KEYS: Keys = Keys::below("camera");

/// A camera, with flags that mark automatic angles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) camera: Camera,
    /// True if the azimuth and the elevation, in this order, are automatic.
    pub(crate) free: [bool; 2],
    /// True if the camera faces the first section, which is known only once the cuts are read.
    pub(super) faces_cut: bool,
}

impl Seen {
    /// Camera of a document without camera settings.
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

    /// Finds the angles from which most faces of the given cuts are visible. Of equally good angles, those nearest to the default win.
    pub(crate) fn turned<'a>(&self, cuts: impl Iterator<Item = &'a Cut> + Clone) -> Viewpoint {
        self.camera.viewpoint_facing(cuts, self.free)
    }
}

/// Reads a camera, whose default focal point is the middle of the bounds.
pub(super) fn read(entry: &Entry<'_>, bounds: &Bounds, usual_fit: Fit) -> Result<Seen> {
    let table = entry.table(KEYS.all())?;
    let desc: CameraDesc = described::read(&table)?;
    let usual = Camera::default();
    let has_view = desc.view.is_some();
    let free = [&desc.azimuth_deg, &desc.elevation_deg];
    let free = free.map(|angle| !has_view && matches!(angle, Some(OrWord::Word(_))));
    let angles = match &desc.view {
        Some(view) => {
            says_nothing_else(&table)?;
            STANDARD_VIEWS.iter().find(|(name, _)| name == view)
        }
        None => None,
    };
    let viewpoint = match (has_view, angles) {
        (false, _) => viewpoint(&table, &desc, bounds.centre())?,
        (true, Some(&(_, [azimuth_deg, elevation_deg]))) => Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        },
        (true, None) => usual.viewpoint,
    };
    let camera = Camera {
        viewpoint,
        projection: projection(&table, &desc)?,
        up: desc.up,
        near: desc.near,
        fit: desc.fit.unwrap_or(usual_fit),
        near_cap: desc.near_cap.unwrap_or(usual.near_cap),
        zoom: desc.zoom.unwrap_or(usual.zoom),
        pan: desc.pan,
    };
    Ok(Seen {
        camera,
        free,
        faces_cut: has_view && angles.is_none(),
    })
}

/// Refuses keys that give the camera direction in addition to `view`. An automatic angle is allowed.
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

/// Viewpoint that faces the first section among the given cuts.
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

fn viewpoint(table: &Table<'_>, desc: &CameraDesc, middle: DVec3) -> Result<Viewpoint> {
    let explicit = ["position", "focal_point", "view_up"]
        .iter()
        .find_map(|key| table.get(key));
    let Some(first) = explicit else {
        let Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } = Camera::default().viewpoint
        else {
            return Ok(Camera::default().viewpoint);
        };
        let angle = |given: &Option<OrWord<f64>>, usual| match given {
            Some(OrWord::Value(angle)) => *angle,
            _ => usual,
        };
        return Ok(Viewpoint::Orbit {
            azimuth_deg: angle(&desc.azimuth_deg, azimuth_deg),
            elevation_deg: angle(&desc.elevation_deg, elevation_deg),
        });
    };
    for key in ["azimuth_deg", "elevation_deg"] {
        if let Some(angle) = table.get(key) {
            let what = format!("the camera is already given by `{}`", first.key);
            return Err(angle.fault(what, "keep either the angles or position and focal_point"));
        }
    }
    let eye = table.need("position", "[0, 0, 5]")?;
    let position = desc.position.unwrap_or_default();
    let focal_point = desc.focal_point.unwrap_or(middle);
    if focal_point == position {
        let help = "move one of them: the camera looks from position to focal_point";
        return Err(match table.get("focal_point") {
            Some(focal) => focal.fault("it is the camera's position", help),
            None => eye.fault("it is the point that the camera looks at", help),
        });
    }
    let forward = (focal_point - position).normalize_or_zero();
    if let (Some(view_up), Some(entry)) = (desc.view_up, table.get("view_up"))
        && view_up.normalize_or_zero().cross(forward).length() < 1e-9
    {
        let what = "it is zero, or points along the viewing direction";
        let across = desc.up.axis().to_array();
        let help = format!("use a direction at an angle to it, for example {across:?}");
        return Err(entry.fault(what, help));
    }
    Ok(Viewpoint::Explicit {
        position,
        focal_point,
        view_up: desc.view_up,
    })
}

fn projection(table: &Table<'_>, desc: &CameraDesc) -> Result<Projection> {
    let (used, stray, of) = match desc.projection {
        ProjectionKind::Orthographic => ("height", "fov_y_deg", ProjectionKind::Perspective),
        ProjectionKind::Perspective => ("fov_y_deg", "height", ProjectionKind::Orthographic),
    };
    if let Some(entry) = table.get(stray) {
        let of = of.name();
        let what = format!("it belongs to a camera with projection = \"{of}\"");
        let help = format!("remove it, use `{used}`, or set that projection");
        return Err(entry.fault(what, help));
    }
    Ok(match (desc.projection, desc.fov_y_deg) {
        (ProjectionKind::Orthographic, _) => Projection::Orthographic {
            height: desc.height,
        },
        (ProjectionKind::Perspective, Some(fov_y_deg)) => Projection::Perspective { fov_y_deg },
        (ProjectionKind::Perspective, None) => Camera::default().projection,
    })
}
