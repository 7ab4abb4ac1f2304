//! Solids of the Boolean crate, converted from and to meshes.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGLP, OpType};

use crate::scene::Mesh;

/// Where a face of a result comes from: its source mesh and its face in that mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FaceOrigin {
    /// Number of the mesh.
    pub(super) mesh: u32,
    /// Face index in the source mesh.
    pub(super) face: u32,
}

/// A closed mesh to which operations are applied.
#[derive(Clone)]
pub(super) struct ManifoldSolid(Manifold);

impl ManifoldSolid {
    /// A solid, and the mesh number by which its faces are found later. Coplanar neighbours whose faces have different names stay separate.
    ///
    /// # Errors
    ///
    /// Fails for a mesh that is not closed or is too large.
    pub(super) fn new(mesh: &Mesh, face: impl Fn(usize) -> u32) -> Result<(Self, u32), Undivided> {
        let number = Manifold::reserve_ids(1);
        let count = mesh.triangles.len();
        let given = MeshGLP::<f64, u32> {
            num_prop: 3,
            vert_properties: mesh.positions.iter().flat_map(|p| p.to_array()).collect(),
            tri_verts: mesh.triangles.iter().flatten().copied().collect(),
            run_index: vec![0, 3 * count as u32],
            run_original_id: vec![number],
            face_id: (0..count).map(face).collect(),
            ..MeshGLP::default()
        };
        let solid = guarded(|| Manifold::from_mesh_glp_robust(&given))?;
        Ok((Self(solid), number))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn and(&self, other: &Self) -> Result<Self, Undivided> {
        self.with(other, OpType::Intersect)
    }

    pub(super) fn or(&self, other: &Self) -> Result<Self, Undivided> {
        self.with(other, OpType::Add)
    }

    pub(super) fn without(&self, other: &Self) -> Result<Self, Undivided> {
        self.with(other, OpType::Subtract)
    }

    fn with(&self, other: &Self, operation: OpType) -> Result<Self, Undivided> {
        guarded(|| {
            self.0
                .boolean_with_engine(&other.0, operation, BooleanEngine::Auto)
        })
        .map(Self)
    }

    /// Its faces, and the origin of each.
    pub(super) fn mesh(&self) -> (Mesh, Vec<FaceOrigin>) {
        let made: MeshGLP<f64, u32> = self.0.get_mesh_glp(-1);
        let mut vertex: Vec<u32> = (0..made.num_vert() as u32).collect();
        for (from, to) in made.merge_from_vert.iter().zip(&made.merge_to_vert) {
            vertex[*from as usize] = *to;
        }
        let triangles = (made.tri_verts.chunks_exact(3))
            .map(|t| [t[0], t[1], t[2]].map(|i| vertex[i as usize]));
        let mut origins = Vec::with_capacity(made.num_tri());
        for (run, mesh) in made.run_original_id.iter().enumerate() {
            let of_run = made.run_index[run] as usize / 3..made.run_index[run + 1] as usize / 3;
            origins.extend(of_run.map(|t| FaceOrigin {
                mesh: *mesh,
                face: made.face_id[t],
            }));
        }
        let mesh = Mesh {
            triangles: triangles.collect(),
            positions: (made.vert_properties.chunks_exact(3))
                .map(|p| DVec3::new(p[0], p[1], p[2]))
                .collect(),
            ..Mesh::default()
        };
        (mesh, origins)
    }
}

/// Why a mesh is not divided.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(in crate::slice) enum Undivided {
    #[error("it is not closed")]
    Open,
    #[error("its cutter `{name}` is not closed")]
    OpenCutter { name: String },
    #[error("the Boolean operation failed: {what}")]
    Failed { what: String },
}

impl Undivided {
    pub(in crate::slice) fn help(&self) -> &'static str {
        match self {
            Self::Open => {
                "`cutaway inspect` lists its open edges; close them, or cut it by planes alone"
            }
            Self::OpenCutter { .. } => {
                "close the mesh that cuts: `cutaway inspect` lists its open edges"
            }
            Self::Failed { .. } => {
                "move the cut a little, try another --relief-cells, or cut by planes alone"
            }
        }
    }
}

/// Number of operations in progress.
static AT_WORK: AtomicUsize = AtomicUsize::new(0);

/// Returns true if a panic may come from the Boolean crate: such a panic becomes an error and is not printed.
pub fn is_at_work() -> bool {
    AT_WORK.load(Ordering::SeqCst) > 0
}

/// Result of an operation, or the reason for its failure. A panic in the crate must not end the program.
fn guarded(operation: impl FnOnce() -> Manifold) -> Result<Manifold, Undivided> {
    AT_WORK.fetch_add(1, Ordering::SeqCst);
    let made = catch_unwind(AssertUnwindSafe(operation));
    AT_WORK.fetch_sub(1, Ordering::SeqCst);
    let failed = |what: &str| Undivided::Failed {
        what: what.to_owned(),
    };
    let made = made.map_err(|_| failed("the Boolean library panicked"))?;
    match made.status() {
        Error::NoError => Ok(made),
        Error::NotClosed | Error::NotManifold => Err(Undivided::Open),
        other => Err(failed(&other.to_string())),
    }
}
