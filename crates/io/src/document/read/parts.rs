//! `[[part]]`: meshes and built-in shapes, deformed, placed and coloured.

use cutaway::error::Result;
use cutaway::scene::describe::{Factors, OrWord};
use cutaway::scene::{Bounds, Outwards, Part, range};
use glam::{DAffine3, DMat3, DVec3};

use super::deform;
use super::described;
use super::part_source::PartSource;
use super::reader::{Entry, Table};
use super::roles::{self, RoleBy};
use super::scene_assets::SceneAssets;
use super::solids::SourceSolid;
use crate::document::Keys;
use crate::document::describe::{MaterialDesc, PartDesc, PlacementDesc};

/// Keys of a part.
pub(super) static KEYS: Keys = Keys::below("part.*");

/// The parts at a time, each with the source of its role. A disabled part is read, but not returned.
pub(in crate::document) fn all(
    root: &Table<'_>,
    scene_assets: &SceneAssets,
    time_s: f64,
    outwards: &Outwards,
) -> Result<Vec<(Part, RoleBy)>> {
    let roles = roles::read(root)?;
    let mut all = Vec::new();
    for (entry, held) in root.tables("part")?.iter().zip(&scene_assets.parts) {
        let table = entry.table(KEYS.all())?;
        let desc: PartDesc = described::read(&table)?;
        let parts = read(&table, &desc, held.at(time_s), (held, outwards))?;
        if !desc.enabled.unwrap_or(true) {
            continue;
        }
        for mut part in parts {
            let (role, by) = roles.of(&part, desc.role.is_some(), scene_assets.sights.as_ref());
            part.role = role;
            all.push((part, by));
        }
    }
    if all.is_empty() {
        let help = "enable at least one part: a scene without parts shows nothing";
        return Err(root.entry.fault("no part is enabled", help));
    }
    Ok(all)
}

/// Builds the parts of one entry from its solids at a time. A mesh file with several objects gives a part `NAME/OBJECT` for each.
fn read(
    table: &Table<'_>,
    desc: &PartDesc,
    solids: &[SourceSolid],
    (held, outwards): (&PartSource, &Outwards),
) -> Result<Vec<Part>> {
    let placed = placement(table, &desc.placement, held.rest)?;
    let mut parts: Vec<Part> = solids.iter().map(|s| s.part.clone()).collect();
    for (part, rest) in parts.iter_mut().zip(solids.iter().map(|s| &s.rest)) {
        part.name = held.name(&part.name).to_owned();
        part.place(placed);
        part.role = desc.role.unwrap_or(part.role);
        part.priority = desc.priority.or(part.priority);
        part.fill = desc.fill.unwrap_or(part.fill);
        let MaterialDesc {
            color, cap_color, ..
        } = desc.material;
        part.material.color = color.unwrap_or(part.material.color);
        part.material.is_painted_over |= color.is_some();
        part.material.cap_color = cap_color.or(part.material.cap_color);
        let whole = if held.share_a_space { held.rest } else { *rest };
        if let Some(list) = table.get("deform") {
            part.pose.deformers = deform::read(&list, whole)?;
            outwards.complete(part);
        }
        let deformers = part.pose.deformers.iter();
        let reach = deformers.fold(*rest, |reach, deformer| deformer.bounds(reach));
        let corners = reach.corners();
        let corners = corners.map(|c| part.world_from_part.transform_point3(c));
        let is_finite = corners.iter().all(|c| c.is_finite());
        let what = if is_finite {
            range::defect(&Bounds::from_points(corners))
        } else {
            Some("reaches to infinity".to_owned())
        };
        if let Some(what) = what {
            let what = format!("part `{}` {what} once it is placed", part.name);
            return Err(table
                .entry
                .fault(what, "use another scale, translation or deformation"));
        }
    }
    Ok(parts)
}

/// Placement: scale about the pivot, then rotation about the pivot (around the world's x, y and z, in this order), then translation.
pub(super) fn placement(table: &Table<'_>, desc: &PlacementDesc, rest: Bounds) -> Result<DAffine3> {
    if let Some(matrix) = table.get("matrix") {
        let steps = ["translate", "rotate_deg", "scale", "pivot"];
        if let Some(step) = steps.iter().find_map(|key| table.get(key)) {
            return Err(step.fault("the part also has a matrix", "keep one of the two"));
        }
        return affine(&matrix);
    }
    let factors = desc.scale.map_or(DVec3::ONE, |Factors(factors)| factors);
    if factors.cmpeq(DVec3::ZERO).any() {
        let entry = table.need("scale", "1")?;
        return Err(entry.fault("a scale of 0 flattens the solid", "use 1 for no change"));
    }
    let [x, y, z] = desc.rotate_deg.to_array().map(f64::to_radians);
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    let placed = turn * DMat3::from_diagonal(factors);
    let pivot = match desc.pivot {
        None => DVec3::ZERO,
        Some(OrWord::Word(_)) => rest.centre(),
        Some(OrWord::Value(point)) => point,
    };
    let moved = desc.translate + (pivot - placed * pivot);
    Ok(DAffine3::from_mat3_translation(placed, moved))
}

fn affine(entry: &Entry<'_>) -> Result<DAffine3> {
    const MEND: &str =
        "write 4 rows of 4 numbers, the last [0, 0, 0, 1]; translation is the last column";
    let rows = entry.list()?;
    let [a, b, c, last] = rows.as_slice() else {
        return Err(entry.fault(format_args!("it has {} rows, not 4", rows.len()), MEND));
    };
    if last.vector()? != [0.0, 0.0, 0.0, 1.0] {
        return Err(last.fault("the last row must be [0, 0, 0, 1]", MEND));
    }
    let [a, b, c] = [a.vector::<4>()?, b.vector::<4>()?, c.vector::<4>()?];
    let column = |i: usize| DVec3::new(a[i], b[i], c[i]);
    let matrix = DMat3::from_cols(column(0), column(1), column(2));
    if matrix.determinant() == 0.0 || !matrix.determinant().is_finite() {
        return Err(entry.fault("it flattens the solid", MEND));
    }
    Ok(DAffine3::from_mat3_translation(matrix, column(3)))
}

pub(super) static MATERIAL: Keys = Keys::below("part.*.material");
