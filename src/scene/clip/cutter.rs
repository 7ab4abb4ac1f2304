//! Cutters: closed meshes whose inside a cut removes.
//!
//! What is inside follows from parity: a point from which a ray crosses the mesh an odd number of times. Solids of one file count
//! together, so that where two of them overlap nothing is removed; which way faces are turned does not matter.
//!
//! A cutter must be closed, each edge with an even number of faces: parity of an open mesh would remove streaks up to infinity,
//! and a frame could not tell them from what was meant. A part may be open and is drawn with doubtful pixels marked; a
//! cutter is refused at the door.

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

/// A closed mesh with a place in the world.
#[derive(Clone, Debug)]
pub struct Cutter {
    name: String,
    mesh: Arc<Mesh>,
    /// Placement.
    pub world_from_cutter: DAffine3,
    /// The outside is removed and the inside kept.
    pub keeps_inside: bool,
    /// Its walls are shaded as if they were round where edges turn by less than
    /// [`DEFAULT_CREASE_DEG`](crate::scene::DEFAULT_CREASE_DEG): normals of caps, and nothing else.
    pub is_smooth: bool,
}

impl Cutter {
    /// A cutter where its mesh is; the reason where the mesh cannot be one.
    pub fn new(name: impl Into<String>, mesh: impl Into<Arc<Mesh>>) -> Result<Self> {
        let (name, mesh) = (name.into(), mesh.into());
        if let Some(defect) = mesh.defect() {
            let help = "use a mesh of finite vertices with triangles between them";
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

    /// A cutter of solids as they stand in the world.
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

    /// The same cutter with a further placement in the world.
    #[must_use]
    pub fn placed(mut self, placement: DAffine3) -> Self {
        self.world_from_cutter = placement * self.world_from_cutter;
        self
    }

    /// The same cutter with what it removes and what it keeps exchanged.
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

    /// Its boundary, closed.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// Bounds of the placed mesh.
    pub fn bounds_in_world(&self) -> Bounds {
        let positions = self.mesh.positions.iter();
        Bounds::from_points(positions.map(|p| self.world_from_cutter.transform_point3(*p)))
    }
}
