//! The meshes of the hard cases.

pub(crate) use cutaway_lab::hard_cases::meshes::*;

/// Every kind of shape, in small detail: the number of triangles changes nothing about which pixels are right.
pub(crate) const SHAPES: [&str; 11] = [
    "cube",
    "sphere?subdivisions=3",
    "torus?segments=40&sides=20",
    "knot?segments=160&sides=12",
    "comb?teeth=8",
    "sponge?level=2",
    "earth?subdivisions=3",
    "shells?subdivisions=3",
    "gears?flank=2",
    "conduit?segments=16&sides=24",
    "crank?throws=2&detail=16",
];
