//! Finds the defects of a scene's meshes, once per mesh, in the background.
//!
//! Meshes are inspected one at a time, on a thread that leaves a core free for the window; in a browser, immediately. Findings
//! are kept as long as the mesh is in use. Cost: one [`Topology::new`] per mesh, a few seconds for a few million faces.
//!
//! Cannot: follow an animated or deformed mesh; its open edges are shown in the rest pose.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Weak};

use cutaway::scene::{Mesh, Part, Topology};
use glam::DVec3;

use crate::beside::beside;

/// Defects of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshDefects {
    /// End points of edges with an odd number of faces, in mesh space.
    pub open: Vec<[DVec3; 2]>,
    /// Edges with more than two faces.
    pub non_manifold: usize,
    /// Edges whose two faces have inconsistent orientations.
    pub inconsistent: usize,
    /// Faces that coincide with another face.
    pub coincident: usize,
    /// Closed meshes with a negative volume.
    pub inside_out: usize,
}

impl MeshDefects {
    /// Inspects a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let facts = Topology::new(mesh);
        let at = |index: u32| mesh.positions[index as usize];
        let open = mesh.open_edges().into_iter().map(|ends| ends.map(at));
        Self {
            open: open.collect(),
            non_manifold: facts.non_manifold_edges,
            inconsistent: facts.inconsistent_edges,
            coincident: facts.coincident_faces,
            inside_out: usize::from(facts.closed && facts.volume < 0.0),
        }
    }
}

/// Counts over all meshes of a part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    open: usize,
    non_manifold: usize,
    inconsistent: usize,
    coincident: usize,
    inside_out: usize,
}

impl Counts {
    /// Sums the findings of several meshes.
    pub fn of<'a>(all: impl IntoIterator<Item = &'a MeshDefects>) -> Self {
        let mut sum = Self::default();
        for findings in all {
            sum.open += findings.open.len();
            sum.non_manifold += findings.non_manifold;
            sum.inconsistent += findings.inconsistent;
            sum.coincident += findings.coincident;
            sum.inside_out += findings.inside_out;
        }
        sum
    }

    /// Returns true if there are open edges.
    pub fn is_open(&self) -> bool {
        self.open > 0
    }

    /// Short description of the most serious defect; `None` if there are no defects.
    pub fn badge(&self) -> Option<String> {
        let edges = |count: usize| match count {
            1 => "1 edge".to_owned(),
            _ => format!("{count} edges"),
        };
        if self.open > 0 {
            Some(format!("open: {}", edges(self.open)))
        } else if self.inside_out > 0 {
            Some("inside out".to_owned())
        } else if self.coincident > 0 {
            Some(format!("doubled: {} faces", self.coincident))
        } else if self.inconsistent > 0 {
            Some(format!("inconsistent: {}", edges(self.inconsistent)))
        } else if self.non_manifold > 0 {
            Some(format!("non-manifold: {}", edges(self.non_manifold)))
        } else {
            None
        }
    }

    /// One line per kind of defect: the count, and the consequence.
    pub fn details(&self) -> String {
        let lines = [
            (
                self.open,
                "edges with an odd number of faces: caps can be wrong along rays through the holes",
            ),
            (
                self.inside_out,
                "closed meshes that are inside out: their volume is negative",
            ),
            (
                self.coincident,
                "faces that lie on another: two of them cancel, and the solid has no interior there",
            ),
            (
                self.inconsistent,
                "edges whose faces are oriented inconsistently: shading is wrong there, caps are not",
            ),
            (self.non_manifold, "edges with more than two faces"),
        ];
        let told = lines.iter().filter(|(count, _)| *count > 0);
        let told: Vec<String> = told
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        told.join("\n")
    }
}

/// Findings with a weak reference to their mesh.
type CachedFindings = (Weak<Mesh>, MeshDefects);

/// Findings for the meshes inspected so far, and the mesh under inspection.
#[derive(Debug, Default)]
pub struct Inspector {
    /// Findings by the mesh's address; the weak reference kept here keeps the address unique.
    known: BTreeMap<usize, CachedFindings>,
    under_way: Option<(Arc<Mesh>, Receiver<MeshDefects>)>,
    /// Revision for which all meshes are inspected.
    done: Option<u64>,
}

