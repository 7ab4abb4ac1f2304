//! Parts with triangles added between existing vertices, in the rest mesh and in the file's bind-pose mesh; the rig is kept.
//!
//! The added triangles are flat-shaded and take their corner colours from existing triangles, without images.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::scene::bodies::bound_of;
use crate::scene::motion::BoundMesh;
use crate::scene::{Mesh, Motion, Part, TexturedTriangle};

/// A part with added triangles.
#[derive(Debug)]
pub(crate) struct FilledPart {
    mesh: Arc<Mesh>,
    motion: Option<Arc<Motion>>,
    /// The bind-pose mesh without the added triangles, the same with them, and the rest-pose mesh with them.
    bound: Option<(Arc<BoundMesh>, Arc<Mesh>)>,
}

impl FilledPart {
    pub(crate) fn of(part: &Part, triangles: &[[u32; 3]]) -> Self {
        let mesh = Arc::new(part.mesh.with_triangles(triangles));
        let of_motion = |motion: &Arc<Motion>| {
            let mut own = (**motion).clone();
            if !motion.outward.is_empty() {
                own.outward = mesh.outward();
            }
            own
        };
        let bound = (part.driver.as_ref().zip(bound_of(part))).map(|(driver, bound)| {
            let own = |of: &Arc<Mesh>| match Arc::ptr_eq(of, &part.mesh) {
                true => (*mesh).clone(),
                false => of.with_triangles(triangles),
            };
            let motion = bound.motion.as_ref().map(of_motion);
            let grown = Arc::new(BoundMesh::new(own(&bound.mesh), motion.unwrap_or_default()));
            let rest = match Arc::ptr_eq(driver.rest_mesh(), &bound.mesh) {
                true => Arc::clone(&grown.mesh),
                false => Arc::new(own(driver.rest_mesh())),
            };
            (grown, rest)
        });
        Self {
            motion: part.motion.as_ref().map(|m| Arc::new(of_motion(m))),
            // If the part used its file's rest mesh before, both are the same mesh again.
            mesh: match &bound {
                Some((_, rest)) if **rest == *mesh => Arc::clone(rest),
                _ => mesh,
            },
            bound,
        }
    }

    /// Replaces the mesh, motion and binding of the part.
    pub(crate) fn apply(&self, part: &mut Part) {
        part.mesh = Arc::clone(&self.mesh);
        part.motion.clone_from(&self.motion);
        if let (Some(driver), Some((bound, rest))) = (&part.driver, &self.bound) {
            part.driver = Some(Arc::new(driver.of_piece(bound, rest)));
        }
    }
}

impl Mesh {
    fn with_triangles(&self, triangles: &[[u32; 3]]) -> Self {
        let mut mesh = self.clone();
        mesh.triangles.extend(triangles);
        if let Some(normals) = &mut mesh.corner_normals {
            normals.extend(triangles.iter().map(|t| {
                let [a, b, c] = t.map(|i| self.positions[i as usize]);
                [(b - a).cross(c - a).normalize_or_zero().as_vec3(); 3]
            }));
        }
        if let Some(vertex_paint) = &mut mesh.vertex_paint {
            let corners = triangles.iter().flatten();
            let mut colors: BTreeMap<u32, [u8; 4]> = corners.map(|i| (*i, [255; 4])).collect();
            for (t, textured) in self.triangles.iter().zip(&vertex_paint.triangles) {
                for (corner, color) in t.iter().zip(textured.colors) {
                    colors.entry(*corner).and_modify(|known| *known = color);
                }
            }
            vertex_paint
                .triangles
                .extend(triangles.iter().map(|t| TexturedTriangle {
                    colors: t.map(|i| colors[&i]),
                    ..TexturedTriangle::default()
                }));
        }
        mesh
    }
}
