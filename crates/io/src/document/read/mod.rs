//! The readers of a document: parts, cuts, camera and style.
//!
//! Every unknown key is an error, which suggests the nearest known key. Every number must be finite. Paths are relative to the scene file.
//!
//! ```toml
//! [[part]]
//! name = "crank"
//! shape = "crank"                        # or `{ name = "crank", throws = 3 }`, whose numbers have paths
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
//! volume = "shape:sphere"                # or a closed mesh file: the region inside it is removed
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
//! offset = { mantle = 0.08, "crust*" = "5%" }   # how much more of these parts is kept; percent of the diagonal
//! enabled = true
//! wedge = { axis = "z", from_deg = 0, to_deg = 90, relief = "ragged", faces = ["from", "to"] }   # or a list of wedges
//!
//! [[cut]]
//! box = { min = ["50%", 0, 0], max = ["100%", 1, 1] }
//! ```
//!
//! For a part with an offset, every clip-surface of the cut and its relief move towards the removed side, so that the part protrudes. If
//! several globs match a part, an entry with its exact name is required, and is used.
//!
//! # The camera
//!
//! Without `[camera]` the scene is seen from the side from which most faces of its cuts are visible. With `[camera]` only angles that are
//! `"auto"` are found this way.
//!
//! ```toml
//! [camera]
//! azimuth_deg = 35                       # or `position`, `focal_point` and `view_up`; or `view`:
//! elevation_deg = 25                     # "front", "back", "left", "right", "top", "bottom", "iso", or "cut", facing the section
//! up = "+Z"                              # also the upright direction of images on sections
//! fit = "kept"                           # framing of an orbit: the geometry that the cuts keep, or "all"
//! zoom = 2                               # magnification relative to the fitted view
//! pan = [0.1, 0]                         # moves the model right and up, in picture heights
//! near = 0.5                             # distance of the near plane
//! near_cap = false                       # true, the default, shows a cap where the near plane cuts a solid
//! ```
//!
//! With `near_cap = false`, a ray that begins inside a solid does not show the near plane's section, nor the surface where it leaves the
//! solid. It shows the next surface or cap through which it enters a solid.
//!
//! # Height filter
//!
//! With `height_filter = "hardware"`, strategies that need the height at a point read the relief through the GPU's sampler. With `"exact"`,
//! the default, they compute the height from four texels.
//!
//! # Picture settings
//!
//! These keys set defaults for the picture. They must precede all tables.
//!
//! ```toml
//! resolution = [1024, 768]
//! background = "#ffffff"                 # or "paper", "gradient", "transparent"
//! style = "technical"                    # or [style] with base = "technical" and changes
//! interference = "#ff00aa"               # hatches caps where several solids overlap
//! supersample = 2                        # samples per pixel along each side, 1 to 4
//! time_s = 0.5                           # time of the picture
//! clip = "walk"                          # animation to play, by name or number
//!
//! [strategy]
//! name = "raycast+mask"
//! rasteriser = "compute"
//! ```
//!
//! # Animation
//!
//! A `[[key]]` animates any number of `camera`, `part`, `relief` and `cut`, or a list of numbers. `interpolation` is `"linear"`, `"step"`
//! or `"smooth"`. The number must be in the file, as a number: a text such as `"6%"` cannot be animated. A flag such as `cut.slice.enabled`
//! is animated by the values `true` and `false`, in steps.
//!
//! ```toml
//! [[part]]
//! name = "bar"
//! shape = "cube?divisions=20"
//! pivot = "centre"                      # fixed point of scale and rotation; or a point; default: the origin
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
//! first = 1                             # default: 0 or 1
//! loop = false                          # default: true
//!
//! [[part]]
//! name = "left"
//! mesh = "gearbox.glb"
//! only = ["gear 2"]                     # or `except`: takes some of the solids of a file
//! defects = [{ kind = "holes", amount = "5%", seed = 1 }]   # deliberate damage, applied once: see `scene::defects`
//!
//! [[key]]
//! target = "part.bar.deform.0.turn_deg"
//! times_s = [0, 2]
//! values = [0, 360]
//! ```
//!
//! # Parts of a file
//!
//! A file with one solid becomes one part, and a file with several one part `NAME/SOLID` each. With `split`, each connected body is a part.
//!
//! ```toml
//! [[part]]
//! name = "drive"
//! mesh = "gearbox.stl"
//! split = true                          # "drive/1", "drive/2", ... in the order of their first triangles
//! except = ["gearbox/7"]                # `only` and `except` apply after the split, and name bodies by the file's name
//! ```
//!
//! If a file has several solids, bodies are named `NAME/SOLID/1`, and globs match `SOLID/1`. A solid with one body keeps its name. All
//! frames must have the first frame's triangles. Then `defects` apply, and `close_holes = true` closes the remaining holes.
//!
//! A part with `enabled = false` is read, but left out of the scene and of its bounds. The colours of other parts do not change. Globs may
//! still match a disabled part. At least one part has to be enabled at every time.

