//! `[camera]`.

use glam::DVec3;

use super::reader::{Entry, Table};
use crate::error::Result;
use crate::scene::{Camera, Projection, Up, Viewpoint};

const KEYS: &[&str] = &[
    "azimuth_deg",
    "elevation_deg",
    "position",
    "focal_point",
    "view_up",
    "projection",
    "fov_y_deg",
    "height",
    "near",
    "near_cap",
    "up",
];

pub(super) fn read(entry: &Entry<'_>) -> Result<Camera> {
    let table = entry.table(KEYS)?;
    let mut camera = Camera::default();
    if let Some(up) = table.get("up") {
        camera.up = up.choice(&[("+Y", Up::PlusY), ("+Z", Up::PlusZ)])?;
    }
    camera.viewpoint = viewpoint(&table, camera.viewpoint, camera.up)?;
    camera.projection = projection(&table)?;
    camera.near = table.get("near").map(|n| n.positive()).transpose()?;
    if let Some(cap) = table.get("near_cap") {
        camera.near_cap = cap.flag()?;
    }
    Ok(camera)
}

fn viewpoint(table: &Table<'_>, usual: Viewpoint, up: Up) -> Result<Viewpoint> {
    let explicit = ["position", "focal_point", "view_up"]
        .iter()
        .find_map(|key| table.get(key));
    let Some(first) = explicit else {
        let Viewpoint::Orbit {
            mut azimuth_deg,
            mut elevation_deg,
        } = usual
        else {
            return Ok(usual);
        };
        if let Some(entry) = table.get("azimuth_deg") {
            azimuth_deg = entry.number()?;
        }
        if let Some(entry) = table.get("elevation_deg") {
            elevation_deg = entry.number()?;
        }
        return Ok(Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        });
    };
    for key in ["azimuth_deg", "elevation_deg"] {
        if let Some(angle) = table.get(key) {
            let what = format!("the camera is already given by `{}`", first.key);
            return Err(angle.fault(what, "keep either the angles or position and focal_point"));
        }
    }
    let position = DVec3::from(table.need("position", "[0, 0, 5]")?.vector()?);
    let focal = table.need("focal_point", "[0, 0, 0]")?;
    let focal_point = DVec3::from(focal.vector()?);
    if focal_point == position {
        let mend = "move one of them: the camera looks from position to focal_point";
        return Err(focal.fault("it is the camera's position", mend));
    }
    let view_up = match table.get("view_up") {
        None => None,
        Some(entry) => {
            let view_up = DVec3::from(entry.vector()?);
            let forward = (focal_point - position).normalize_or_zero();
            if view_up.normalize_or_zero().cross(forward).length() < 1e-9 {
                let what = "it points along the viewing direction, or nowhere";
                let mend = format!(
                    "use a direction across it, for example {:?}",
                    up.axis().to_array()
                );
                return Err(entry.fault(what, mend));
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
