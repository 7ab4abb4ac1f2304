//! `[[part]]`.

use std::path::PathBuf;

use cutaway::scene::describe::{Described, ValueType, words};
use cutaway::scene::range::SMALLEST;
use cutaway::scene::{Amount, Fill, Role, SolidTexture};
use glam::Vec3;

use super::{ByHand, PlacementDesc};

/// A part as stored in a file. Its lists of defects and deformers are read separately.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct PartDesc {
    /// Name that paths and globs use for the part.
    #[value(example = "crank")]
    pub(crate) name: Option<String>,
    /// Includes the part in the scene.
    #[value(example = true)]
    pub(crate) enabled: Option<bool>,
    /// Mesh file, or a pattern for numbered frames such as "walk_%04d.ply".
    #[value(example = "crank.obj")]
    pub(crate) mesh: Option<PathBuf>,
    /// Built-in shape, as text or as a table with its name and parameters.
    #[value(takes = ValueType::Text, example = "crank?throws=3")]
    pub(crate) shape: ByHand,
    /// Makes each connected body a separate part, named NAME/1, NAME/2, ...
    #[value(fixed, example = true)]
    pub(crate) split: bool,
    /// Closes planar and small holes of the mesh.
    #[value(fixed, example = true)]
    pub(crate) close_holes: bool,
    /// Globs of the solids to take from the file; with `split`, globs of the bodies.
    #[value(example = ["gear*"])]
    pub(crate) only: Vec<String>,
    /// Globs of the solids to leave out; with `split`, globs of the bodies.
    #[value(example = ["bolt*"])]
    pub(crate) except: Vec<String>,
    /// Frames per second.
    #[value(range = SMALLEST.., unit = "1/s", fixed, example = 24)]
    pub(crate) fps: Option<f64>,
    /// Number of the first frame.
    #[value(fixed, example = 1)]
    pub(crate) first: Option<u32>,
    /// Repeats the frames.
    #[value(key = "loop", fixed, example = false)]
    pub(crate) loops: Option<bool>,
    /// Placement of the mesh.
    #[value(flat)]
    pub(crate) placement: PlacementDesc,
    /// Role in cuts: interior and whole parts are never cut, but whole parts that lie entirely in the removed region are hidden.
    #[value(example = "interior")]
    pub(crate) role: Option<Role>,
    /// Where solids overlap, the part with the higher priority is shown.
    #[value(example = 1)]
    pub(crate) priority: Option<i32>,
    /// Fill rule of the mesh.
    #[value(example = "nonzero")]
    pub(crate) fill: Option<Fill>,
    /// Colours, hatch and textures.
    #[value(table)]
    pub(crate) material: MaterialDesc,
}

/// The material of a part.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct MaterialDesc {
    /// Colour of the surface.
    #[value(example = "#8a94a6")]
    pub(crate) color: Option<Vec3>,
    /// Colour of caps.
    #[value(example = "#d9773f")]
    pub(crate) cap_color: Option<Vec3>,
    /// Hatch of caps: general, none, solid, the name of a material, or mine.pat#NAME for a pattern from a file.
    #[value(example = "steel")]
    pub(crate) hatch: Option<String>,
    /// Textures of caps.
    #[value(table)]
    pub(crate) cap: CapMaterialDesc,
}

/// Textures of caps.
#[derive(Clone, Debug, Default, PartialEq, Described)]
pub(crate) struct CapMaterialDesc {
    /// Colour texture of caps, placed by the (u, v) coordinates of the clip-surface.
    #[value(example = "rust.png")]
    pub(crate) diffuse: Option<PathBuf>,
    /// Normal map of caps, which is combined with the normals of the relief.
    #[value(example = "grain.png")]
    pub(crate) normal: Option<PathBuf>,
    /// Light map of caps.
    #[value(example = "soft.png")]
    pub(crate) light: Option<PathBuf>,
    /// Procedural solid texture of caps.
    #[value(choice = words(&SolidTexture::NAMED), example = "marble")]
    pub(crate) solid: Option<String>,
    /// Pattern for numbered slice images that fill the part's box, as an alternative to `solid`.
    #[value(example = "slices/%03d.png")]
    pub(crate) images: Option<PathBuf>,
    /// Length after which a texture repeats; without it, images are placed like the relief.
    #[value(range = SMALLEST.., unit = "units", fixed, example = "10%")]
    pub(crate) size: Option<Amount>,
}
