//! Which way is up in meshes of a command line that do not say it: guessed by what they stand on, and said.
//!
//! STL and PLY have no up axis. It is guessed only where nothing but such meshes is drawn and `--up` is not given; a scene file says it, or
//! means +Y.

use std::path::Path;

use super::camera::find_angles;
use crate::Result;
use crate::document::{Document, Node};
use crate::load::{Assets, up_by_habit};
use crate::scene::{Part, Up, standing_up};

/// Puts the axis that is up into a document of meshes alone; what is to be said of it.
pub(super) fn guess(document: &mut Document, assets: &mut Assets) -> Result<Option<String>> {
    let camera = document.root().get("camera");
    // A picture whose own direction up is given needs no axis.
    let is_said = camera.is_some_and(|c| c.get("up").is_some() || c.get("view_up").is_some());
    if is_said || !document.path().as_os_str().is_empty() {
        return Ok(None);
    }
    let is_new = camera.is_none();
    let entries = document.root().get("part").map_or(&[] as &[_], Node::items);
    let meshes: Option<Vec<&Path>> = entries
        .iter()
        .map(|entry| Some(Path::new(entry.get("mesh")?.text()?)))
        .collect();
    let meshes = meshes.unwrap_or_default();
    let habits: Option<Vec<Up>> = meshes.iter().map(|path| up_by_habit(path)).collect();
    let Some(habit) = habits.and_then(|habits| habits.first().copied()) else {
        return Ok(None);
    };
    if !meshes.iter().all(|path| assets.has_mesh(path)) {
        return Ok(None);
    }
    let mut parts: Vec<Part> = Vec::new();
    for path in meshes {
        parts.extend(assets.mesh(path)?.parts.iter().cloned());
    }
    let up = standing_up(&parts, habit);
    let [own, other] = match up {
        Up::PlusY => ["+Y", "+Z"],
        Up::PlusZ => ["+Z", "+Y"],
    };
    document.set("camera.up", own)?;
    if is_new {
        find_angles(document)?;
    }
    let why = match up == habit {
        true => "the habit of the format",
        false => "it stands on a flat base that way",
    };
    Ok(Some(format!(
        "up is guessed: {own} ({why}); --up {other} changes it"
    )))
}
