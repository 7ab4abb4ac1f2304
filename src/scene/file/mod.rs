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
//!
//! [[cut]]
//! volume = "shape:sphere"                # or a mesh file: what is inside is removed, if it is closed
//! scale = 0.3                            # placed as parts are: `translate`, `rotate_deg`, `scale`, `pivot`, `matrix`
//! translate = [0.5, 0, 0]
//! flip = false                           # true removes what is outside
//! ```
//!
//! # Cuts
//!
//! A cut removes what all of its `surfaces`, its `box` and its `wedge` remove; the scene removes the union of its cuts.
//!
//! ```toml
//! [[cut]]
//! name = "slice"
//! applies_to = ["*"]
//! except = ["core"]
//! offset = { mantle = 0.08, "crust*" = "5%" }   # so much more of these parts is kept; percent of the diagonal
//! enabled = true
//! wedge = { axis = "z", from_deg = 0, to_deg = 90, relief = "ragged", faces = ["from", "to"] }
//!
//! [[cut]]
//! box = { min = ["50%", 0, 0], max = ["100%", 1, 1] }
//! ```
//!
//! An offset moves every clip-surface of the cut, relief and all, towards the side that is removed: the part stands out of the
//! cut. Where several globs fit a part, its own name has to be there and counts.
//!
//! # The camera
//!
//! Without `[camera]` the scene is seen from the side, turned to where most faces of its cuts are seen. With it nothing is turned.
//!
//! ```toml
//! [camera]
//! azimuth_deg = 35                       # or `position`, `focal_point` and `view_up`
//! elevation_deg = 25
//! up = "+Z"                              # images on sections stand upright by it
//! near = 0.5                             # distance of the near plane
//! near_cap = false                       # true, which is usual, shows a cap where the near plane cuts a solid
//! ```
//!
//! Without `near_cap` a ray that begins inside a solid shows neither the near plane's section nor the wall by which it leaves the
//! solid, but the next surface or cap that it enters.
//!
//! # How heights are read
//!
//! `height_filter = "hardware"`, before all tables, reads reliefs through the sampler of the GPU where a strategy asks for heights at
//! points; `"exact"`, which is usual, from four texels.
//!
//! # What moves
//!
//! A `[[key]]` moves any number of `camera`, `part`, `relief` and `cut`, or a list of them, in time. `interpolation` is
//! `"linear"`, `"step"` or `"smooth"`. The number has to be in the file, as a number: those in texts such as `"6%"` stay. What is
//! `true` or `false`, as `cut.slice.enabled`, is moved by such values in steps.
//!
//! ```toml
//! [[part]]
//! name = "bar"
//! shape = "cube?divisions=20"
//! pivot = "centre"                      # about which it is scaled and turned; or a point; the origin otherwise
//! rotate_deg = [0, 0, 0]
//! deform = [
//!   { kind = "twist", axis = "y", turn_deg = 90 },     # from one end of the part to the other
//!   { kind = "bend", turn_deg = 45, across = "x" },    # along the longest side, rolled towards x
//!   { kind = "wave", amplitude = "2%", period = 0.5, phase_deg = 0 },
//!   { kind = "inflate", by = 0.01 },
//! ]
//!
//! [[part]]
//! name = "walker"
//! mesh = "frames/walk_%04d.ply"         # one mesh per frame
//! fps = 24
//! first = 1                             # without it 0 or 1
//! loop = false                          # true without it
//!
//! [[part]]
//! name = "left"
//! mesh = "gearbox.glb"
//! only = ["gear 2"]                     # or `except`: some of the solids of a file
//! defects = [{ kind = "holes", amount = "5%", seed = 1 }]   # broken on purpose, once: see `scene::defects`
//!
//! [[key]]
//! target = "part.bar.deform.0.turn_deg"
//! times_s = [0, 2]
//! values = [0, 360]
//! ```

mod camera;
mod cuts;
mod cutters;
mod defects;
mod deform;
mod keys;
mod parts;
pub(crate) mod reader;
mod regions;
mod reliefs;
mod script;
mod stock;
mod target;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use glam::Vec3;

pub use keys::{Interpolation, Key};
pub use parts::parse_color;
use reader::{Entry, Source, Table};
pub(super) use script::Script;

use super::document::Document;
use super::motion::Outwards;
use super::{Bounds, Camera, HeightFilter, Part, Scene, Timeline};
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
    "height_filter",
];

/// Everything a scene file says.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// What is drawn where nobody asks for a time: the numbers as they are written, frames at their first.
    pub scene: Scene,
    /// The scene at any time.
    pub timeline: Timeline,
    /// Whether it says where the scene is seen from: without `[camera]` that is for others to choose.
    pub has_camera: bool,
    /// Name of the strategy it asks for; whether there is such a one is for others to say.
    pub strategy: Option<String>,
    /// Width and height in pixels it asks for.
    pub resolution: Option<[u32; 2]>,
    /// Colour behind everything, as sRGB in 0..=1.
    pub background: Option<Vec3>,
    /// Colour of caps that several solids share, as sRGB in 0..=1, where they are to be shown.
    pub interference: Option<Vec3>,
    /// Who interpolates the heights of reliefs.
    pub height_filter: Option<HeightFilter>,
    /// Numbers of the scene over time.
    pub keys: Vec<Key>,
    /// What the user should know: what was mended in a mesh, and what was read without effect.
    pub notes: Vec<String>,
    /// Files that were read here: its own, and the images of its reliefs. Those of meshes are known to their reader.
    pub files: Vec<PathBuf>,
}

