//! Checks of a document before any file that it names is opened.

use std::path::Path;

use cutaway::error::Result;
use cutaway::generate::shapes;
use cutaway::scene::{Bounds, Fit};
use glam::DVec3;

use super::clip::cuts;
use super::opening::{missing, spec_of};
use super::reader::{Entry, Table};
use super::{camera, cap_materials, described, hatches, keys, parts, scene_assets, style};
use crate::document::Settings;
use crate::document::paths::keys_below;
use crate::load::Assets;
use crate::load::frames::Pattern;

/// Checks everything that can be checked without opening a file.
pub(in crate::document) fn check(root: &Table<'_>, folder: &Path, assets: &Assets) -> Result<()> {
    must_be_known(&root.entry, "")?;
    let settings: Settings = described::read(root)?;
    style::check(root, &settings, (folder, assets))?;
    keys::read(root)?;
    // If the camera has a position but no focal point, its direction depends on parts that are not read yet.
    let is_whole = |camera: &Entry<'_>| {
        let has = |key: &str| camera.node.get(key).is_some();
        has("focal_point") || !has("position")
    };
    if let Some(camera) = root.get("camera").filter(is_whole) {
        let anything = Bounds::from_points([DVec3::ZERO, DVec3::ONE]);
        camera::read(&camera, &anything, Fit::default())?;
    }
    for entry in root.tables("part")? {
        let table = entry.table(parts::KEYS.all())?;
        if let Some(hatch) = scene_assets::of_material(&table, "hatch")? {
            hatches::check(&hatch, folder, assets)?;
        }
        if let Some(cap) = scene_assets::of_material(&table, "cap")? {
            cap_materials::check(&cap, folder, assets)?;
        }
        match (table.get("shape"), table.get("mesh")) {
            (Some(shape), _) => {
                shapes::check(&spec_of(&shape)?).map_err(|e| shape.place(e))?;
            }
            (None, Some(mesh)) => must_be_there(&mesh, folder, assets)?,
            (None, None) => {}
        }
    }
    for entry in root.tables("cut")? {
        let volume = entry.table(cuts::KEYS.all())?.get("volume");
        match volume {
            Some(shape) if shape.text()?.starts_with("shape:") => {
                shapes::check(shape.text()?).map_err(|e| shape.place(e))?;
            }
            Some(mesh) => must_be_there(&mesh, folder, assets)?,
            None => {}
        }
    }
    Ok(())
}

/// Refuses unknown keys at all levels.
fn must_be_known(entry: &Entry<'_>, above: &str) -> Result<()> {
    let below = |key: &str| match above {
        "" => key.to_owned(),
        above => format!("{above}.{key}"),
    };
    let known = keys_below(above);
    let is_named = known.contains(&"*");
    if entry.is_list() && !known.is_empty() {
        // A `box` may also be a list of boxes, although the known paths only have a single one.
        let above = if is_named {
            below("*")
        } else {
            above.to_owned()
        };
        return (entry.list()?.into_iter()).try_for_each(|e| must_be_known(&e.named(), &above));
    }
    if !entry.is_table() || known.is_empty() {
        return Ok(());
    }
    let table = if is_named {
        entry.open_table()?
    } else {
        entry.table(&known)?
    };
    let mut all = table.all();
    all.try_for_each(|(key, e)| must_be_known(&e, &below(if is_named { "*" } else { key })))
}

fn must_be_there(entry: &Entry<'_>, folder: &Path, assets: &Assets) -> Result<()> {
    let path = folder.join(entry.text()?);
    if assets.has_mesh(&path) || Pattern::is_in(entry.text()?) {
        return Ok(());
    }
    Err(missing(entry, &path))
}
