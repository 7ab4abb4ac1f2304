//! Writes mesh files (binary STL and PLY, OBJ with MTL, GLB and 3MF), and files of [sections](section) (SVG, DXF and JSON).
//!
//! The output is closed if the mesh is closed. Every vertex is rounded once, and triangles in which two corners then coincide are left out.
//! This may merge vertices, but does not open edges. OBJ, PLY and 3MF hold the mesh's f64 values. STL and GLB hold f32, which moves a
//! vertex by up to 6e-8 of its largest coordinate ([`rounding`]). In GLB, a solid that is far from the origin relative to its size has
//! coordinates relative to its node. Axes are not rotated, so the mesh keeps its model's up axis, +Z or +Y.
//!
//! | format | parts | names | colours | caps |
//! |---|---|---|---|---|
//! | STL | one after the other | no | no | no |
//! | PLY | `part` per face | comments | per face, per vertex if vertices have colours, images | `cap` per face |
//! | OBJ | `o` | yes | MTL, images, and vertex colours after the coordinates | a group `NAME_cap` with its own material |
//! | GLB | nodes | yes | materials, vertices, images | a primitive with its own material |
//! | 3MF | objects | yes | base materials, corner colours, images | triangles with their own base material |
//!
//! GLB, PLY and OBJ write one vertex for each distinct corner colour at a position, and readers can merge them. Images are PNGs, embedded
//! in GLB and 3MF, and separate files for PLY and OBJ. [`leaves_out`] names data that a format cannot hold.
//!
//! Cost: one pass over the triangles. The files are held in memory.

mod glb;
mod images;
mod obj;
mod painted;
mod ply;
pub mod section;
mod solid;
mod stl;
mod threemf;
mod zip;

use cutaway::scene::{LengthUnit, Mesh, TexturedTriangle};
use glam::DVec3;

pub use solid::{EncodedMesh, Solid, Unwritable};

/// Format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
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

impl MeshFormat {
    /// All formats, by file extension.
    pub const BY_EXTENSION: [(&'static str, Self); 5] = [
        ("stl", Self::Stl),
        ("ply", Self::Ply),
        ("obj", Self::Obj),
        ("glb", Self::Glb),
        ("3mf", Self::ThreeMf),
    ];

    /// Returns the format for a file extension, ignoring case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        let mut all = Self::BY_EXTENSION.iter();
        let found = all.find(|(known, _)| extension.eq_ignore_ascii_case(known));
        found.map(|(_, format)| *format)
    }

    /// Names of the files that may accompany a mesh file. `stem` is its name without extension, `images` the number of images.
    pub fn beside(self, stem: &str, images: usize) -> Vec<String> {
        let library = (self == Self::Obj).then(|| obj::library_name(stem));
        let images = match self {
            Self::Ply | Self::Obj => images,
            Self::Stl | Self::Glb | Self::ThreeMf => 0,
        };
        let images = (0..images).map(|i| images::file_name(stem, i));
        library.into_iter().chain(images).collect()
    }
}

/// Encodes solids as a file named `stem` plus the extension. Only 3MF states the unit.
///
/// # Errors
///
/// Each variant of [`Unwritable`] is a possible error.
pub fn encoded(
    format: MeshFormat,
    solids: &[Solid<'_>],
    stem: &str,
    unit: LengthUnit,
) -> Result<EncodedMesh, Unwritable> {
    let is_of_f32 = matches!(format, MeshFormat::Stl | MeshFormat::Glb);
    let mut positions = solids.iter().flat_map(|s| &s.mesh.positions);
    if is_of_f32 && positions.any(|p| !p.as_vec3().is_finite()) {
        return Err(Unwritable::Infinite);
    }
    match format {
        MeshFormat::Stl => stl::encoded(solids).map(EncodedMesh::alone),
        MeshFormat::Ply => ply::encoded(solids, stem),
        MeshFormat::Obj => obj::encoded(solids, stem),
        MeshFormat::Glb => glb::encoded(solids).map(EncodedMesh::alone),
        MeshFormat::ThreeMf => threemf::encoded(solids, unit).map(EncodedMesh::alone),
    }
}

/// The largest distance, in model units, by which writing a format moves a vertex along an axis. Returns `None` for formats that hold f64.
pub fn rounding(format: MeshFormat, solids: &[Solid<'_>]) -> Option<f64> {
    let origin = |solid: &Solid<'_>| match format {
        MeshFormat::Stl => Some(DVec3::ZERO),
        MeshFormat::Glb => Some(glb::origin(solid.mesh)),
        MeshFormat::Ply | MeshFormat::Obj | MeshFormat::ThreeMf => None,
    };
    let mut most = None;
    for solid in solids {
        let origin = origin(solid)?;
        for at in solid.mesh.positions.iter().map(|p| *p - origin) {
            let moved = (at.as_vec3().as_dvec3() - at).abs().max_element();
            most = Some(moved.max(most.unwrap_or(0.0)));
        }
    }
    most
}

/// Names the colours and images of solids that a format cannot hold. Returns `None` if it can hold all.
pub fn leaves_out(format: MeshFormat, solids: &[Solid<'_>]) -> Option<&'static str> {
    let mut vertex_paints = solids.iter().filter_map(|s| s.vertex_paint.as_ref());
    let are_both = |face: &TexturedTriangle| face.image.is_some() && face.has_colors();
    match format {
        MeshFormat::Glb | MeshFormat::Ply | MeshFormat::Obj => None,
        MeshFormat::Stl => {
            (vertex_paints.next().is_some()).then_some("colours of vertices and images")
        }
        // If a triangle has both a vertex colour and an image, only the image is written.
        MeshFormat::ThreeMf => (vertex_paints
            .any(|vertex_paint| vertex_paint.triangles.iter().any(are_both)))
        .then_some("colours of vertices under the images"),
    }
}

/// Encodes a mesh as PLY, without name and colours. [`load`](crate::load) reads it back bit-exactly.
pub fn plain_ply(mesh: &Mesh) -> Vec<u8> {
    ply::plain(mesh)
}
