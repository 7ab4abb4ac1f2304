//! Documents built by programs and from command-line options: one expression builds the nodes of a scene file.
//!
//! ```
//! use cutaway_io::document::{Document, cut, part, section};
//! use cutaway_io::load::Assets;
//! let mut document = Document::new();
//! document.add_part(part("shape:crank").name("crank"))?;
//! document.add_cut(cut([section("-z=50%").relief("fractal:amplitude=4%,seed=7")]))?;
//! document.set("camera.azimuth_deg", 20.0)?;
//! let scene = document.resolve(0.0, &mut Assets::default())?;
//! assert_eq!(scene.cuts[0].surfaces.len(), 1);
//! # Ok::<(), cutaway::Error>(())
//! ```
//! An invalid word in a draft is reported when the draft is added. Each value records the words that it comes from, and errors about the
//! value quote these words.

use std::sync::Arc;

use cutaway::error::{Error, Result};
use cutaway::generate::defects::Defect;
use cutaway::scene::{Bounds, ClipSurface, Up};
use glam::DVec3;

use super::node::{Node, Origin, Value};
use super::read;
use super::spec::{self, Entries};
use crate::load::Assets;

pub(super) type TableEntries = Vec<(Arc<str>, Node)>;

/// A part to be added.
#[derive(Debug)]
pub struct PartDraft {
    pub(super) table: TableEntries,
    pub(super) origin: Origin,
    pub(super) fault: Option<Error>,
}

/// A clip-surface to be added, with its relief.
#[derive(Debug)]
pub struct SurfaceDraft {
    name: String,
    pub(super) table: TableEntries,
    pub(super) relief: Option<(String, Node)>,
    pub(super) origin: Origin,
    pub(super) fault: Option<Error>,
}

/// A cut to be added.
#[derive(Debug, Default)]
pub struct CutDraft {
    pub(super) surfaces: Vec<SurfaceDraft>,
    pub(super) boxes: Vec<Node>,
    pub(super) wedges: Vec<Node>,
    /// Names of the cut's surfaces and regions, from which its default name is built.
    pub(super) names: Vec<String>,
    pub(super) table: TableEntries,
    pub(super) fault: Option<Error>,
}

/// A part from a mesh file, numbered frames (`walk_%04d.ply`) or a built-in shape (`shape:crank?throws=3`).
pub fn part(model: &str) -> PartDraft {
    let origin = Origin::Option(model.into());
    let (key, value) = match model.strip_prefix("shape:") {
        Some(spec) => ("shape", spec),
        None => ("mesh", model),
    };
    let mut draft = PartDraft {
        table: TableEntries::new(),
        origin,
        fault: None,
    };
    put(&mut draft.table, key, value.into(), &draft.origin);
    draft
}

/// A plane whose normal points to the kept side: `z=10`, `-z=50%` (of the bounds), `nx,ny,nz@px,py,pz` or `nx,ny,nz,d`.
pub fn section(spec: &str) -> SurfaceDraft {
    let origin = Origin::Option(format!("section `{spec}`").into());
    SurfaceDraft::of(spec.to_owned(), origin, [("section", spec.into())])
}

/// A plane through a point, whose normal points to the kept side.
pub fn plane(normal: DVec3, origin: DVec3) -> SurfaceDraft {
    let list = |v: DVec3| Value::from(v.to_array().to_vec());
    let entries = [("normal", list(normal)), ("origin", list(origin))];
    SurfaceDraft::of("plane".to_owned(), Origin::Program, entries)
}

/// A cut with these surfaces. It removes the intersection of their removed sides.
pub fn cut(surfaces: impl IntoIterator<Item = SurfaceDraft>) -> CutDraft {
    let mut draft = CutDraft::default();
    for surface in surfaces {
        draft.names.push(surface.name.clone());
        draft.surfaces.push(surface);
    }
    draft
}

/// Sets a key of a table.
pub(super) fn put(table: &mut TableEntries, key: &str, value: Value, origin: &Origin) {
    let node = Node::new(value).said(origin);
    match table.iter_mut().find(|(name, _)| **name == *key) {
        Some((_, held)) => *held = node,
        None => table.push((key.into(), node)),
    }
}

