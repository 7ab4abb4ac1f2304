//! Scene description: parts, clip-surfaces, cuts and the camera.
//!
//! Spaces. *Part* space is that of the mesh file; *world* space is the user's, in f64; *scene* space is world space
//! recentred and scaled by a power of two so that everything fits in a ball of radius 1 (see [`Prepared`]). The GPU and
//! the exact reference both start from the f32 vertices of [`Prepared`], so both evaluate the same geometry.

mod bodies;
mod clip;
mod coincidence;
mod contents;
mod cutaway;
pub mod describe;
mod doubts;
mod fill;
mod geometry;
mod materials;
#[doc(hidden)]
pub mod memo;
pub(crate) mod meshes;
#[doc(hidden)]
pub mod motion;
mod part;
mod posed_part;
mod prepared;
pub mod relief;
pub mod style;
pub(crate) mod units;
mod viewing;
#[doc(hidden)]
pub mod winding;

pub use bodies::Bodies;
#[doc(hidden)]
pub use bodies::{GeometryId, Pieces, body_name};
pub use clip::clip_surface::{ClipSurface, SurfaceFrame};
#[doc(hidden)]
pub use clip::cut::glob_matches;
pub use clip::cut::{Cut, Offset};
pub use clip::cutter::Cutter;
#[doc(hidden)]
pub use clip::cutter::too_far;
pub use clip::height_filter::HeightFilter;
pub use clip::offset_map::{OffsetMap, Wrap};
pub use clip::plane_spec::PlaneSpec;
#[doc(hidden)]
pub use clip::regions::in_common;
pub use clip::regions::{Block, RegionFace, Wedge, next_axis};
#[doc(hidden)]
pub use coincidence::coincide::lies_in;
pub(crate) use coincidence::contacts::{classes, contacts};
pub(crate) use coincidence::faces_in_plane::{Candidates, FacesInPlane, plane_tolerance};
pub use coincidence::flat_surface::{FlatSurface, Side};
pub use coincidence::preclassified::PreclassifiedTriangle;
#[doc(hidden)]
pub use coincidence::shared_planes::SharedPlanes;
pub use contents::Scene;
#[doc(hidden)]
pub use cutaway::KeptHulls;
pub(crate) use cutaway::is_removed_whole;
pub use cutaway::{
    AxisRule, Breakaway, BreakawayView, Clusters, CutoutFrame, MainAxes, Sight, sights,
};
pub use doubts::doubts;
#[doc(hidden)]
pub use doubts::{empty_picture, misses};
pub use fill::Fill;
pub use geometry::bounds::Bounds;
#[doc(hidden)]
pub use geometry::fitting::{distance_around, half_height_around};
pub use materials::cap_material::{CapMaterial, SolidTexture};
pub use materials::color::parse_color;
#[doc(hidden)]
pub use materials::color::{color_help, linear_from_srgb, map_channels, srgb_from_linear};
pub use materials::hatch_pattern::{CapHatch, Dash, HatchPattern, LineFamily, MOST_STROKES};
pub use materials::material::Material;
pub use materials::texture::{MOST_TEXELS_ALONG, Texture, TextureKind};
pub use materials::vertex_paint::{TexturedTriangle, VertexPaint};
#[doc(hidden)]
pub use meshes::base::standing_up;
pub(crate) use meshes::doubled::doubled_faces;
pub(crate) use meshes::filled_part::FilledPart;
pub use meshes::mesh::{Mesh, MeshDefect};
pub use meshes::smooth::{DEFAULT_CREASE_DEG, Faces, ShadingMesh};
#[doc(hidden)]
pub use meshes::topology;
#[doc(hidden)]
pub use meshes::topology::Edges;
pub use meshes::topology::{DepthComplexity, Extent, Topology};
#[doc(hidden)]
pub use meshes::triangle::longest_edge;
#[doc(hidden)]
pub use meshes::weld;
#[doc(hidden)]
pub use motion::{Axis, Clip, Deformer, Driver, JointWeight, Motion, MotionDefect, Pose};
#[doc(hidden)]
pub use part::who_wins;
pub use part::{Part, Role};
#[doc(hidden)]
pub use posed_part::Outwards;
pub use prepared::{
    Prepared, PreparedCut, PreparedPart, PreparedSurface, PreparedVolume, SceneSpace,
};
pub(crate) use prepared::{facing_out, tolerance_of};
pub use style::Style;
pub use units::amount::Amount;
pub use units::decimals::to_decimals;
pub use units::length_unit::LengthUnit;
#[doc(hidden)]
pub use units::numbers;
#[doc(hidden)]
pub use units::range;
pub use viewing::camera::{Camera, Fit, Projection, STANDARD_VIEWS, Viewpoint};
pub use viewing::host_view::HostDepth;
pub use viewing::outline::Outline;
pub use viewing::up::Up;
pub use viewing::view::{Precision, USUAL_SUB_PIXEL_BITS, View};
