//! Reads the vertices and triangles of an object, and the properties of its triangles.
//!
//! Numbers are read as f64. The format requires vertices to precede triangles, so a wrong index is reported with its line. Other content of
//! a mesh, such as triangle sets, does not affect its shape and is ignored.

use cutaway::error::Result;
use cutaway::scene::Mesh;
use glam::DVec3;

use super::xml::{Element, Space, Xml, shortened};

/// Marks a missing index.
pub(super) const NONE: u32 = u32::MAX;

/// Properties of a triangle, given by a property group and an index for each corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Assigned {
    pub(super) group: u32,
    pub(super) corners: [u32; 3],
}

/// The mesh of an object.
#[derive(Clone, Debug, Default)]
pub(super) struct Geometry {
    pub(super) mesh: Mesh,
    /// Properties of each triangle.
    pub(super) assigned: Vec<Assigned>,
    /// True if the mesh has beams in addition to the triangles.
    pub(super) has_beams: bool,
}

/// Reads a `<mesh>` element, which is already open.
pub(super) fn read(xml: &mut Xml<'_>) -> Result<Geometry> {
    let mut geometry = Geometry::default();
    while let Some(element) = xml.child()? {
        if element.is(Space::Core, "vertices") {
            while let Some(vertex) = xml.child()? {
                if vertex.is(Space::Core, "vertex") {
                    geometry.mesh.positions.push(position(&vertex)?);
                }
                xml.skip()?;
            }
        } else if element.is(Space::Core, "triangles") {
            while let Some(triangle) = xml.child()? {
                if triangle.is(Space::Core, "triangle") {
                    geometry.add(&triangle)?;
                }
                xml.skip()?;
            }
        } else {
            geometry.has_beams |= element.is_named("beamlattice");
            xml.skip()?;
        }
    }
    Ok(geometry)
}

impl Geometry {
    /// Keeps only the triangles for whose index `wanted` is true.
    pub(super) fn keep(&mut self, wanted: impl Fn(usize) -> bool) {
        let mut numbers = 0..self.mesh.triangles.len();
        self.mesh
            .triangles
            .retain(|_| numbers.next().is_some_and(&wanted));
        let mut numbers = 0..self.assigned.len();
        self.assigned
            .retain(|_| numbers.next().is_some_and(&wanted));
    }

    fn add(&mut self, triangle: &Element<'_>) -> Result<()> {
        let [v1, v2, v3, pid, p1, p2, p3] =
            triangle.values(["v1", "v2", "v3", "pid", "p1", "p2", "p3"])?;
        let mut corners = [0; 3];
        for (corner, (value, name)) in corners.iter_mut().zip([(v1, "v1"), (v2, "v2"), (v3, "v3")])
        {
            let value = triangle.needed(value, name)?;
            let index: Option<u32> = value.trim().parse().ok();
            *corner = index.ok_or_else(|| {
                let value = shortened(&value);
                triangle.error(format!(
                    "{name} is `{value}`, which is not the index of a vertex"
                ))
            })?;
            let known = self.mesh.positions.len();
            if *corner as usize >= known {
                let what = format!("{name} refers to vertex {corner}, but there are only {known}");
                return Err(triangle.error(what));
            }
        }
        let number = |value: Option<std::borrow::Cow<'_, str>>| {
            value
                .and_then(|value| value.trim().parse().ok())
                .unwrap_or(NONE)
        };
        let first = number(p1);
        let or_first = |index: u32| if index == NONE { first } else { index };
        self.mesh.triangles.push(corners);
        self.assigned.push(Assigned {
            group: number(pid),
            corners: [first, or_first(number(p2)), or_first(number(p3))],
        });
        Ok(())
    }
}

fn position(vertex: &Element<'_>) -> Result<DVec3> {
    let mut numbers = [0.0_f64; 3];
    let values = vertex.values(["x", "y", "z"])?;
    for ((number, value), name) in numbers.iter_mut().zip(values).zip(["x", "y", "z"]) {
        let value = vertex.needed(value, name)?;
        *number = value
            .trim()
            .parse()
            .map_err(|_| vertex.error(format!("`{}` is not a number", shortened(&value))))?;
        if !number.is_finite() {
            let what = format!("a vertex has the coordinate {}", shortened(&value));
            return Err(vertex.error(what));
        }
    }
    Ok(DVec3::from(numbers))
}
