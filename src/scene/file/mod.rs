//! Scene files: TOML that says what is cut, how, and from where it is seen.
//!
//! Every unknown key is an error with the nearest known one; every number has to be finite. Paths are relative to the
//! scene file. The readers of meshes and shapes are handed in, so that this module knows no format but its own.
//!
//! ```toml
//! [[part]]
//! name = "crank"
//! shape = "crank"
//! material = { color = "#8a94a6" }
//!
//! [relief.ragged]
//! kind = "fractal"
//!
//! [[cut]]
//! name = "front"
//! surfaces = [{ section = "-z=50%", relief = "ragged", amplitude = "6%" }]
//! ```

mod camera;
mod cuts;
mod keys;
mod parts;
mod reader;
mod reliefs;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::Vec3;
use toml::de::{DeTable, DeValue};

pub use keys::Key;
pub use parts::parse_color;
use reader::{Entry, Source, Table};

use super::{Camera, Part, Scene};
use crate::error::{Error, Result};

const KEYS: &[&str] = &[
    "camera",
    "part",
    "relief",
    "cut",
    "strategy",
    "key",
    "resolution",
    "background",
    "interference",
];

/// Everything a scene file says.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// What is drawn.
    pub scene: Scene,
    /// Name of the strategy it asks for; whether there is such a one is for others to say.
    pub strategy: Option<String>,
    /// Width and height in pixels it asks for.
    pub resolution: Option<[u32; 2]>,
    /// Colour behind everything, as sRGB in 0..=1.
    pub background: Option<Vec3>,
    /// Colour of caps that several solids share, as sRGB in 0..=1, where they are to be shown.
    pub interference: Option<Vec3>,
    /// Numbers of the scene over time.
    pub keys: Vec<Key>,
    /// What the user should know: what was mended in a mesh, and what was read without effect.
    pub notes: Vec<String>,
}

/// What the reader of a mesh file gives: the parts, and notes about what was mended in them.
pub type OpenedMesh = Result<(Vec<Part>, Vec<String>)>;

/// The readers handed in by the caller.
struct Loaders<'a> {
    open_mesh: &'a dyn Fn(&Path) -> OpenedMesh,
    open_shape: &'a dyn Fn(&str) -> Result<Vec<Part>>,
}

/// Reads a scene file. `open_mesh` gives the parts of a mesh file and notes about them, `open_shape` the parts of a
/// built-in shape such as `crank?holes=3`.
pub fn load_scene_file(
    path: &Path,
    open_mesh: &dyn Fn(&Path) -> OpenedMesh,
    open_shape: &dyn Fn(&str) -> Result<Vec<Part>>,
) -> Result<SceneFile> {
    let text = std::fs::read_to_string(path).map_err(|e| {
        let mend = "check the path; a scene file is TOML text in UTF-8";
        Error::file(path, format!("cannot be read: {e}"), mend)
    })?;
    let source = Source { path, text: &text };
    let root = DeTable::parse(&text).map_err(|e| {
        let line = source.line(e.span().map_or(0, |s| s.start));
        let mend = "correct the TOML: `key = value`, texts in double quotes, tables in [brackets]";
        Error::file_line(path, line, e.message().trim_end(), mend)
    })?;
    let root = DeValue::Table(root.into_inner());
    let loaders = Loaders {
        open_mesh,
        open_shape,
    };
    read(&Table::of_file(&source, &root, KEYS)?, path, &loaders)
}

fn read(root: &Table<'_>, path: &Path, loaders: &Loaders<'_>) -> Result<SceneFile> {
    let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    let mut notes = Vec::new();
    let mut parts = Vec::new();
    let entries = root.tables("part")?;
    names_differ(&entries)?;
    for entry in &entries {
        parts.extend(parts::read(entry, &folder, loaders, &mut notes)?);
    }
    if parts.is_empty() {
        let mend = "add `[[part]]` with `mesh = \"FILE\"` or `shape = \"crank\"`";
        return Err(Error::file(path, "the scene has no part", mend));
    }
    let mut scene = Scene {
        name: path
            .file_stem()
            .map_or_else(String::new, |s| s.to_string_lossy().into_owned()),
        parts,
        cuts: Vec::new(),
        camera: root
            .get("camera")
            .map_or(Ok(Camera::default()), |c| camera::read(&c))?,
        stage: None,
    };
    let maps = match root.get("relief") {
        Some(reliefs) => reliefs::read(&reliefs, &folder)?,
        None => reliefs::Maps::new(),
    };
    let context = cuts::Context {
        bounds: scene.bounds(),
        parts: &scene.parts,
        maps: &maps,
    };
    let entries = root.tables("cut")?;
    names_differ(&entries)?;
    let numbered = entries.iter().enumerate();
    scene.cuts = numbered
        .map(|(i, entry)| cuts::read(entry, i, &context, &mut notes))
        .collect::<Result<_>>()?;
    let keys: Vec<Key> = root
        .tables("key")?
        .iter()
        .map(|entry| keys::read(entry, &scene.parts, &scene.cuts))
        .collect::<Result<_>>()?;
    if !keys.is_empty() {
        notes.push("keys are read but not yet evaluated: the scene is shown as it stands".into());
    }
    let strategy = match root.get("strategy") {
        Some(entry) => {
            let name = entry.table(&["name"])?.need("name", "\"raycast+mask\"")?;
            Some(name.text()?.to_owned())
        }
        None => None,
    };
    Ok(SceneFile {
        scene,
        strategy,
        resolution: root.get("resolution").map(|e| resolution(&e)).transpose()?,
        background: root
            .get("background")
            .map(|e| parts::color(&e))
            .transpose()?,
        interference: root
            .get("interference")
            .map(|e| parts::color(&e))
            .transpose()?,
        keys,
        notes,
    })
}

/// Names tell entries apart in globs, errors and animation keys.
fn names_differ(entries: &[Entry<'_>]) -> Result<()> {
    let mut seen = BTreeSet::new();
    match entries
        .iter()
        .find(|entry| !seen.insert(entry.key.as_str()))
    {
        Some(entry) => Err(entry.fault("the name is taken", "give every entry its own name")),
        None => Ok(()),
    }
}

fn resolution(entry: &Entry<'_>) -> Result<[u32; 2]> {
    const LARGEST: u32 = 16_384;
    let fault = || {
        let what = format!("it must be two whole numbers from 1 to {LARGEST}");
        entry.fault(what, "write for example `resolution = [1024, 768]`")
    };
    match entry.list()?.as_slice() {
        [w, h] => {
            let size = [w.whole::<u32>()?, h.whole::<u32>()?];
            if size.iter().all(|n| (1..=LARGEST).contains(n)) {
                Ok(size)
            } else {
                Err(fault())
            }
        }
        _ => Err(fault()),
    }
}