/// What the reader of a mesh file gives: the parts, and notes about what was mended in them.
pub type OpenedMesh = Result<(Vec<Part>, Vec<String>)>;

/// A reader of mesh files; frames are read in parallel.
pub type OpenMesh<'a> = dyn Fn(&Path) -> OpenedMesh + Sync + 'a;

/// The readers handed in by the caller.
struct Loaders<'a> {
    open_mesh: &'a OpenMesh<'a>,
    open_shape: &'a dyn Fn(&str) -> Result<Vec<Part>>,
}

/// Reads a scene file, and opens all that it names: [`load_scene`] of its [`Document`].
pub fn load_scene_file(
    path: &Path,
    open_mesh: &OpenMesh<'_>,
    open_shape: &dyn Fn(&str) -> Result<Vec<Part>>,
) -> Result<SceneFile> {
    load_scene(&Document::read(path)?, open_mesh, open_shape)
}

/// Reads a document, and opens all that it names. `open_mesh` gives the parts of a mesh file and notes about them,
/// `open_shape` the parts of a built-in shape such as `crank?holes=3`. Keys are tried at all their times and between.
pub fn load_scene(
    document: &Document,
    open_mesh: &OpenMesh<'_>,
    open_shape: &dyn Fn(&str) -> Result<Vec<Part>>,
) -> Result<SceneFile> {
    let path = document.path();
    let loaders = Loaders {
        open_mesh,
        open_shape,
    };
    let source = Source { path, moment: None };
    let root = Table::of_file(source, document.root(), KEYS)?;
    read(&root, path, &loaders)
}

fn read(root: &Table<'_>, path: &Path, loaders: &Loaders<'_>) -> Result<SceneFile> {
    let mut notes = Vec::new();
    let entries = root.tables("part")?;
    names_differ(&entries)?;
    let script = Script {
        path: path.to_owned(),
        root: root.entry.node.clone(),
        stock: stock::open(&entries, folder(path), loaders, &mut notes)?,
        cutters: cutters::open(&root.tables("cut")?, folder(path), loaders, &mut notes)?,
        keys: Vec::new(),
        reliefs: Mutex::default(),
        outwards: Outwards::default(),
    };
    let contents = read_parts(root, &script, 0.0, &mut notes)?;
    let scene = script.scene_of(root, contents, None, &mut notes)?;
    let strategy = match root.get("strategy") {
        Some(entry) => {
            let name = entry.table(&["name"])?.need("name", "\"raycast+mask\"")?;
            Some(name.text()?.to_owned())
        }
        None => None,
    };
    let keys = keys::read(root)?;
    let script = Script { keys, ..script };
    Ok(SceneFile {
        scene,
        has_camera: root.get("camera").is_some(),
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
        height_filter: root
            .get("height_filter")
            .map(|e| {
                let [exact, hardware] = [HeightFilter::Exact, HeightFilter::Hardware];
                e.choice(&[("exact", exact), ("hardware", hardware)])
            })
            .transpose()?,
        keys: script.keys().cloned().collect(),
        notes,
        files: script.files(),
        timeline: Timeline::of_script(Arc::new(script))?,
    })
}

fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or_else(|| Path::new(""))
}

/// Parts at a time, and the names of those that there are at any time.
struct Contents {
    parts: Vec<Part>,
    names: Vec<String>,
}

fn read_parts(
    root: &Table<'_>,
    script: &Script,
    time_s: f64,
    notes: &mut Vec<String>,
) -> Result<Contents> {
    let mut contents = Contents {
        parts: Vec::new(),
        names: Vec::new(),
    };
    for (entry, held) in root.tables("part")?.iter().zip(&script.stock) {
        let name = entry.open_table()?.get("name");
        let name = name.map(|n| n.text()).transpose()?;
        contents.names.extend(held.names(name));
        let parts = parts::read(entry, held, time_s, &script.outwards, notes)?;
        contents.parts.extend(parts);
    }
    if contents.parts.is_empty() {
        let mend = "add `[[part]]` with `mesh = \"FILE\"` or `shape = \"crank\"`";
        return Err(Error::file(&script.path, "the scene has no part", mend));
    }
    Ok(contents)
}

fn read_scene(
    root: &Table<'_>,
    (path, cutters): (&Path, &[Option<cutters::Held>]),
    contents: Contents,
    stage: Option<Bounds>,
    reliefs: &mut reliefs::Resolved,
    notes: &mut Vec<String>,
) -> Result<Scene> {
    let mut scene = Scene {
        name: path
            .file_stem()
            .map_or_else(String::new, |s| s.to_string_lossy().into_owned()),
        parts: contents.parts,
        cuts: Vec::new(),
        camera: root
            .get("camera")
            .map_or(Ok(Camera::default()), |c| camera::read(&c))?,
        stage,
    };
    let maps = match root.get("relief") {
        Some(entry) => reliefs::read(&entry, folder(path), reliefs)?,
        None => reliefs::Maps::new(),
    };
    let context = cuts::Context {
        bounds: scene.bounds(),
        up: scene.camera.up,
        parts: &scene.parts,
        names: &contents.names,
        maps: &maps,
    };
    let entries = root.tables("cut")?;
    names_differ(&entries)?;
    let numbered = entries.iter().enumerate();
    let read = numbered.map(|(i, entry)| {
        let cutter = cutters.get(i).and_then(Option::as_ref);
        cuts::read(entry, i, cutter, &context, notes)
    });
    scene.cuts = read.collect::<Result<Vec<_>>>()?.concat();
    Ok(scene)
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
