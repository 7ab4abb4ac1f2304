//! A camera that moves around the up axis, in addition to all other motion.
//!
//! If each picture were fitted separately, an orbiting camera would move closer and farther as the model's apparent width changes.
//! Here all pictures have the distance, or the orthographic height, of the widest view of the turn, around the centre
//! of the fitted extent.

use cutaway::scene::{
    Bounds, Camera, Outline, Projection, View, Viewpoint, distance_around, half_height_around,
};
use glam::{DQuat, DVec3};

/// Number of views per turn tested to find the widest.
const VIEWS: u32 = 72;

/// The camera after a fraction of a turn, fitted to an outline in world space, or else to the bounds.
pub(super) fn turned(
    camera: &Camera,
    fitted_to: (&Bounds, Option<&Outline>),
    size_px: [u32; 2],
    turn_deg: f64,
    share: f64,
) -> Camera {
    let Start {
        camera,
        position,
        focal_point,
        view_up,
    } = Start::of(camera, fitted_to, size_px, turn_deg);
    let turn = DQuat::from_axis_angle(camera.up.axis(), (turn_deg * share).to_radians());
    Camera {
        viewpoint: Viewpoint::Explicit {
            position: focal_point + turn * (position - focal_point),
            focal_point,
            view_up: view_up.map(|up| turn * up),
        },
        ..camera
    }
}

/// Start of the turn.
struct Start {
    camera: Camera,
    position: DVec3,
    focal_point: DVec3,
    view_up: Option<DVec3>,
}

impl Start {
    fn of(
        camera: &Camera,
        (bounds, outline): (&Bounds, Option<&Outline>),
        size_px: [u32; 2],
        turn_deg: f64,
    ) -> Self {
        if let Viewpoint::Explicit {
            position,
            focal_point,
            view_up,
        } = camera.viewpoint
        {
            return Self {
                camera: *camera,
                position,
                focal_point,
                view_up,
            };
        }
        let views: Vec<View> = (0..=VIEWS)
            .map(|i| {
                let viewpoint = after(camera, turn_deg * f64::from(i) / f64::from(VIEWS));
                // The zoom of a fitted camera applies later.
                Camera {
                    viewpoint,
                    zoom: 1.0,
                    ..*camera
                }
                .view(|p| p, 1.0, *bounds, size_px)
            })
            .collect();
        let most = |of: &dyn Fn(&View) -> f64| views.iter().map(of).fold(0.0, f64::max);
        let (focal_point, distance, half_height) = match outline {
            None => {
                let focal_point = bounds.centre();
                let distance = most(&|v| (v.eye - focal_point).length());
                (focal_point, distance, most(&|v| v.half_height))
            }
            Some(outline) => {
                let own = Bounds::from_points(outline.points().iter().copied());
                let focal_point = own.centre();
                let seen = |v: &View| -> Vec<DVec3> {
                    let axes = [v.right, v.up, v.forward];
                    let around = outline.points().iter().map(|p| *p - focal_point);
                    around
                        .map(|p| DVec3::from_array(axes.map(|axis| p.dot(axis))))
                        .collect()
                };
                // The eye stays outside the rotating model, whatever it looks at.
                let apart = bounds.radius() * 2.0;
                let distance = match views[0].orthographic {
                    true => apart,
                    false => most(&|v| distance_around(&seen(v), v.half_height, size_px)),
                };
                let half_height = most(&|v| half_height_around(&seen(v), size_px));
                (focal_point, distance, half_height)
            }
        };
        let mut camera = *camera;
        if let Projection::Orthographic { height: None } = camera.projection {
            camera.projection = Projection::Orthographic {
                height: Some(2.0 * half_height),
            };
        }
        // Seen from straight above, the up axis does not define what is up in the picture; a view along a direction has its own up.
        let is_along = matches!(camera.viewpoint, Viewpoint::Along { .. });
        let is_pole = views[0].forward.cross(camera.up.axis()).length() < 1e-6;
        Self {
            camera,
            position: focal_point - views[0].forward * distance,
            focal_point,
            view_up: (is_pole || is_along).then_some(views[0].up),
        }
    }
}