mod camera;
mod cap_materials;
mod check;
mod clip;
mod defects;
mod deform;
mod described;
mod hatches;
mod keys;
mod known;
mod opening;
mod part_source;
mod parts;
pub mod reader;
mod roles;
mod scene_assets;
mod solids;
mod style;
mod table;
mod target;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

use cutaway::error::{Diagnostic, Result};
use cutaway::generate::defects::Defect;
use cutaway::scene::{Bounds, ClipSurface, Fit, Outwards, Part, Scene, Style, Up};

use super::Settings;
use super::node::Node;
use super::paths::keys_below;
use crate::load::Assets;
use opening::LoadContext;
use reader::{Entry, Source, Table};

pub(super) use camera::Seen;
pub(super) use check::check;
pub(super) use clip::cutaways::cutouts;
pub(super) use clip::reliefs::Resolved;
pub use described::parse_value;
pub use keys::Key;
pub(super) use keys::{Keyed, KeyedTime};
pub(super) use known::sights_of;
pub(super) use part_source::PartSource;
pub(super) use parts::all as parts_with_roles;
pub use roles::RoleBy;
pub(super) use scene_assets::SceneAssets;
pub(super) use style::is_file as is_style_file;
pub use style::{named_style, style_names};

/// Keys of a scene. `case` has no effect on the picture. It states what is expected of a scene in `experiments/hard-cases`.
static KEYS: LazyLock<Vec<&str>> = LazyLock::new(|| [keys_below(""), vec!["case"]].concat());

/// The root table of a document, with the time and the keys if the document is animated.
pub(super) fn root<'a>(
    path: &'a Path,
    node: &'a Node,
    moment: Option<KeyedTime<'a>>,
) -> Result<Table<'a>> {
    Table::of_file(Source { path, moment }, node, &KEYS)
}

/// The document as a table, whose keys are not checked.
pub(super) fn top<'a>(path: &'a Path, node: &'a Node) -> Result<Table<'a>> {
    Entry::root(Source { path, moment: None }, node).open_table()
}

/// Opens all files that a document names.
pub(super) fn open(root: &Table<'_>, folder: &Path, assets: &mut Assets) -> Result<SceneAssets> {
    let mut opening = LoadContext {
        folder,
        assets,
        notes: Vec::new(),
        files: BTreeSet::new(),
    };
    let (parts, cuts) = (root.tables("part")?, root.tables("cut")?);
    names_differ(&parts)?;
    names_differ(&cuts)?;
    if parts.is_empty() {
        let help = "add `[[part]]` with `mesh = \"FILE\"` or `shape = \"crank\"`";
        return Err(root.entry.fault("the scene has no part", help));
    }
    let parts = scene_assets::open(&parts, &mut opening)?;
    let cutters = clip::cutters::open(&cuts, &mut opening)?;
    let images = clip::reliefs::open(root, folder, opening.assets)?;
    let style = style::open(root, &mut opening)?;
    opening.files.extend(images.files().cloned());
    Ok(SceneAssets {
        parts,
        cutters,
        images,
        style,
        fit: Fit::default(),
        sights: None,
        frames: BTreeMap::new(),
        notes: opening.notes,
        files: opening.files,
    })
}

/// Settings of a document that are not part of the scene itself.
pub(super) fn settings(root: &Table<'_>) -> Result<Settings> {
    described::read(root)
}

/// Animation keys.
pub(super) fn keys(root: &Table<'_>) -> Result<Vec<Keyed>> {
    keys::read(root)
}

/// The parts at a time.
pub(super) fn parts(
    root: &Table<'_>,
    scene_assets: &SceneAssets,
    time_s: f64,
    outwards: &Outwards,
) -> Result<Vec<Part>> {
    let parts = parts::all(root, scene_assets, time_s, outwards)?;
    Ok(parts.into_iter().map(|(part, _)| part).collect())
}

/// Returns notes about the roles of the given parts. Fails if the roles name a part that does not exist at any time.
pub(super) fn role_notes(
    root: &Table<'_>,
    scene_assets: &SceneAssets,
    parts: &[Part],
) -> Result<Vec<Diagnostic>> {
    let roles = roles::read(root)?;
    let materials = scene_assets.parts.iter().flat_map(PartSource::materials);
    let names = names_of(scene_assets).into_iter().chain(materials);
    roles.must_name(root, &names.collect::<Vec<_>>())?;
    Ok(roles.notes(parts))
}

