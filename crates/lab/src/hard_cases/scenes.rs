//! Scenes, cameras and clip-surfaces in short form, for tests: invalid input panics.

use std::sync::Arc;

use cutaway::scene::{
    Camera, ClipSurface, Cut, Mesh, OffsetMap, Part, Projection, Scene, Style, Viewpoint, Wrap,
};
use cutaway_io::document;
use glam::DVec3;

use super::meshes;

/// A scene of one mesh and one cut, seen from the usual place.
pub fn scene(name: &str, mesh: Mesh, surfaces: Vec<ClipSurface>) -> Scene {
    of_parts(name, vec![Part::new("solid", mesh)], surfaces)
}

/// A scene of parts and one cut; without clip-surfaces there is no cut.
pub fn of_parts(name: &str, parts: Vec<Part>, surfaces: Vec<ClipSurface>) -> Scene {
    let cuts = if surfaces.is_empty() {
        Vec::new()
    } else {
        vec![Cut::new("cut", surfaces)]
    };
    Scene {
        name: name.to_owned(),
        parts,
        cuts,
        camera: Camera::default(),
        stage: None,
        outline: None,
        interference: None,
        style: Style::default(),
    }
}

/// A scene of a built-in shape, with sections as on the command line.
pub fn sectioned(shape: &str, sections: &[&str]) -> Scene {
    let mut made = of_parts(shape, meshes::parts(shape), Vec::new());
    let bounds = made.bounds();
    let surfaces = sections
        .iter()
        .map(|s| ClipSurface::parse(s, &bounds).unwrap_or_else(|e| panic!("{s}: {e}")))
        .collect();
    made.cuts = vec![Cut::new("cut", surfaces)];
    made
}

/// A section with a relief, both as on the command line.
pub fn relief(scene: &Scene, section: &str, relief: &str) -> ClipSurface {
    let surface = document::section(section)
        .relief(relief)
        .on(&scene.bounds());
    surface.unwrap_or_else(|e| panic!("{section}, {relief}: {e}"))
}

/// A plane with a height map that repeats once per `period` in both directions and is centred on the origin. Its axes are those of
/// Duff et al. (2017).
pub fn mapped(
    origin: DVec3,
    normal: DVec3,
    map: OffsetMap,
    (period, height): (f64, f64),
    wrap: Wrap,
) -> ClipSurface {
    let mut surface = ClipSurface::plane(origin, normal);
    let (u, v) = normal.normalize_or(DVec3::Z).any_orthonormal_pair();
    surface.u = u.normalize() * period;
    surface.v = v.normalize() * period;
    surface.origin -= 0.5 * (surface.u + surface.v);
    surface.scale.z = height;
    surface.relief = Some(Arc::new(map));
    surface.wrap = wrap;
    surface
}

/// A height map computed texel by texel.
pub fn map(size: [u32; 2], height: impl Fn(u32, u32) -> f32) -> OffsetMap {
    let texels = (0..size[1])
        .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
        .map(|(x, y)| height(x, y))
        .collect();
    OffsetMap::new(size, texels).expect("a map of finite heights")
}

/// A camera at `from` that looks at `to`.
pub fn looking(from: DVec3, to: DVec3, fov_y_deg: f64) -> Camera {
    Camera {
        viewpoint: Viewpoint::Explicit {
            position: from,
            focal_point: to,
            view_up: None,
        },
        projection: Projection::Perspective { fov_y_deg },
        ..Camera::default()
    }
}

/// An orthographic camera at `from` that looks at `to`; the picture is `height` units high.
pub fn parallel(from: DVec3, to: DVec3, height: f64) -> Camera {
    Camera {
        projection: Projection::Orthographic {
            height: Some(height),
        },
        ..looking(from, to, 30.0)
    }
}

/// The usual view from another direction.
pub fn orbit(azimuth_deg: f64, elevation_deg: f64, orthographic: bool) -> Camera {
    Camera {
        viewpoint: Viewpoint::Orbit {
            azimuth_deg,
            elevation_deg,
        },
        projection: if orthographic {
            Projection::Orthographic { height: None }
        } else {
            Projection::Perspective { fov_y_deg: 30.0 }
        },
        ..Camera::default()
    }
}