/// Viewpoint of a fitted camera after a turn about its up axis.
fn after(camera: &Camera, turn_deg: f64) -> Viewpoint {
    match camera.viewpoint {
        Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        } => Viewpoint::Orbit {
            azimuth_deg: azimuth_deg + turn_deg,
            elevation_deg,
        },
        Viewpoint::Along { forward, view_up } => {
            let turn = DQuat::from_axis_angle(camera.up.axis(), turn_deg.to_radians());
            Viewpoint::Along {
                forward: turn * forward,
                view_up: turn * view_up,
            }
        }
        explicit => explicit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::scene::Up;

    const SIZE: [u32; 2] = [320, 200];

    fn slab() -> Bounds {
        Bounds {
            min: DVec3::new(-3.0, -0.5, -0.25),
            max: DVec3::new(5.0, 0.5, 0.25),
        }
    }

    fn orbit(elevation_deg: f64, up: Up, projection: Projection) -> Camera {
        Camera {
            viewpoint: Viewpoint::Orbit {
                azimuth_deg: 35.0,
                elevation_deg,
            },
            up,
            projection,
            ..Camera::default()
        }
    }

    fn cameras() -> Vec<Camera> {
        let mut cameras = Vec::new();
        for projection in [
            Projection::Perspective { fov_y_deg: 30.0 },
            Projection::Orthographic { height: None },
        ] {
            for up in [Up::PlusY, Up::PlusZ] {
                cameras.extend([-20.0, 0.0, 60.0, 90.0].map(|e| orbit(e, up, projection)));
            }
        }
        cameras
    }

    fn view(camera: &Camera, turn_deg: f64, share: f64) -> View {
        turned(camera, (&slab(), None), SIZE, turn_deg, share).view(|p| p, 1.0, slab(), SIZE)
    }

    #[test]
    fn a_full_turn_ends_where_it_began() {
        for camera in cameras() {
            let [start, end] = [0.0, 1.0].map(|s| view(&camera, 360.0, s));
            assert!((start.eye - end.eye).length() < 1e-9, "{camera:?}");
            assert!((start.up - end.up).length() < 1e-9, "{camera:?}");
        }
    }

    #[test]
    fn it_looks_where_an_orbit_of_that_azimuth_looks() {
        for camera in cameras() {
            let Viewpoint::Orbit { elevation_deg, .. } = camera.viewpoint else {
                continue;
            };
            for (share, azimuth_deg) in [(0.0, 35.0), (0.25, 65.0), (0.5, 95.0)] {
                let viewpoint = Viewpoint::Orbit {
                    azimuth_deg,
                    elevation_deg,
                };
                let orbit = Camera {
                    viewpoint,
                    ..camera
                }
                .view(|p| p, 1.0, slab(), SIZE);
                let turned = view(&camera, 120.0, share);
                assert!(
                    (turned.forward - orbit.forward).length() < 1e-9,
                    "{camera:?}"
                );
                assert!((turned.up - orbit.up).length() < 1e-6, "{camera:?} {share}");
            }
        }
    }

    #[test]
    fn the_model_stays_in_the_picture_and_keeps_its_size() {
        for camera in cameras() {
            let views: Vec<View> = (0..24)
                .map(|i| view(&camera, 360.0, f64::from(i) / 24.0))
                .collect();
            let distance = |v: &View| (v.eye - slab().centre()).length();
            for v in &views {
                assert!(
                    (distance(v) - distance(&views[0])).abs() < 1e-9,
                    "{camera:?}"
                );
                assert!(
                    (v.half_height - views[0].half_height).abs() < 1e-9,
                    "{camera:?}"
                );
                for corner in slab().corners() {
                    let (at, _) = v.project(corner);
                    let inside = (0.0..=320.0).contains(&at.x) && (0.0..=200.0).contains(&at.y);
                    assert!(inside, "{camera:?}: a corner is at {at}");
                }
            }
        }
    }

    #[test]
    fn a_camera_that_is_given_goes_round_its_focal_point() {
        let camera = Camera {
            viewpoint: Viewpoint::Explicit {
                position: DVec3::new(1.0, 3.0, 5.0),
                focal_point: DVec3::new(1.0, 0.0, 0.0),
                view_up: Some(DVec3::X),
            },
            ..Camera::default()
        };
        let Viewpoint::Explicit {
            position, view_up, ..
        } = turned(&camera, (&slab(), None), SIZE, 90.0, 1.0).viewpoint
        else {
            panic!("a place was given");
        };
        assert!(
            (position - DVec3::new(6.0, 3.0, 0.0)).length() < 1e-9,
            "{position}"
        );
        assert!(
            (view_up.unwrap_or_default() + DVec3::Z).length() < 1e-9,
            "{view_up:?}"
        );
    }
}
