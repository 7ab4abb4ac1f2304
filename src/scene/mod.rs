//! What is cut: parts, clip-surfaces, cuts and the camera.
//!
//! Spaces. *Part* space is that of the mesh file; *world* space is the user's, in f64; *scene* space is world space
//! recentred and scaled by a power of two so that everything fits in a ball of radius 1 (see [`Prepared`]). The GPU and
//! the exact reference both start from the f32 vertices of [`Prepared`], so they are asked the same question.

mod base;
mod bodies;
mod bounds;
mod camera;
mod cap_material;
mod clip_surface;
mod coat;
mod coincide;
mod color;
mod color_names;
mod contacts;
mod cut;
mod cutaway;
mod cutter;
mod decimals;
mod doubled;
mod doubts;
mod exact_sum;
mod faces_in_plane;
mod facing;
mod fill;
mod fitting;
mod grown;
mod hatch_pattern;
mod height_filter;
mod host_view;
mod hull;
mod length_unit;
mod material;
mod mesh;
#[doc(hidden)]
pub mod motion;
#[doc(hidden)]
pub mod numbers;
mod offset_map;
mod outline;
mod part;
mod plane_spec;
mod prepared;
#[doc(hidden)]
pub mod range;
mod regions;
pub mod relief;
mod settled;
mod shared_planes;
mod smooth;
pub mod style;
mod texture;
#[doc(hidden)]
pub mod topology;
pub(crate) mod tree;
mod triangle;
mod upright;
mod view;
#[doc(hidden)]
pub mod weld;

use std::borrow::Cow;
use std::sync::Arc;

#[doc(hidden)]
pub use base::standing_up;
pub use bodies::Bodies;
#[doc(hidden)]
pub use bodies::{Pieces, body_name};
pub use bounds::Bounds;
pub use camera::{Camera, Fit, Projection, STANDARD_VIEWS, Up, Viewpoint};
pub use cap_material::{CapMaterial, SolidTexture};
pub use clip_surface::{ClipSurface, SurfaceFrame};
pub use coat::{Coat, CoatedTriangle};
#[doc(hidden)]
pub use coincide::lies_in;
pub use color::parse_color;
#[doc(hidden)]
pub use color::{color_help, linear_from_srgb, map_channels, srgb_from_linear};
pub(crate) use contacts::{classes, contacts};
#[doc(hidden)]
pub use cut::glob_matches;
pub use cut::{Cut, Offset};
pub(crate) use cutaway::is_removed_whole;
pub use cutaway::{
    AxisRule, Breakaway, BreakawayView, Clusters, CutoutFrame, MainAxes, Sight, sights,
};
pub use cutter::Cutter;
#[doc(hidden)]
pub use cutter::too_far;
pub use decimals::to_decimals;
pub(crate) use doubled::doubled_faces;
pub use doubts::{Remark, doubts};
#[doc(hidden)]
pub use doubts::{empty_picture, misses};
pub(crate) use faces_in_plane::{Candidates, FacesInPlane, plane_tolerance};
pub use fill::Fill;
#[doc(hidden)]
pub use fitting::{distance_around, half_height_around};
pub(crate) use grown::Grown;
pub use hatch_pattern::{CapHatch, Dash, HatchPattern, LineFamily, MOST_STROKES};
pub use height_filter::HeightFilter;
pub use host_view::HostDepth;
pub use length_unit::LengthUnit;
pub use material::Material;
pub use mesh::{Mesh, MeshDefect};
pub use motion::{Axis, Clip, Deformer, Driver, Motion, MotionDefect, Pose, Pull};
#[doc(hidden)]
pub use motion::{Outwards, is_same_motion};
pub use offset_map::{OffsetMap, Wrap};
pub use outline::Outline;
#[doc(hidden)]
pub use part::who_wins;
pub use part::{Part, Role};
pub use plane_spec::{Amount, PlaneSpec};
pub use prepared::{
    Prepared, PreparedCut, PreparedPart, PreparedSurface, PreparedVolume, SceneSpace,
};
pub(crate) use prepared::{facing_out, tolerance_of};
#[doc(hidden)]
pub use regions::in_common;
pub use regions::{Block, Face, Wedge, next_axis};
pub use settled::{FlatSurface, Settled, Side};
#[doc(hidden)]
pub use shared_planes::SharedPlanes;
pub use smooth::{DEFAULT_CREASE_DEG, Faces, ShadingMesh};
pub use style::Style;
pub use texture::{MOST_TEXELS_ALONG, Texture, TextureKind};
#[doc(hidden)]
pub use topology::Edges;
pub use topology::{DepthComplexity, Extent, Topology};
#[doc(hidden)]
pub use triangle::longest_edge;
pub use view::{Precision, USUAL_SUB_PIXEL_BITS, View};

/// Everything a frame shows, in world space.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Name for reports: the file's stem or the shape's name.
    pub name: String,
    /// The solids.
    pub parts: Vec<Part>,
    /// Removed regions; the scene removes their union.
    pub cuts: Vec<Cut>,
    /// Where it is seen from.
    pub camera: Camera,
    /// The box that the scene is framed, scaled and sectioned by; `None` is that of its parts. An animation has one for all
    /// its times, so that pictures do not jump.
    pub stage: Option<Bounds>,
    /// What a camera is fitted to that shows what is kept; `None` is what is kept now. An animation has one for all its times.
    pub outline: Option<Arc<Outline>>,
    /// Hatches caps that several solids share, in this colour (sRGB, 0 to 1).
    pub interference: Option<glam::Vec3>,
    /// How it looks.
    pub style: Style,
}

impl Scene {
    /// The stage, or else the bounds of all parts in world space.
    pub fn bounds(&self) -> Bounds {
        self.stage.unwrap_or_else(|| self.bounds_of_parts())
    }

    /// What the camera is fitted to, where that is not the box of the scene.
    #[doc(hidden)]
    pub fn fitted_outline(&self) -> Option<Arc<Outline>> {
        let own = || self.outline.clone();
        let now = || Arc::new(Outline::of(self));
        self.camera.fits_kept().then(|| own().unwrap_or_else(now))
    }

    /// The same scene with every pose baked into its mesh in f64, on the same stage. Ranks may differ, for the volumes of
    /// meshes do: [`Prepared::new`] poses by itself and keeps them.
    #[must_use]
    pub fn posed(&self) -> Self {
        let mut posed = self.clone();
        posed.stage = Some(self.bounds());
        for part in &mut posed.parts {
            if let Cow::Owned(mut mesh) = part.posed_mesh() {
                mesh.coat.clone_from(&part.mesh.coat);
                part.mesh = Arc::new(mesh);
            }
            part.motion = None;
            part.driver = None;
            part.pose = Pose::default();
        }
        posed
    }

    /// Bounds of all parts in world space.
    pub fn bounds_of_parts(&self) -> Bounds {
        self.parts
            .iter()
            .map(Part::bounds_in_world)
            .fold(Bounds::EMPTY, Bounds::union)
    }
}