/// Names of all parts that exist at any time.
fn names_of(scene_assets: &SceneAssets) -> Vec<&str> {
    let names = scene_assets.parts.iter().flat_map(PartSource::names);
    names.map(String::as_str).collect()
}

/// Returns true if roles are derived from the visibility from outside.
pub(super) fn finds_roles(root: &Table<'_>) -> Result<bool> {
    Ok(roles::read(root)?.auto)
}

/// Style of the document.
pub(super) fn style(
    root: &Table<'_>,
    scene_assets: &SceneAssets,
    settings: &Settings,
) -> Result<Style> {
    style::read(root, scene_assets.style.unwrap_or_default(), settings)
}

/// Returns the scene that has these parts, and its camera.
pub(super) fn scene(
    root: &Table<'_>,
    scene_assets: &SceneAssets,
    (parts, stage): (Vec<Part>, Option<Bounds>),
    reliefs: &mut Resolved,
    notes: &mut Vec<Diagnostic>,
) -> Result<(Scene, Seen)> {
    let settings = settings(root)?;
    let mut scene = Scene {
        parts,
        stage,
        interference: settings.interference,
        style: style(root, scene_assets, &settings)?,
        ..Scene::default()
    };
    let bounds = scene.bounds();
    let camera = (root.get("camera")).map(|e| camera::read(&e, &bounds, scene_assets.fit));
    let seen = camera.transpose()?.unwrap_or(Seen::usual(scene_assets.fit));
    scene.camera = seen.camera;
    let maps = match root.get("relief") {
        Some(entry) => clip::reliefs::read(&entry, &scene_assets.images, reliefs)?,
        None => clip::reliefs::Maps::new(),
    };
    let names = names_of(scene_assets);
    let context = clip::cuts::Context {
        bounds,
        up: scene.camera.up,
        parts: &scene.parts,
        names: &names,
        maps: &maps,
    };
    let (mut cuts, mut faced) = (Vec::new(), None);
    for (i, entry) in root.tables("cut")?.iter().enumerate() {
        let cutter = scene_assets.cutters.get(i).and_then(Option::as_ref);
        let frame = scene_assets.frames.get(&i);
        let read = clip::cuts::read(entry, i, (cutter, frame), &context, notes)?;
        // The placement of a cutout depends on the camera.
        if faced.is_none() && entry.open_table()?.get("cutout").is_none() {
            faced = read.iter().find_map(|cut| cut.surfaces.first().cloned());
        }
        cuts.extend(read);
    }
    if seen.faces_cut {
        scene.camera.viewpoint = camera::facing_first(faced.as_ref(), scene.camera.up, root)?;
    }
    scene.cuts = cuts;
    Ok((scene, seen))
}

/// Reads a single defect.
pub(super) fn defect(defect: &Node) -> Result<Defect> {
    let nothing = Node::new(super::Value::Table(Vec::new()));
    let root = root(Path::new(""), &nothing, None)?;
    defects::read_one(&root.entry.at("defect", defect))
}

/// Reads a single clip-surface. Image paths are relative to the current folder.
pub(super) fn surface(
    surface: &Node,
    reliefs: &Node,
    (bounds, up): (&Bounds, Up),
    assets: &mut Assets,
) -> Result<ClipSurface> {
    let reliefs = vec![("relief".into(), reliefs.clone())];
    let table = Node::new(super::Value::Table(reliefs));
    let root = root(Path::new(""), &table, None)?;
    let images = clip::reliefs::open(&root, Path::new(""), assets)?;
    let maps = match root.get("relief") {
        Some(entry) => clip::reliefs::read(&entry, &images, &mut Resolved::default())?,
        None => clip::reliefs::Maps::new(),
    };
    let context = clip::cuts::Context {
        bounds: *bounds,
        up,
        parts: &[],
        names: &[],
        maps: &maps,
    };
    clip::cuts::surface(&root.entry.at("surface", surface), &context)
}

/// Refuses equal names, because names identify entries in globs, errors and animation keys.
fn names_differ(entries: &[Entry<'_>]) -> Result<()> {
    let mut seen = BTreeSet::new();
    for entry in entries {
        if !seen.insert(entry.key.as_str()) {
            return Err(entry.fault(
                "the name is taken by another entry",
                "give every entry its own name",
            ));
        }
    }
    Ok(())
}
