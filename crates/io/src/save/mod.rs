//! Meshes become files: STL and PLY (binary), OBJ with MTL, GLB and 3MF. So do [sections](section): SVG, DXF and JSON.
//!
//! What is written is closed where the mesh is. Every vertex is rounded once, wherever it occurs, and triangles that have a corner twice
//! afterwards are left out: both change which vertices are one, and nothing about which edges are closed. OBJ, PLY and 3MF hold the
//! f64s of the mesh; STL and GLB hold f32, which moves a vertex by up to 6e-8 of its largest coordinate ([`rounding`]). In GLB a solid
//! that is far from the origin for its size lies around the origin of its own node. No axis is turned: a mesh has the axes of its model, +Z
//! up or +Y.
//!
//! | format | parts | names | colours | caps |
//! |---|---|---|---|---|
//! | STL | one after the other | no | no | no |
//! | PLY | `part` of each face | comments | of each face, of vertices where vertices have some, images | `cap` of each face |
//! | OBJ | `o` | yes | MTL, images, and behind the coordinates of vertices that have some | a group `NAME_cap` with a material of its own |
//! | GLB | nodes | yes | materials, vertices, images | a primitive with a material of its own |
//! | 3MF | objects | yes | base materials, colours of corners, images | triangles with a base material of their own |
//!
//! Where vertices have colours, GLB, PLY and OBJ have a vertex for each colour that corners have in one place: readers join them by their
//! places. Images are PNGs: within GLB and 3MF, beside PLY and OBJ. What a format does not hold, [`leaves_out`] says.
//!
//! Cost: one pass over the triangles, and the files in memory.

mod glb;
mod images;
mod obj;
mod painted;
mod ply;
pub mod section;
mod stl;
mod threemf;
mod zip;

use cutaway::scene::{Coat, CoatedTriangle, LengthUnit, Mesh, Part};
use cutaway::slice::Half;
use glam::{DVec3, Vec3};

/// A solid that is to be written.
#[derive(Clone, Debug)]
pub struct Solid<'a> {
    /// Its name.
    pub name: &'a str,
    /// Colour of its faces, sRGB in 0..=1.
    pub color: Vec3,
    /// What colours its faces have besides, where they have some.
    pub coat: Option<Coat>,
    /// Colour of its caps.
    pub cap_color: Vec3,
    /// Faces, then caps.
    pub mesh: &'a Mesh,
    /// How many triangles are faces.
    pub faces: usize,
}

impl<'a> Solid<'a> {
    /// A half of a part, in the colours of the part.
    pub fn of(part: &'a Part, half: &'a Half) -> Self {
        Self {
            name: &part.name,
            color: part.material.color,
            coat: painted::coat_of(part, half),
            cap_color: part.material.cap_color(),
            mesh: &half.mesh,
            faces: half.surface_triangles(),
        }
    }

    /// The colours and images of a face; none of a cap, nor where the solid has none.
    fn face(&self, triangle: usize) -> Option<&CoatedTriangle> {
        self.coat.as_ref()?.triangles.get(triangle)
    }

    /// Whether corners have colours of their own, by which images are multiplied.
    fn has_colors(&self) -> bool {
        let mut faces = self.coat.iter().flat_map(|coat| &coat.triangles);
        faces.any(CoatedTriangle::has_colors)
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

    /// The names of the files that may lie beside one that is called `stem` but for its extension, of solids with so many images.
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

/// A mesh file, and the files that it names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoded {
    /// Its bytes.
    pub file: Vec<u8>,
    /// Names and bytes of the files that belong into the same folder, of those that [`Format::beside`] names.
    pub beside: Vec<(String, Vec<u8>)>,
}

impl Encoded {
    fn alone(file: Vec<u8>) -> Self {
        let beside = Vec::new();
        Self { file, beside }
    }
}

/// Why solids cannot be written in a format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unwritable {
    /// No triangle is left: there is none, or all have corners that are one in f32.
    #[error("the numbers of the format are so coarse that no triangle is left of it")]
    Collapsed,
    /// Coordinates beyond what f32 holds, 3.4e38.
    #[error("the format has coordinates of 32 bits, and some are too large for that")]
    Infinite,
    /// Sizes and counts are numbers of 32 bits.
    #[error("the format holds at most 4 GiB")]
    TooLarge,
    /// An image could not be packed.
    #[error("an image of it cannot be written: {0}")]
    Image(String),
    /// The archive of 3MF could not be made.
    #[error("its archive cannot be made: {0}")]
    Archive(String),
}

/// A file of some solids, which is called `stem` but for its extension. Only 3MF says the unit.
///
/// # Errors
///
/// See [`Unwritable`].
pub fn encoded(
    format: Format,
    solids: &[Solid<'_>],
    stem: &str,
    unit: LengthUnit,
) -> Result<Encoded, Unwritable> {
    let is_of_f32 = matches!(format, Format::Stl | Format::Glb);
    let mut positions = solids.iter().flat_map(|s| &s.mesh.positions);
    if is_of_f32 && positions.any(|p| !p.as_vec3().is_finite()) {
        return Err(Unwritable::Infinite);
    }
    match format {
        Format::Stl => stl::encoded(solids).map(Encoded::alone),
        Format::Ply => ply::encoded(solids, stem),
        Format::Obj => obj::encoded(solids, stem),
        Format::Glb => glb::encoded(solids).map(Encoded::alone),
        Format::ThreeMf => threemf::encoded(solids, unit).map(Encoded::alone),
    }
}

/// The largest distance by which a vertex moves along an axis when it is written in a format, in units of the model; none in those that
/// hold the f64s.
pub fn rounding(format: Format, solids: &[Solid<'_>]) -> Option<f64> {
    let origin = |solid: &Solid<'_>| match format {
        Format::Stl => Some(DVec3::ZERO),
        Format::Glb => Some(glb::origin(solid.mesh)),
        Format::Ply | Format::Obj | Format::ThreeMf => None,
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

/// What of the looks of solids a format does not hold, in words; none where it holds all.
pub fn leaves_out(format: Format, solids: &[Solid<'_>]) -> Option<&'static str> {
    let mut coats = solids.iter().filter_map(|s| s.coat.as_ref());
    let are_both = |face: &CoatedTriangle| face.image.is_some() && face.has_colors();
    match format {
        Format::Glb | Format::Ply | Format::Obj => None,
        Format::Stl => (coats.next().is_some()).then_some("colours of vertices and images"),
        // Where both are, images count.
        Format::ThreeMf => (coats.any(|coat| coat.triangles.iter().any(are_both)))
            .then_some("colours of vertices under the images"),
    }
}

/// The corners of a triangle in f32; none where two of them are one.
fn rounded(positions: &[Vec3], triangle: &[u32; 3]) -> Option<[Vec3; 3]> {
    let [a, b, c] = triangle.map(|i| positions[i as usize]);
    (a != b && b != c && c != a).then_some([a, b, c])
}

/// The bytes of a PLY file of a mesh alone, without a name and without colours, as [`load`](crate::load) reads it back to the last bit.
pub fn plain_ply(mesh: &Mesh) -> Vec<u8> {
    ply::plain(mesh)
}

/// A colour of three bytes.
fn bytes_of(color: Vec3) -> [u8; 3] {
    color
        .to_array()
        .map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)
}
