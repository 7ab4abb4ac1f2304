//! Meshes become files: STL and PLY (binary), OBJ with MTL, GLB and 3MF.
//!
//! What is written is closed where the mesh is. Every vertex is rounded once, wherever it occurs, and triangles that have a corner twice
//! afterwards are left out: both change which vertices are one, and nothing about which edges are closed. OBJ, PLY and 3MF hold the
//! f64s of the mesh; STL and GLB hold f32, which moves a vertex by up to 6e-8 of its largest coordinate.
//!
//! | format | parts | names | colours | caps |
//! |---|---|---|---|---|
//! | STL | one after the other | no | no | no |
//! | PLY | `part` of each face | comments | of each face, also those of vertices | `cap` of each face |
//! | OBJ | `o` | yes | MTL | a group `NAME_cap` with a material of its own |
//! | GLB | nodes | yes | materials | a primitive with a material of its own |
//! | 3MF | objects | yes | base materials | triangles with a base material of their own |
//!
//! Cost: one pass over the triangles, and the file in memory.

mod glb;
mod obj;
mod ply;
mod stl;
mod threemf;
mod zip;

use glam::Vec3;

use crate::scene::{Mesh, Part};
use crate::slice::Half;

/// A solid that is to be written.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    /// Its name.
    pub name: &'a str,
    /// Colour of its faces, sRGB in 0..=1.
    pub color: Vec3,
    /// Colours of single faces, sRGB, where they have them.
    pub face_colors: Option<Vec<[u8; 3]>>,
    /// Colour of its caps.
    pub cap_color: Vec3,
    /// Faces, then caps.
    pub mesh: &'a Mesh,
    /// How many triangles are faces.
    pub faces: usize,
}

impl<'a> Solid<'a> {
    /// A half of a part, in the colours of the part. Of a face whose vertices have colours it is their mean; images are left out.
    pub fn of(part: &'a Part, half: &'a Half) -> Self {
        let coat = part.mesh.coat.as_ref();
        let coat = coat.filter(|c| !part.material.is_painted_over && c.images.is_empty());
        let mean = |corners: [[u8; 4]; 3]| {
            [0, 1, 2].map(|i| (corners.map(|c| u32::from(c[i])).iter().sum::<u32>() / 3) as u8)
        };
        Self {
            name: &part.name,
            color: part.material.color,
            face_colors: coat.map(|coat| {
                let of_source = |s: &u32| mean(coat.triangles[*s as usize].colors);
                half.sources.iter().map(of_source).collect()
            }),
            cap_color: part.material.cap_color(),
            mesh: &half.mesh,
            faces: half.surface_triangles(),
        }
    }
}

/// How a mesh is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Binary STL.
    Stl,
    /// Binary PLY, little-endian.
    Ply,
    /// Wavefront OBJ with its material library.
    Obj,
    /// Binary glTF 2.0.
    Glb,
    /// 3D Manufacturing Format.
    ThreeMf,
}

impl Format {
    /// All, by the extensions of their files.
    pub const BY_EXTENSION: [(&'static str, Self); 5] = [
        ("stl", Self::Stl),
        ("ply", Self::Ply),
        ("obj", Self::Obj),
        ("glb", Self::Glb),
        ("3mf", Self::ThreeMf),
    ];

    /// The format of an extension, in letters of any case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        let mut all = Self::BY_EXTENSION.iter();
        let found = all.find(|(known, _)| extension.eq_ignore_ascii_case(known));
        found.map(|(_, format)| *format)
    }
}

/// The bytes of a file of some solids, which is called `stem` but for its extension. A unit is one of 3MF: `millimeter`, `meter`, `inch`.
pub fn encoded(format: Format, solids: &[Solid<'_>], stem: &str, unit: &str) -> Vec<u8> {
    match format {
        Format::Stl => stl::encoded(solids),
        Format::Ply => ply::encoded(solids),
        Format::Obj => obj::encoded(solids, stem).into_bytes(),
        Format::Glb => glb::encoded(solids),
        Format::ThreeMf => threemf::encoded(solids, unit),
    }
}

/// The bytes of a PLY file of a mesh alone, without a name and without colours, as [`load`](crate::load) reads it back to the last bit.
pub fn plain_ply(mesh: &Mesh) -> Vec<u8> {
    ply::plain(mesh)
}

/// The material library of an OBJ file.
pub fn material_library(solids: &[Solid<'_>]) -> Vec<u8> {
    obj::material_library(solids).into_bytes()
}

/// A colour of three bytes.
fn bytes_of(color: Vec3) -> [u8; 3] {
    color
        .to_array()
        .map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
}