fn table_of(entries: Entries, origin: &Origin) -> Node {
    let mut table = TableEntries::new();
    for (key, value) in entries {
        put(&mut table, &key, value, origin);
    }
    Node {
        value: Value::Table(table),
        origin: origin.clone(),
    }
}

impl PartDraft {
    /// Sets the name used in paths and globs.
    #[must_use]
    pub fn name(self, name: &str) -> Self {
        self.with("name", name)
    }

    /// Sets any other key of `[[part]]`.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        put(&mut self.table, key, value.into(), &self.origin);
        self
    }

    /// Adds a mesh defect, given as `holes:amount=5%,seed=1`.
    #[must_use]
    pub fn defect(mut self, words: &str) -> Self {
        match defect(words) {
            Ok(node) => {
                let held = self.table.iter_mut().find(|(key, _)| **key == *"defects");
                match held.map(|(_, node)| &mut node.value) {
                    Some(Value::List(list)) => list.push(node),
                    _ => self
                        .table
                        .push(("defects".into(), Node::new(Value::List(vec![node])))),
                }
            }
            Err(e) => self.fault = self.fault.or(Some(e)),
        }
        self
    }
}

/// Parses a defect such as `holes:amount=5%,seed=1` into an entry of a part's `defects` list.
///
/// # Errors
///
/// Fails if the words do not describe a defect.
pub fn defect(words: &str) -> Result<Node> {
    let origin = Origin::Option(format!("defect `{words}`").into());
    let node = table_of(spec::defect(words)?, &origin);
    read::defect(&node)?;
    Ok(node)
}

/// Parses words into a defect.
///
/// # Errors
///
/// Fails if the words do not describe a defect.
pub fn parse_defect(words: &str) -> Result<Defect> {
    read::defect(&defect(words)?)
}

impl SurfaceDraft {
    fn of<const N: usize>(name: String, origin: Origin, entries: [(&str, Value); N]) -> Self {
        let mut draft = Self {
            name,
            table: TableEntries::new(),
            relief: None,
            origin,
            fault: None,
        };
        for (key, value) in entries {
            put(&mut draft.table, key, value, &draft.origin);
        }
        draft
    }

    /// Adds a relief, given as `fractal:amplitude=5%,period=40%,seed=7` or as an image file.
    #[must_use]
    pub fn relief(mut self, words: &str) -> Self {
        let origin = Origin::Option(format!("relief `{words}`").into());
        match spec::relief(words) {
            Ok(words) => {
                for (key, value) in words.placement {
                    put(&mut self.table, &key, value, &origin);
                }
                self.relief = Some((words.name, table_of(words.relief, &origin)));
            }
            Err(e) => self.fault = self.fault.or(Some(e)),
        }
        self
    }

    /// Keeps the other side.
    #[must_use]
    pub fn flip(self) -> Self {
        self.with("flip", true)
    }

    /// Sets any other key of a surface.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        put(&mut self.table, key, value.into(), &self.origin);
        self
    }

    /// Builds the clip-surface for a model with these bounds, where +Y is up. Images are read from the current folder.
    ///
    /// # Errors
    ///
    /// Fails if the words are invalid, or give no surface for these bounds.
    pub fn on(self, bounds: &Bounds) -> Result<ClipSurface> {
        self.on_from(bounds, &mut Assets::default())
    }

    /// Builds the clip-surface like [`SurfaceDraft::on`], but takes images from `assets`.
    ///
    /// # Errors
    ///
    /// The errors of [`SurfaceDraft::on`].
    pub fn on_from(self, bounds: &Bounds, assets: &mut Assets) -> Result<ClipSurface> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        let mut table = self.table;
        let reliefs = self.relief.map(|(_, relief)| {
            put(&mut table, "relief", "relief".into(), &relief.origin);
            (Arc::from("relief"), relief)
        });
        let reliefs = Node::new(Value::Table(reliefs.into_iter().collect()));
        let surface = Node {
            value: Value::Table(table),
            origin: self.origin,
        };
        read::surface(&surface, &reliefs, (bounds, Up::PlusY), assets)
    }
}

impl CutDraft {
    /// Sets the name; the default is built from the cut's surfaces.
    #[must_use]
    pub fn name(mut self, name: &str) -> Self {
        put(&mut self.table, "name", name.into(), &Origin::Program);
        self
    }

