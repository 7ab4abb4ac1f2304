//! Builds the solid of an object in a 3MF package: its mesh, without slicer regions and with welded vertices, and its colours.

use std::ops::RangeInclusive;
use std::sync::Arc;

use cutaway::error::{Diagnostic, Result};
use cutaway::scene::Mesh;
use glam::Vec3;

use super::model::{Object, ObjectGeometry, ThreeMfModel};
use super::slicer::Use;
use super::xml::shortened;
use crate::load::draft::{Draft, Group};

/// A solid that is shown at least once.
#[derive(Clone)]
pub(super) struct ShownSolid {
    pub(super) mesh: Arc<Mesh>,
    pub(super) color: Option<Vec3>,
    pub(super) materials: Vec<String>,
    pub(super) is_transparent: bool,
    pub(super) is_closed: bool,
}

/// Builds the solid of an object and consumes the object's mesh. Further placements reuse the result.
pub(super) fn solid(
    model: &mut ThreeMfModel,
    id: u32,
    (label, uses): (&str, &[(RangeInclusive<usize>, Use)]),
    notes: &mut Vec<Diagnostic>,
) -> Result<Option<ShownSolid>> {
    let Some(object) = model.objects.get_mut(&id) else {
        return Ok(None);
    };
    let ObjectGeometry::Mesh(read) = std::mem::replace(
        &mut object.shape,
        ObjectGeometry::Mesh(Ok(Default::default())),
    ) else {
        return Ok(None);
    };
    let mut geometry = read?;
    if geometry.has_beams {
        notes.push(Diagnostic::note(
            "3mf-beams",
            "its beams are not drawn, only its triangles",
        ));
    }
    for (range, of) in uses {
        notes.push(of.note(&format!("triangles {} to {}", range.start(), range.end())));
    }
    geometry.keep(|triangle| !uses.iter().any(|(range, _)| range.contains(&triangle)));
    if geometry.mesh.triangles.is_empty() {
        notes.push(Diagnostic::note(
            "no-triangles",
            "left out: it has no triangles",
        ));
        return Ok(None);
    }
    let look = model.properties.look(&geometry, object.default);
    notes.extend(look.notes);
    geometry.mesh.vertex_paint = look.vertex_paint;
    let draft = Draft {
        mesh: geometry.mesh,
        groups: vec![Group {
            color: look.color,
            is_transparent: look.is_transparent,
            ..Group::default()
        }],
        ..Draft::default()
    };
    let path = model.path.join(label);
    // The draft has one group, so there is one solid.
    let solid = draft.into_solids(&path, notes)?.pop();
    Ok(solid.map(|solid| ShownSolid {
        mesh: Arc::new(solid.mesh),
        color: solid.color,
        materials: look.materials,
        is_transparent: solid.is_transparent,
        is_closed: solid.is_closed,
    }))
}

pub(super) fn label(id: u32, object: &Object) -> String {
    match &object.name {
        Some(name) => format!("object {id} ({})", shortened(name)),
        None => format!("object {id}"),
    }
}
