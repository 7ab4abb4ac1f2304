//! Targets of new keys: the numbers that position the selected cut, the selected part or the eye.

use cutaway::scene::{Bounds, Camera, Viewpoint};
use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};
use glam::DVec3;

use crate::action::Selection;
use crate::editing::cuts::{self, CutKind};
use crate::editing::regions::{self, Region};
use crate::picture::camera;

use super::path_of;

/// Converts the selection's position in the document to numbers that keys can animate: a section becomes a normal and an
/// origin, percentages become units.
///
/// # Errors
///
/// A surface in the paper's form has no origin, a part is positioned by a matrix, or the document cannot be changed.
pub fn prepare(
    document: &mut Document,
    selection: Selection,
    (bounds, eye): (&Bounds, &Camera),
) -> Result<()> {
    match selection {
        Selection::Scene => {
            camera::write(eye, document)?;
            document.set("camera.zoom", eye.zoom)?;
            document.set("camera.pan", eye.pan.to_array().to_vec())
        }
        Selection::Part(index) => {
            let part = document.get(&format!("part.{index}"))?;
            if part.get("matrix").is_some() {
                let help = "position it by `translate`, `rotate_deg` and `scale` in the scene file";
                let what = "it is positioned by a matrix";
                return Err(Error::input(format!("part {index}"), what, help));
            }
            or_else(document, &format!("part.{index}.translate"), vec![0.0; 3])
        }
        Selection::Cut(index) => prepare_cut(document, index, bounds),
    }
}

fn prepare_cut(document: &mut Document, index: usize, bounds: &Bounds) -> Result<()> {
    let path = format!("cut.{index}");
    match kind(document, index)? {
        CutKind::Plane | CutKind::Relief | CutKind::Surfaces => {
            let surface = format!("{path}.surfaces.0");
            if document.get(&surface)?.get("u").is_some() {
                return or_else(document, &format!("{surface}.origin"), vec![0.0; 3]);
            }
            let (normal, origin) = cuts::plane(document, index, bounds)?;
            document.remove(&format!("{surface}.section"))?;
            document.remove(&format!("{surface}.flip"))?;
            document.set(&format!("{surface}.normal"), list(normal))?;
            document.set(&format!("{surface}.origin"), list(origin))
        }
        CutKind::Box => {
            let regions = regions::regions(document, index, bounds);
            let Some(Region::Block { path, block }) = regions.first() else {
                return Err(unkeyed("the box is not given in numbers"));
            };
            let numbers = |corner: [Option<f64>; 3]| {
                let all: Option<Vec<f64>> = corner.into_iter().collect();
                all
            };
            let (min, max) = (numbers(block.min), numbers(block.max));
            if let (Some(min), Some(max), true) =
                (&min, &max, document.get(path)?.get("size").is_some())
            {
                let pairs = || min.iter().zip(max);
                let centre: Vec<f64> = pairs().map(|(a, b)| (a + b) * 0.5).collect();
                let size: Vec<f64> = pairs().map(|(a, b)| b - a).collect();
                document.set(&format!("{path}.centre"), centre)?;
                return document.set(&format!("{path}.size"), size);
            }
            for (key, corner) in [("min", min), ("max", max)] {
                if let Some(corner) = corner {
                    document.set(&format!("{path}.{key}"), corner)?;
                }
            }
            Ok(())
        }
        CutKind::Wedge => Ok(()),
        CutKind::Cutter => or_else(document, &format!("{path}.translate"), vec![0.0; 3]),
        CutKind::Cutout => or_else(document, &format!("{path}.cutout.angle_deg"), 110.0),
        CutKind::Breakaway => or_else(document, &format!("{path}.breakaway.bevel_deg"), 0.0),
    }
}

/// Targets for keys of the selection, with their present values; requires a [prepared](prepare) document.
///
/// # Errors
///
/// A selected item that does not exist.
pub fn targets(
    document: &Document,
    selection: Selection,
    (bounds, eye): (&Bounds, &Camera),
) -> Result<Vec<(String, Value)>> {
    let (entry, keys): (String, &[&str]) = match selection {
        Selection::Scene => {
            let place: &[&str] = match eye.viewpoint {
                Viewpoint::Explicit { .. } => &["position", "focal_point", "zoom", "pan"],
                _ => &["azimuth_deg", "elevation_deg", "zoom", "pan"],
            };
            ("camera".to_owned(), place)
        }
        Selection::Part(index) => (path_of(document, "part", index)?, &["translate"]),
        Selection::Cut(index) => {
            let cut = document.get(&format!("cut.{index}"))?;
            let entry = path_of(document, "cut", index)?;
            let keys: &[&str] = match kind(document, index)? {
                CutKind::Plane | CutKind::Relief | CutKind::Surfaces => {
                    &["surfaces.0.normal", "surfaces.0.origin"]
                }
                CutKind::Box => {
                    let regions = regions::regions(document, index, bounds);
                    let Some(Region::Block { path, .. }) = regions.first() else {
                        return Err(unkeyed("the box is not given in numbers"));
                    };
                    match path.ends_with(".0") {
                        true => &["box.0.min", "box.0.max", "box.0.centre", "box.0.size"],
                        false => &["box.min", "box.max", "box.centre", "box.size"],
                    }
                }
                CutKind::Wedge => match cut.get("wedge").map(|w| &w.value) {
                    Some(Value::List(_)) => &["wedge.0.from_deg", "wedge.0.to_deg"],
                    _ => &["wedge.from_deg", "wedge.to_deg"],
                },
                CutKind::Cutter => &["translate"],
                CutKind::Cutout => &["cutout.angle_deg"],
                CutKind::Breakaway => &["breakaway.bevel_deg"],
            };
            (entry, keys)
        }
    };
    let found = keys.iter().filter_map(|key| {
        let path = format!("{entry}.{key}");
        let value = document.get(&path).ok()?.value.clone();
        is_of_numbers(&value).then_some((path, value))
    });
    let found: Vec<_> = found.collect();
    match found.is_empty() {
        true => Err(unkeyed("the file gives no number that keys can move")),
        false => Ok(found),
    }
}

fn unkeyed(what: &str) -> Error {
    let help = "give its position in numbers in the scene file";
    Error::input("the key", what, help)
}

fn kind(document: &Document, index: usize) -> Result<CutKind> {
    let entry = cuts::cuts(document).into_iter().nth(index);
    entry.map(|entry| entry.kind).ok_or_else(|| {
        let culprit = format!("cut {index}");
        Error::input(culprit, "there is no such cut", "select another one")
    })
}

/// Sets a value if it is missing.
fn or_else(document: &mut Document, path: &str, usual: impl Into<Value>) -> Result<()> {
    match document.get(path) {
        Ok(_) => Ok(()),
        Err(_) => document.set(path, usual),
    }
}

fn is_of_numbers(value: &Value) -> bool {
    match value {
        Value::Number(_) | Value::Flag(_) => true,
        Value::List(list) => list.iter().all(|node: &Node| is_of_numbers(&node.value)),
        _ => false,
    }
}

/// Replaces negative zero by zero.
fn list(v: DVec3) -> Value {
    v.to_array().map(|c| c + 0.0).to_vec().into()
}
