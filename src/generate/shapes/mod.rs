//! Built-in shapes: solids with known volumes, and the models pictured in the documentation.
//!
//! A shape is named by `NAME?param=value&param=value`. Each of its parts is a closed, consistently oriented surface
//! with outward normals and positions shared by index; the same spec gives the same mesh. Wherever a polyhedron has a
//! closed-form volume, a test compares the mesh with it.
//!
//! ```
//! let parts = cutaway::generate::shapes::shape("sphere?radius=2&subdivisions=4")?;
//! let ball = 32.0 / 3.0 * std::f64::consts::PI;
//! assert!((parts[0].mesh.volume() / ball - 1.0).abs() < 0.01);
//! # Ok::<(), cutaway::Error>(())
//! ```

mod blocks;
mod column;
mod crank;
mod engine;
mod fill;
mod gears;
mod house;
mod lathe;
mod milled;
mod outline;
mod round;
mod spec;
mod swept;
mod web;

pub use spec::{MOST_TRIANGLES, ShapeInfo, ShapeParameter};

use crate::error::did_you_mean;
use crate::scene::{Material, Mesh, Part};
use crate::{Error, Result};

/// All built-in shapes, in the order of help texts.
pub const SHAPES: &[ShapeInfo] = &[
    crank::CRANK,
    engine::ENGINE,
    blocks::CUBE,
    round::SPHERE,
    swept::TORUS,
    swept::KNOT,
    swept::CONDUIT,
    column::COLUMN,
    house::HOUSE,
    gears::GEARS,
    round::EARTH,
    round::SHELLS,
    blocks::SPONGE,
    blocks::COMB,
    round::SLIVERS,
];

/// The parts of a built-in shape: `NAME` or `NAME?param=value&param=value`, with or without a leading `shape:`.
pub fn shape(spec: &str) -> Result<Vec<Part>> {
    let (info, query) = found(spec)?;
    info.build(query)
}

/// Checks a [`shape`] spec, its parameters and its size without building it. Errors that only occur while building are not found.
pub fn check(spec: &str) -> Result<()> {
    let (info, query) = found(spec)?;
    info.checked(query).map(|_| ())
}

fn found(spec: &str) -> Result<(&'static ShapeInfo, &str)> {
    let spec = spec.strip_prefix("shape:").unwrap_or(spec);
    let (name, query) = spec.split_once('?').unwrap_or((spec, ""));
    match SHAPES.iter().find(|s| s.name == name) {
        Some(info) => Ok((info, query)),
        None => Err(Error::input(
            format!("shape:{name}"),
            "there is no such built-in shape",
            did_you_mean(name, SHAPES.iter().map(|s| s.name)),
        )),
    }
}

/// Parts from several named meshes, each in its own colour.
fn parts_of<const N: usize>(named: [(&str, Mesh); N]) -> Vec<Part> {
    named
        .into_iter()
        .enumerate()
        .map(|(index, (name, mesh))| Part {
            material: Material::of_index(index),
            ..Part::new(name, mesh)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_have_the_triangles_they_announce() {
        for (name, queries) in [
            ("cube", ["", "divisions=7"]),
            ("sphere", ["", "subdivisions=0"]),
            ("torus", ["", "segments=5&sides=9"]),
            ("knot", ["", "segments=99&sides=3"]),
            ("conduit", ["", "segments=1&sides=5"]),
            ("earth", ["", "subdivisions=2"]),
            ("shells", ["", "subdivisions=3"]),
            ("sponge", ["", "level=0"]),
            ("comb", ["", "teeth=1"]),
            ("slivers", ["", "needles=3"]),
            ("conduit", ["inside=3", "inside=1&segments=1"]),
            // For the shapes from here on, the announced count is an upper bound.
            ("engine", ["", "cylinders=1&detail=16"]),
            ("column", ["", "flutes=4&detail=2"]),
            ("house", ["", "wall=0.14"]),
            ("crank", ["", "throws=1&detail=16"]),
            ("crank", ["throws=12&detail=24", "throws=2&detail=300"]),
            ("gears", ["", "flank=1&wheel=17&pinion=17"]),
            (
                "gears",
                ["flank=64&bore=0.01", "wheel=400&pinion=17&bore=0.7"],
            ),
        ] {
            let info = SHAPES.iter().find(|s| s.name == name).unwrap();
            for query in queries {
                let announced = (info.triangles)(&info.values(query).unwrap());
                let parts = info.build(query).unwrap();
                let actual: usize = parts.iter().map(|p| p.mesh.triangles.len()).sum();
                let ratio = actual as f64 / announced;
                let fits = match name {
                    "crank" | "gears" | "engine" | "column" | "house" => {
                        (0.1..=1.0).contains(&ratio)
                    }
                    _ => actual as f64 == announced,
                };
                assert!(
                    fits,
                    "{name}?{query}: {announced} announced, {actual} built"
                );
            }
        }
    }
}
