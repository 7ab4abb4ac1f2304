//! Splits parts into their bodies, with their motion and rig.
//!
//! A body keeps the order of its triangles, their normals, the vertices that they use, and its part's placement, material, role, motion
//! and the rig from its file. A part with a single body stays unchanged. Parts that share a mesh, such as the wheels of a car, also
//! share the meshes of its bodies.

use std::sync::Arc;

use super::super::memo::ById;
use super::super::motion::BoundMesh;
use super::super::{Mesh, Motion, Part};
use super::Bodies;

/// Identity of a part's geometry data: its mesh, its motion, and the binding from its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GeometryId {
    mesh: ById<Mesh>,
    motion: Option<ById<Motion>>,
    bound: Option<ById<BoundMesh>>,
}

impl GeometryId {
    /// Identity of a part's geometry.
    pub fn of(part: &Part) -> Self {
        Self {
            mesh: ById(Arc::clone(&part.mesh)),
            motion: ById::of(part.motion.as_ref()),
            bound: ById::of(bound_of(part)),
        }
    }
}

/// The bodies of a mesh as separate meshes.
#[derive(Debug)]
pub struct Pieces {
    pieces: Vec<BodyPiece>,
}

#[derive(Debug)]
struct BodyPiece {
    mesh: Arc<Mesh>,
    motion: Option<Arc<Motion>>,
    /// The body's mesh in the file's bind pose, and in the file's rest pose.
    bound: Option<(Arc<BoundMesh>, Arc<Mesh>)>,
}

impl Pieces {
    /// Splits a part into bodies; `bodies` must come from a mesh with the same triangles.
    pub fn of(part: &Part, bodies: &Bodies) -> Self {
        let pieces = match bodies.count() {
            0 | 1 => Vec::new(),
            _ => (bodies.triangles().iter())
                .map(|triangles| BodyPiece::of(part, triangles))
                .collect(),
        };
        Self { pieces }
    }

    /// The part's bodies as separate parts with the same name; a part with one body is returned unchanged.
    pub fn parts(&self, part: &Part) -> Vec<Part> {
        if self.pieces.is_empty() {
            return vec![part.clone()];
        }
        let of_piece = |piece: &BodyPiece| Part {
            mesh: Arc::clone(&piece.mesh),
            motion: piece.motion.clone(),
            driver: (part.driver.as_ref().zip(piece.bound.as_ref()))
                .map(|(driver, (bound, rest))| Arc::new(driver.of_piece(bound, rest))),
            ..part.clone()
        };
        self.pieces.iter().map(of_piece).collect()
    }
}

impl BodyPiece {
    fn of(part: &Part, triangles: &[u32]) -> Self {
        let (mesh, vertices) = part.mesh.picked(triangles);
        let mesh = Arc::new(mesh);
        let of_motion = |motion: &Arc<Motion>| {
            let mut own = motion.of_positions(&vertices);
            if !motion.outward.is_empty() {
                own.outward = mesh.outward();
            }
            own
        };
        let motion = part.motion.as_ref().map(|m| Arc::new(of_motion(m)));
        let driver = part.driver.as_ref();
        let bound = driver.zip(bound_of(part)).map(|(driver, bound)| {
            let own = |of: &Arc<Mesh>| match Arc::ptr_eq(of, &part.mesh) {
                true => (*mesh).clone(),
                false => of.picked(triangles).0,
            };
            let own_motion = bound.motion.as_ref().map(of_motion);
            let own_bound = BoundMesh::new(own(&bound.mesh), own_motion.unwrap_or_default());
            let rest = match Arc::ptr_eq(driver.rest_mesh(), &bound.mesh) {
                true => Arc::clone(&own_bound.mesh),
                false => Arc::new(own(driver.rest_mesh())),
            };
            (Arc::new(own_bound), rest)
        });
        // If the part used its file's rest mesh before, the body's mesh and rest mesh are shared too.
        let mesh = match &bound {
            Some((_, rest)) if **rest == *mesh => Arc::clone(rest),
            _ => mesh,
        };
        Self {
            mesh,
            motion,
            bound,
        }
    }
}

/// The part's binding from its file, if the part still has the file's triangles.
pub(in crate::scene) fn bound_of(part: &Part) -> Option<&Arc<BoundMesh>> {
    let driver = part.driver.as_ref()?;
    let has_its_mesh = [driver.rest_mesh(), &driver.bound().mesh]
        .into_iter()
        .any(|mesh| Arc::ptr_eq(mesh, &part.mesh));
    has_its_mesh.then(|| driver.bound())
}

impl Part {
    /// The bodies of the part as separate parts named `NAME/1`, `NAME/2` and so on; the part itself if it has one body ([`Bodies`]). A part
    /// whose mesh no longer comes from its file loses the file's animations.
    #[must_use]
    pub fn split(&self) -> Vec<Self> {
        let mut parts = Pieces::of(self, &Bodies::of(&self.mesh)).parts(self);
        if parts.len() > 1 {
            for (number, part) in (1..).zip(&mut parts) {
                part.name = body_name(&self.name, number);
            }
        }
        parts
    }
}

/// Name of the body `number`, counted from 1, of a part or another named item.
pub fn body_name(of: &str, number: usize) -> String {
    format!("{of}/{number}")
}