impl Inspector {
    /// Receives findings, and starts to inspect the scene's next mesh; `wake` is called when its findings can be received.
    /// Returns true if there are new findings.
    pub fn go_on(
        &mut self,
        (parts, revision): (&[Part], u64),
        wake: impl Fn() + Send + 'static,
    ) -> bool {
        let has_ended = self.take_in();
        if self.under_way.is_some() || self.done == Some(revision) && !has_ended {
            return has_ended;
        }
        self.known.retain(|_, (mesh, _)| mesh.strong_count() > 0);
        let next = parts.iter().find(|part| self.of(&part.mesh).is_none());
        match next {
            Some(part) => {
                let (tell, answers) = channel();
                let mesh = part.mesh.clone();
                self.under_way = Some((mesh.clone(), answers));
                beside(move || {
                    // Sending fails only after the window was closed, and is then ignored.
                    let _ = tell.send(MeshDefects::of(&mesh));
                    wake();
                });
            }
            None => self.done = Some(revision),
        }
        has_ended
    }

    /// Returns true while a mesh is being inspected.
    pub fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// Findings of a mesh, once they are known.
    pub fn of(&self, mesh: &Arc<Mesh>) -> Option<&MeshDefects> {
        self.known.get(&address(mesh)).map(|(_, findings)| findings)
    }

    fn take_in(&mut self) -> bool {
        let Some((mesh, answers)) = &self.under_way else {
            return false;
        };
        let findings = match answers.try_recv() {
            Ok(findings) => findings,
            Err(TryRecvError::Empty) => return false,
            // A failed inspection is not repeated.
            Err(TryRecvError::Disconnected) => MeshDefects::default(),
        };
        let known = (Arc::downgrade(mesh), findings);
        self.known.insert(address(mesh), known);
        self.under_way = None;
        true
    }
}

fn address(mesh: &Arc<Mesh>) -> usize {
    Arc::as_ptr(mesh).addr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway::generate::shapes::shape;

    fn mesh() -> Mesh {
        Mesh::clone(&shape("cube").expect("a cube")[0].mesh)
    }

    #[test]
    fn holes_and_doubled_faces_are_found_and_sound_meshes_have_no_badge() {
        let sound = MeshDefects::of(&mesh());
        assert_eq!(Counts::of([&sound]).badge(), None);
        assert_eq!(Counts::of([&sound]).details(), "");

        let mut open = mesh();
        open.triangles.pop();
        let found = MeshDefects::of(&open);
        assert_eq!(found.open.len(), 3, "around the face that is missing");
        let counts = Counts::of([&found, &sound, &found]);
        assert_eq!(counts.badge().as_deref(), Some("open: 6 edges"));
        assert!(
            counts.details().contains("wrong along rays"),
            "{}",
            counts.details()
        );

        let mut turned = mesh();
        turned.triangles.iter_mut().for_each(|t| t.reverse());
        let counts = Counts::of([&MeshDefects::of(&turned)]);
        assert_eq!(counts.badge().as_deref(), Some("inside out"));

        let mut doubled = mesh();
        let face = doubled.triangles[0];
        doubled
            .triangles
            .extend([face, [face[0], face[2], face[1]]]);
        let counts = Counts::of([&MeshDefects::of(&doubled)]);
        assert!(
            counts.badge().is_some_and(|b| b.starts_with("doubled")),
            "{counts:?}"
        );
    }

    #[test]
    fn each_mesh_is_inspected_once() {
        let parts = shape("gears").expect("gears");
        let mut inspector = Inspector::default();
        let mut ended = 0;
        let wait = |inspector: &mut Inspector, revision, ended: &mut usize| {
            for _ in 0..20_000 {
                *ended += usize::from(inspector.go_on((&parts, revision), || {}));
                if !inspector.is_busy() {
                    return;
                }
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            panic!("it never ends");
        };
        wait(&mut inspector, 1, &mut ended);
        let meshes: std::collections::BTreeSet<_> =
            parts.iter().map(|p| address(&p.mesh)).collect();
        assert_eq!(ended, meshes.len(), "one by one");
        assert!(parts.iter().all(|p| inspector.of(&p.mesh).is_some()));
        wait(&mut inspector, 2, &mut ended);
        assert_eq!(ended, meshes.len(), "nothing is new");
    }
}
