//! What is cut: parts, clip-surfaces, cuts and the camera.
//!
//! Spaces. *Part* space is that of the mesh file; *world* space is the user's, in f64; *scene* space is world space
//! recentred and scaled by a power of two so that everything fits in a ball of radius 1 (see [`Prepared`]). The GPU and
//! the exact reference both start from the f32 vertices of [`Prepared`], so they are asked the same question.

mod bounds;
mod camera;
mod clip_surface;
mod cut;
mod file;
mod load;
mod material;
mod mesh;
mod offset_map;
mod part;
mod prepared;
pub mod relief;
mod section;
pub mod shapes;
mod smooth;
mod topology;
mod weld;

pub use bounds::Bounds;
pub use camera::{Camera, Pose, Projection, Up, View};
pub use clip_surface::{ClipSurface, SurfaceFrame};
pub use cut::Cut;
pub use file::{Key, OpenedMesh, SceneFile, load_scene_file};
pub use load::{Loaded, load_mesh_file, load_mesh_file_with};
pub use material::Material;
pub use mesh::{Mesh, MeshDefect};
pub use offset_map::{OffsetMap, Wrap};
pub use part::{Part, Role};
pub use prepared::{Prepared, PreparedCut, PreparedPart, PreparedSurface};
pub use relief::{ReliefSpec, apply_relief};
pub use section::{Amount, SectionSpec, section_misses, section_surface};
pub use smooth::{DEFAULT_CREASE_DEG, ShadingMesh};
pub use topology::{DepthComplexity, Extent, Topology};

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
}

impl Scene {
    /// Bounds of all parts in world space.
    pub fn bounds(&self) -> Bounds {
        self.parts
            .iter()
            .map(Part::bounds_in_world)
            .fold(Bounds::EMPTY, Bounds::union)
    }
}
