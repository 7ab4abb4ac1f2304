//! Section of the parts of a scene by a plane, as polygons with holes.
//!
//! Points are coordinates along `u` and `v` from `origin`, the point of the plane nearest to the world origin. `u` is the projection onto
//! the plane of the world axis that cyclically follows the axis nearest to the normal; `u` x `v` is the normal. In a section `z=..` `u` and
//! `v` are x and y, in `x=..` y and z, in `y=..` z and x.

use cutaway::scene::SceneSpace;
use cutaway::slice::{SectionDefect, SlicePlane, Slicer};
use cutaway_io::document::section as section_draft;
use glam::{DVec2, DVec3};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::arrays::points;
use crate::door::{Result, detached};
use crate::opened::Purpose;
use crate::scene::Scene;
use crate::state::{CallSettings, Shared};

/// A ring of points.
type PolygonRing = Vec<[f64; 2]>;

/// Section of a scene by a plane.
struct SceneSection {
    axes: PlaneAxes,
    /// Outer ring and holes, with the name of the part.
    polygons: Vec<(PolygonRing, Vec<PolygonRing>, String)>,
    area: f64,
    perimeter: f64,
    doubts: Vec<String>,
}

/// Coordinate frame of the plane.
#[derive(Clone, Copy)]
struct PlaneAxes {
    origin: DVec3,
    u: DVec3,
    v: DVec3,
    normal: DVec3,
}

impl PlaneAxes {
    fn of(plane: &SlicePlane) -> Self {
        let normal = plane.frame.normal;
        let nearest = (0..3).fold(0, |a, b| match normal[b].abs() > normal[a].abs() {
            true => b,
            false => a,
        });
        let next = DVec3::AXES[(nearest + 1) % 3];
        let u = (next - normal * next.dot(normal)).normalize_or(plane.frame.u_hat);
        Self {
            origin: plane.seen_from(DVec3::ZERO).zero,
            u,
            v: normal.cross(u),
            normal,
        }
    }

    /// Coordinates of a point in the plane. Adding zero turns -0 into 0.
    fn uv(&self, point: DVec3) -> [f64; 2] {
        let from_origin = point - self.origin;
        [self.u, self.v].map(|axis| from_origin.dot(axis) + 0.0)
    }
}

/// Slices a scene at a given time; its own cuts are ignored.
pub(crate) fn section<'py>(
    scene: &Scene,
    py: Python<'py>,
    spec: &str,
    asked: CallSettings,
) -> PyResult<Bound<'py, PyDict>> {
    let (scene, spec) = (scene.shared(), spec.to_owned());
    let sliced = detached(py, move || sliced(&scene, &spec, asked))?;
    let result = PyDict::new(py);
    let polygons = PyList::empty(py);
    let names = PyList::empty(py);
    for (outer, holes, name) in &sliced.polygons {
        let holes = holes.iter().map(|hole| points(py, hole));
        let holes = holes.collect::<PyResult<Vec<_>>>()?;
        polygons.append((points(py, outer)?, holes))?;
        names.append(name)?;
    }
    result.set_item("polygons", polygons)?;
    result.set_item("parts", names)?;
    result.set_item("area", sliced.area)?;
    result.set_item("perimeter", sliced.perimeter)?;
    let PlaneAxes {
        origin,
        u,
        v,
        normal,
    } = sliced.axes;
    for (key, vector) in [("origin", origin), ("u", u), ("v", v), ("normal", normal)] {
        result.set_item(key, (vector + DVec3::ZERO).to_array())?;
    }
    result.set_item("doubts", sliced.doubts)?;
    Ok(result)
}

fn sliced(scene: &Shared, spec: &str, asked: CallSettings) -> Result<SceneSection> {
    let mut state = scene.state();
    let shown = state.open(asked, Purpose::Measurement)?.scene.clone();
    let surface = section_draft(spec).on_from(&shown.bounds(), &mut state.assets)?;
    drop(state);
    let plane = SlicePlane::from(&surface);
    let axes = PlaneAxes::of(&plane);
    let mut sliced = SceneSection {
        axes,
        polygons: Vec::new(),
        area: 0.0,
        perimeter: 0.0,
        doubts: Vec::new(),
    };
    let space = SceneSpace::new(&shown.bounds());
    for part in &shown.parts {
        // Coordinates are computed relative to a point near the part, for the greatest precision.
        let near = plane.seen_from(part.bounds_in_world().centre());
        let found = Slicer::of_part_in(part, &space).section_by(&near, part.fill);
        let point = |number: &u32| {
            let at: DVec2 = found.points[*number as usize];
            axes.uv(near.point(at))
        };
        let ring = |points: &Vec<u32>| -> PolygonRing { points.iter().map(point).collect() };
        for polygon in found.polygons() {
            let holes = polygon.holes.iter().map(ring).collect();
            let named = (ring(&polygon.outer), holes, part.name.clone());
            sliced.polygons.push(named);
        }
        sliced.area += found.area();
        sliced.perimeter += found.perimeter();
        let doubt =
            |defect: &SectionDefect| format!("{}: {defect}\n  help: {}", part.name, defect.help());
        sliced.doubts.extend(found.defects.iter().map(doubt));
    }
    Ok(sliced)
}
