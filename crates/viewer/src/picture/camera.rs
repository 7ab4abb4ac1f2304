//! Interactive camera control.
//!
//! A move changes a [`Camera`], which is then written back in the document's notation: angles and a zoom for an orbit, a position and a
//! focal point for a fixed eye. A viewpoint given by a named view or by `auto` becomes an orbit.
//!
//! Cannot: tilt the horizon.

use cutaway::Result;
use cutaway::scene::{Camera, Projection, Viewpoint, to_decimals};
use cutaway_io::Document;
use cutaway_io::document::Value;
use glam::{DVec2, DVec3};

use crate::editing::timeline;

/// Limit of the elevation while orbiting. At 90 degrees, straight up or down, the picture would spin.
const STEEPEST_DEG: f64 = 89.9;

/// A move of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraMove {
    /// Orbits around the model by two angles in degrees: to the right, and up.
    Orbit(DVec2),
    /// Pans in the picture plane, to the right and up, in picture heights.
    Pan(DVec2),
    /// Zooms by a factor about a point of the picture.
    Zoom {
        /// Factor; more than 1 magnifies.
        factor: f64,
        /// Fixed point of the zoom: right and up from the picture's middle, in picture heights.
        about: DVec2,
    },
    /// Moves to the direction with this azimuth and elevation, in degrees.
    Stand([f64; 2]),
    /// Fits the whole model into the view.
    Home,
    /// Selects the projection: parallel if true, else perspective.
    Parallel(bool),
}

/// Moves a camera. A move with a non-finite number is ignored.
pub fn move_camera(camera: &mut Camera, by: CameraMove) {
    if !is_finite(by) {
        return;
    }
    match by {
        CameraMove::Orbit(degrees) => {
            let [azimuth, elevation] = angles(camera);
            let to = [azimuth - degrees.x, elevation - degrees.y];
            turn(camera, [to[0], to[1].clamp(-STEEPEST_DEG, STEEPEST_DEG)]);
        }
        CameraMove::Pan(by) => camera.pan = (camera.pan + by).clamp(-FARTHEST_PAN, FARTHEST_PAN),
        CameraMove::Zoom { factor, about } => {
            let zoom = (camera.zoom * factor).clamp(1e-3, 1e3);
            let factor = zoom / camera.zoom;
            camera.zoom = zoom;
            let pan = about - (about - camera.pan) * factor;
            camera.pan = pan.clamp(-FARTHEST_PAN, FARTHEST_PAN);
        }
        CameraMove::Stand([azimuth, elevation]) => {
            turn(camera, [azimuth, elevation.clamp(-90.0, 90.0)]);
        }
        CameraMove::Home => {
            (camera.zoom, camera.pan) = (1.0, DVec2::ZERO);
            if let Viewpoint::Explicit { .. } = camera.viewpoint {
                let [azimuth_deg, elevation_deg] = angles(camera);
                camera.viewpoint = Viewpoint::Orbit {
                    azimuth_deg,
                    elevation_deg,
                };
            }
        }
        CameraMove::Parallel(true) => {
            camera.projection = Projection::Orthographic { height: None };
        }
        CameraMove::Parallel(false) => camera.projection = Camera::default().projection,
    }
}

/// Returns true if all numbers of a move are finite.
fn is_finite(by: CameraMove) -> bool {
    match by {
        CameraMove::Orbit(by) | CameraMove::Pan(by) => by.is_finite(),
        CameraMove::Zoom { factor, about } => factor.is_finite() && about.is_finite(),
        CameraMove::Stand(to) => to.iter().all(|angle| angle.is_finite()),
        CameraMove::Home | CameraMove::Parallel(_) => true,
    }
}

/// Largest pan that documents allow.
const FARTHEST_PAN: DVec2 = DVec2::splat(10.0);

/// Moves the eye to a direction, and keeps its distance.
fn turn(camera: &mut Camera, [azimuth_deg, elevation_deg]: [f64; 2]) {
    let azimuth_deg = (azimuth_deg + 180.0).rem_euclid(360.0) - 180.0;
    camera.viewpoint = match camera.viewpoint {
        Viewpoint::Explicit {
            position,
            focal_point,
            ..
        } => {
            let towards = camera.up.direction([azimuth_deg, elevation_deg]);
            Viewpoint::Explicit {
                position: focal_point + towards * (position - focal_point).length(),
                focal_point,
                view_up: None,
            }
        }
        _ => Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        },
    };
}

/// Azimuth and elevation of an eye, in degrees.
pub fn angles(camera: &Camera) -> [f64; 2] {
    let towards = match camera.viewpoint {
        Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } => return [azimuth_deg, elevation_deg],
        Viewpoint::Along { forward, .. } => -forward,
        Viewpoint::Explicit {
            position,
            focal_point,
            ..
        } => position - focal_point,
    };
    camera.up.angles(towards)
}

/// Rounds a camera to the precision of documents.
pub fn round(camera: &mut Camera) {
    let decimals =
        |v: DVec3, count: i32| DVec3::from_array(v.to_array().map(|c| to_decimals(c, count)));
    camera.viewpoint = match camera.viewpoint {
        Viewpoint::Explicit {
            position,
            focal_point,
            view_up,
        } => {
            // Decimals for a millionth of the eye's distance.
            let count = 6 - (position - focal_point).length().log10().floor() as i32;
            Viewpoint::Explicit {
                position: decimals(position, count),
                focal_point: decimals(focal_point, count),
                view_up,
            }
        }
        Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } => Viewpoint::Orbit {
            azimuth_deg: to_decimals(azimuth_deg, 2),
            elevation_deg: to_decimals(elevation_deg, 2),
        },
        along => along,
    };
    camera.zoom = to_decimals(camera.zoom, 5);
    camera.pan = DVec2::from_array(camera.pan.to_array().map(|c| to_decimals(c, 5)));
}

