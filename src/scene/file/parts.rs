//! `[[part]]`: meshes and built-in shapes, placed and coloured.

use std::path::Path;

use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::Loaders;
use super::reader::{Entry, Table};
use crate::error::{Error, Result, did_you_mean};
use crate::scene::{Fill, Part, Role};

const KEYS: &[&str] = &[
    "name",
    "mesh",
    "shape",
    "translate",
    "rotate_deg",
    "scale",
    "matrix",
    "role",
    "priority",
    "fill",
    "material",
];

/// Hatches of ISO 128-50 and the habits around it.
const HATCHES: &[&str] = &[
    "general",
    "steel",
    "iron",
    "aluminium",
    "copper",
    "brass",
    "plastic",
    "rubber",
    "glass",
    "wood",
    "concrete",
    "earth",
];

/// Reads one entry, which may hold several parts: a mesh file with several objects makes `NAME/OBJECT` of each.
pub(super) fn read(
    entry: &Entry<'_>,
    folder: &Path,
    loaders: &Loaders<'_>,
    notes: &mut Vec<String>,
) -> Result<Vec<Part>> {
    let table = entry.table(KEYS)?;
    let mut parts = load(&table, folder, loaders, notes)?;
    if let Some(name) = table.get("name") {
        let text = name.text()?;
        if text.is_empty() {
            return Err(name.fault("it is empty", "give the part a name, or leave the key out"));
        }
        if let [one] = parts.as_mut_slice() {
            one.name = text.to_owned();
        } else {
            for part in &mut parts {
                part.name = format!("{text}/{}", part.name);
            }
        }
    }
    let placed = placement(&table)?;
    let role = table
        .get("role")
        .map(|r| r.choice(&[("exterior", Role::Exterior), ("interior", Role::Interior)]));
    let role = role.transpose()?;
    let priority = table
        .get("priority")
        .map(|p| p.whole::<i32>())
        .transpose()?;
    let fill = table
        .get("fill")
        .map(|f| f.choice(&[("even-odd", Fill::EvenOdd), ("nonzero", Fill::Nonzero)]))
        .transpose()?;
    let look = table.get("material").map(|m| look(&m)).transpose()?;
    for part in &mut parts {
        part.place(placed);
        part.role = role.unwrap_or(part.role);
        part.priority = priority.or(part.priority);
        part.fill = fill.unwrap_or(part.fill);
        if let Some(look) = &look {
            part.material.color = look.color.unwrap_or(part.material.color);
            part.material.cap_color = look.cap_color.or(part.material.cap_color);
        }
        let bounds = part.bounds_in_world();
        let finite = bounds.min.is_finite() && bounds.max.is_finite();
        if !(finite || bounds.is_empty()) {
            let what = format!("part `{}` reaches to infinity once it is placed", part.name);
            return Err(entry.fault(what, "use a smaller scale or translation"));
        }
    }
    if let Some(hatch) = look.and_then(|l| l.hatch) {
        notes.push(format!(
            "{}: the hatch `{hatch}` is read, but not drawn yet",
            entry.key
        ));
    }
    Ok(parts)
}

fn load(
    table: &Table<'_>,
    folder: &Path,
    loaders: &Loaders<'_>,
    notes: &mut Vec<String>,
) -> Result<Vec<Part>> {
    let (origin, parts) = match (table.get("mesh"), table.get("shape")) {
        (Some(mesh), None) => {
            let file = mesh.text()?;
            let path = folder.join(file);
            if !path.is_file() {
                let what = format!("there is no file {}", path.display());
                return Err(mesh.fault(what, "check the name; it is relative to the scene file"));
            }
            let (parts, said) = (loaders.open_mesh)(&path)?;
            notes.extend(said);
            (mesh, parts)
        }
        (None, Some(shape)) => {
            let parts = (loaders.open_shape)(shape.text()?).map_err(|e| shape.place(e))?;
            (shape, parts)
        }
        (Some(_), Some(shape)) => {
            return Err(shape.fault("the part has a mesh too", "keep one of the two"));
        }
        (None, None) => {
            let mend = "add `mesh = \"FILE\"` or `shape = \"crank\"`";
            return Err(table.entry.fault("it has neither a mesh nor a shape", mend));
        }
    };
    if parts.is_empty() {
        return Err(origin.fault("it holds no solid", "use a file or shape with triangles"));
    }
    Ok(parts)
}

/// Scaled first, then turned about x, y and z of the world in that order, then moved.
fn placement(table: &Table<'_>) -> Result<DAffine3> {
    let steps = ["translate", "rotate_deg", "scale"].map(|key| table.get(key));
    if let Some(matrix) = table.get("matrix") {
        if let Some(step) = steps.iter().flatten().next() {
            return Err(step.fault("the part has a matrix too", "keep one of the two"));
        }
        return affine(&matrix);
    }
    let [translate, rotate, scale] = steps;
    let mut placed = DMat3::IDENTITY;
    if let Some(entry) = scale {
        let factors = if entry.is_list() {
            DVec3::from(entry.vector()?)
        } else {
            DVec3::splat(entry.number()?)
        };
        if factors.cmpeq(DVec3::ZERO).any() {
            return Err(entry.fault("a scale of 0 flattens the solid", "use 1 for no change"));
        }
        placed = DMat3::from_diagonal(factors);
    }
    if let Some(entry) = rotate {
        let [x, y, z] = entry.vector()?.map(f64::to_radians);
        let turn =
            DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
        placed = turn * placed;
    }
    let moved = translate.map_or(Ok([0.0; 3]), |entry| entry.vector())?;
    Ok(DAffine3::from_mat3_translation(placed, moved.into()))
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

struct Look {
    color: Option<Vec3>,
    cap_color: Option<Vec3>,
    hatch: Option<String>,
}

fn look(entry: &Entry<'_>) -> Result<Look> {
    let table = entry.table(&["color", "cap_color", "hatch"])?;
    let hatch = match table.get("hatch") {
        None => None,
        Some(hatch) => {
            let name = hatch.text()?;
            if !HATCHES.contains(&name) {
                let mend = did_you_mean(name, HATCHES.iter().copied());
                return Err(hatch.fault(format_args!("{name:?} is no hatch"), mend));
            }
            Some(name.to_owned())
        }
    };
    Ok(Look {
        color: table.get("color").map(|c| color(&c)).transpose()?,
        cap_color: table.get("cap_color").map(|c| color(&c)).transpose()?,
        hatch,
    })
}

/// `#rrggbb` or `#rgb`.
pub(super) fn color(entry: &Entry<'_>) -> Result<Vec3> {
    let text = entry.text()?;
    parse_color(text).ok_or_else(|| -> Error {
        let mend = "write `#rrggbb`, for example \"#8a94a6\"";
        entry.fault(format_args!("{text:?} is no colour"), mend)
    })
}

/// A colour from its digits: `#rrggbb` or `#rgb`, as sRGB in 0..=1.
pub fn parse_color(text: &str) -> Option<Vec3> {
    let digits = text.strip_prefix('#')?;
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let value = u32::from_str_radix(digits, 16).ok()?;
    let (bits, most) = match digits.len() {
        6 => (8, 255),
        3 => (4, 15),
        _ => return None,
    };
    let channel = |i: u32| ((value >> (bits * i)) & most) as f32 / most as f32;
    Some(Vec3::new(channel(2), channel(1), channel(0)))
}