    /// Limits the removed region to a box `MIN:MAX`, such as `0,0,0:1,1,1`. In `50%,50%,50%:` the box has no upper bound.
    #[must_use]
    pub fn block(mut self, words: &str) -> Self {
        let name = format!("box {words}");
        let origin = Origin::Option(format!("box `{words}`").into());
        match spec::block(words) {
            Ok(table) => self.boxes.push(table_of(table, &origin)),
            Err(e) => self.fault = self.fault.or(Some(e)),
        }
        self.names.push(name);
        self
    }

    /// Limits the removed region to a wedge `AXIS:FROM:TO[@X,Y,Z]`, such as `z:0:90` or `-y:-30:200@0,50%,0`.
    #[must_use]
    pub fn wedge(mut self, words: &str) -> Self {
        let name = format!("wedge {words}");
        let origin = Origin::Option(format!("wedge `{words}`").into());
        match spec::wedge(words) {
            Ok(table) => self.wedges.push(table_of(table, &origin)),
            Err(e) => self.fault = self.fault.or(Some(e)),
        }
        self.names.push(name);
        self
    }

    /// Limits the removed region to a closed mesh, which is a file or `shape:NAME?param=value`.
    #[must_use]
    pub fn volume(mut self, model: &str) -> Self {
        let origin = Origin::Option(model.into());
        put(&mut self.table, "volume", model.into(), &origin);
        self.names.push(model.to_owned());
        self
    }

    /// Removes a wedge that is placed automatically: `ANGLE`, `key=value,...` with the keys of `cutout`, or empty for the defaults.
    #[must_use]
    pub fn cutout(self, words: &str) -> Self {
        self.opening("cutout", words, &["angle_deg", "axis", "turn_deg"])
    }

    /// Removes material in front of the interiors: `DISTANCE`, `key=value,...` with the keys of `breakaway`, or empty for the defaults.
    #[must_use]
    pub fn breakaway(self, words: &str) -> Self {
        let keys = ["distance", "bevel_deg", "clusters", "view"];
        self.opening("breakaway", words, &keys)
    }

    fn opening(mut self, name: &str, words: &str, keys: &[&str]) -> Self {
        let origin = Origin::Option(format!("{name} `{words}`").into());
        match spec::opening(words, name, keys) {
            Ok(entries) => {
                let table = table_of(entries, &origin);
                self.table.push((name.into(), table));
            }
            Err(e) => self.fault = self.fault.or(Some(e)),
        }
        self.names.push(name.to_owned());
        self
    }

    /// Excludes the parts whose names match one of these globs.
    #[must_use]
    pub fn except(mut self, globs: &[String]) -> Self {
        let node = |glob: &String| {
            let origin = Origin::Option(format!("--exclude {glob}").into());
            Node::new(glob.as_str()).said(&origin)
        };
        if !globs.is_empty() {
            let list = Node::new(Value::List(globs.iter().map(node).collect()));
            self.take("except", list);
        }
        self
    }

    /// Sets any other key of `[[cut]]`.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        put(&mut self.table, key, value.into(), &Origin::Program);
        self
    }

    /// Intersects two cuts: the result removes the region that both remove.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.surfaces.extend(other.surfaces);
        self.boxes.extend(other.boxes);
        self.wedges.extend(other.wedges);
        self.names.extend(other.names);
        for (key, node) in other.table {
            self.take(&key, node);
        }
        self.fault = self.fault.or(other.fault);
        self
    }

    /// Merges a key and its value into the cut. Lists are joined. Any other value must be the same in both cuts.
    fn take(&mut self, key: &str, node: Node) {
        let held = self.table.iter_mut().find(|(name, _)| **name == *key);
        match (held.map(|(_, held)| &mut held.value), node.value) {
            (None, value) => self.table.push((key.into(), Node { value, ..node })),
            (Some(Value::List(held)), Value::List(more)) => held.extend(more),
            (Some(Value::Text(held)), Value::Text(more)) if key == "name" => {
                *held = format!("{held} and {more}").into();
            }
            (Some(held), value) if *held == value => {}
            (Some(_), _) => {
                let what = "the two cuts have different values for it";
                let fault = Error::input(format!("`{key}`"), what, "make each a separate cut");
                self.fault.get_or_insert(fault);
            }
        }
    }
}
