//! Cutters: closed meshes whose interior a cut removes.
//!
//! Parity decides: a point is inside if a ray from it crosses the mesh an odd number of times. Solids from one file are counted
//! together, so where two of them overlap nothing is removed; the orientation of faces does not matter.
//!
//! A cutter must be closed: each edge has an even number of faces. With an open mesh, parity would remove infinitely long streaks, which a
//! frame could not distinguish from intended cuts. An open part is drawn with doubtful pixels marked; an open cutter is refused on loading.

use std::sync::Arc;

use glam::DAffine3;

use crate::error::{Error, Result};
use crate::scene::meshes::topology::Edges;
use crate::scene::units::range;
use crate::scene::{Bounds, Mesh, Part};

/// Returns the reason if the bounds of a cutter are too large to draw with a model.
pub fn too_far(cutter: &Bounds, model: &Bounds) -> Option<String> {
    if !cutter.size().length().is_finite() {
        return Some("reaches to infinity".to_owned());
    }
    let middle = model.centre();
    let reach = (cutter.min - middle).abs().max((cutter.max - middle).abs());
    range::beside(reach.max_element(), model).map(|what| format!("reaches {what},"))
}

/// A closed mesh placed in the world.
#[derive(Clone, Debug)]
pub struct Cutter {
    name: String,
    mesh: Arc<Mesh>,
    /// Placement.
    pub world_from_cutter: DAffine3,
    /// True if the outside is removed and the inside kept.
    pub keeps_inside: bool,
    /// True if its walls are shaded smoothly across edges that turn by less than
    /// [`DEFAULT_CREASE_DEG`](crate::scene::DEFAULT_CREASE_DEG). This affects only the normals of caps.
    pub is_smooth: bool,
}

impl Cutter {
    /// A cutter from a mesh, at the mesh's own position; an error if the mesh cannot be a cutter.
    pub fn new(name: impl Into<String>, mesh: impl Into<Arc<Mesh>>) -> Result<Self> {
        let (name, mesh) = (name.into(), mesh.into());
        if let Some(defect) = mesh.defect() {
            let help = "use a mesh with finite vertices and valid triangles";
            return Err(Error::input(name, defect.to_string(), help));
        }
        let open = Edges::of(&mesh.triangles).count().open;
        if open > 0 {
            let what = format!(
                "a cutter must be closed, but {open} edges of its {} triangles have an odd number of faces",
                mesh.triangles.len()
            );
            let help =
                "close the holes (`cutaway inspect` says where they are), or use another mesh";
            return Err(Error::input(name, what, help));
        }
        Ok(Self {
            name,
            mesh,
            world_from_cutter: DAffine3::IDENTITY,
            keeps_inside: false,
            is_smooth: false,
        })
    }

    /// A cutter from solids as they are placed in the world.
    pub fn from_parts(name: impl Into<String>, parts: &[Part]) -> Result<Self> {
        let mut all = Mesh::default();
        for part in parts {
            let (mesh, place) = (part.posed_mesh(), part.world_from_part);
            let first = all.positions.len() as u32;
            let placed = mesh.positions.iter().map(|p| place.transform_point3(*p));
            all.positions.extend(placed);
            let triangles = mesh.triangles.iter().map(|t| t.map(|i| i + first));
            all.triangles.extend(triangles);
        }
        Self::new(name, all)
    }

    /// The same cutter, with another placement applied after its own.
    #[must_use]
    pub fn placed(mut self, placement: DAffine3) -> Self {
        self.world_from_cutter = placement * self.world_from_cutter;
        self
    }

    /// The same cutter with removed and kept sides exchanged.
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.keeps_inside = !self.keeps_inside;
        self
    }

    /// The same cutter; an error if it reaches farther than can be drawn with a model of these bounds.
    pub fn beside(self, model: &Bounds) -> Result<Self> {
        match too_far(&self.bounds_in_world(), model) {
            Some(what) => {
                let what = format!("it {} as a cutter", what.trim_end_matches(','));
                Err(Error::input(self.name, what, "scale it down"))
            }
            None => Ok(self),
        }
    }

    /// Name of the file or shape.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its boundary, a closed mesh.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// Bounds of the placed mesh.
    pub fn bounds_in_world(&self) -> Bounds {
        let positions = self.mesh.positions.iter();
        Bounds::from_points(positions.map(|p| self.world_from_cutter.transform_point3(*p)))
    }
}