/// Writes the changed values of a camera into a document, [rounded](round).
///
/// # Errors
///
/// The document's `camera` is not a table.
pub fn write(camera: &Camera, document: &mut Document) -> Result<()> {
    match camera.viewpoint {
        Viewpoint::Explicit {
            position,
            focal_point,
            view_up,
        } => {
            document.set("camera.position", position.to_array().to_vec())?;
            document.set("camera.focal_point", focal_point.to_array().to_vec())?;
            if view_up.is_none() {
                document.remove("camera.view_up")?;
            }
        }
        _ => {
            for key in ["view", "position", "focal_point", "view_up"] {
                document.remove(&format!("camera.{key}"))?;
            }
            let [azimuth, elevation] = angles(camera);
            document.set("camera.azimuth_deg", azimuth)?;
            document.set("camera.elevation_deg", elevation)?;
        }
    }
    // Default values are not written.
    let (projection, fov_y_deg, height) = match camera.projection {
        Projection::Perspective { fov_y_deg } => (None, Some(fov_y_deg), None),
        Projection::Orthographic { height } => (Some("orthographic".into()), None, height),
    };
    let usual = Camera::default();
    let is_usual = camera.projection == usual.projection;
    for (key, value) in [
        ("projection", projection),
        (
            "fov_y_deg",
            fov_y_deg.filter(|_| !is_usual).map(Value::from),
        ),
        ("height", height.map(Value::from)),
        (
            "zoom",
            (camera.zoom != usual.zoom).then(|| camera.zoom.into()),
        ),
        (
            "pan",
            (camera.pan != usual.pan).then(|| camera.pan.to_array().to_vec().into()),
        ),
    ] {
        let path = format!("camera.{key}");
        match value {
            Some(value) => document.set(&path, value)?,
            // A value that keys animate has to be in the document.
            None if timeline::is_target(document, &path) => match key {
                "zoom" => document.set(&path, camera.zoom)?,
                "pan" => document.set(&path, camera.pan.to_array().to_vec())?,
                _ => {}
            },
            None => document.remove(&path)?,
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::scene::Up;

    #[test]
    fn what_is_under_the_pointer_stays_there() {
        let mut camera = Camera::default();
        let about = DVec2::new(0.3, -0.2);
        for factor in [2.0, 0.7, 1e9, 1e-9] {
            let content = |camera: &Camera| (about - camera.pan) / camera.zoom;
            let before = content(&camera);
            move_camera(&mut camera, CameraMove::Zoom { factor, about });
            // Near the limits of the zoom the picture is clamped, so this is not checked.
            if (2e-3..5e2).contains(&camera.zoom) {
                assert!((content(&camera) - before).length() < 1e-12, "{factor}");
            }
        }
    }

    #[test]
    fn a_move_to_no_number_leaves_the_eye_where_it_is() {
        let none = DVec2::new(0.0, f64::NAN);
        let about = DVec2::ZERO;
        for by in [
            CameraMove::Orbit(none),
            CameraMove::Orbit(DVec2::new(f64::INFINITY, 0.0)),
            CameraMove::Pan(none),
            CameraMove::Zoom {
                factor: f64::NAN,
                about,
            },
            CameraMove::Stand([f64::NAN, 0.0]),
        ] {
            let mut camera = Camera::default();
            move_camera(&mut camera, by);
            assert_eq!(camera, Camera::default(), "{by:?}");
        }
    }

    #[test]
    fn nothing_is_seen_from_beyond_straight_above() {
        for (to, expected) in [([0.0, 200.0], 90.0), ([0.0, -1e300], -90.0)] {
            let mut camera = Camera::default();
            move_camera(&mut camera, CameraMove::Stand(to));
            assert_eq!(angles(&camera), [0.0, expected]);
        }
    }

    #[test]
    fn an_orbit_of_any_eye_turns_it_by_as_much() {
        for up in [Up::PlusY, Up::PlusZ] {
            for viewpoint in [
                Camera::default().viewpoint,
                Viewpoint::Along {
                    forward: DVec3::new(-1.0, -0.3, -0.2),
                    view_up: up.axis(),
                },
                Viewpoint::Explicit {
                    position: DVec3::new(3.0, 1.0, 2.0),
                    focal_point: DVec3::ONE * 0.5,
                    view_up: None,
                },
            ] {
                let mut camera = Camera {
                    up,
                    viewpoint,
                    ..Camera::default()
                };
                let before = angles(&camera);
                move_camera(&mut camera, CameraMove::Orbit(DVec2::new(10.0, -5.0)));
                let after = angles(&camera);
                let turned = [after[0] - before[0], after[1] - before[1]];
                assert!((turned[0] + 10.0).abs() < 1e-9, "{viewpoint:?}: {turned:?}");
                assert!((turned[1] - 5.0).abs() < 1e-9, "{viewpoint:?}: {turned:?}");
            }
        }
    }
}
