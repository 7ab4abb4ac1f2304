//! The scene as a document: a tree read from a scene file, whose values are found and set by dotted paths.
//!
//! ```
//! use cutaway_io::document::{Document, Value};
//! let text = "[[part]]\nname = \"box\" # the solid\nshape = \"cube\"\n\n[camera]\nazimuth_deg = 35\n";
//! let mut document = Document::parse("scene.toml", text)?;
//! document.set("camera.azimuth_deg", 20.0)?;
//! document.set("part.box.shape", Value::read("sphere"))?;
//! assert!(document.to_string().contains("shape = \"sphere\""));
//! assert!(document.to_string().contains("# the solid"));
//! # Ok::<(), cutaway::Error>(())
//! ```
//!
//! A path such as `cut.front.surfaces.0.amplitude` consists of table keys and of entry names or indices from 0. The `target` of `[[key]]`
//! has the same form. A document holds any TOML; the readers of [`Document::timeline`] interpret it.
//!
//! Memory cost: the tree and, after the first change, also the text with its comments. Both are changed together, and nothing is parsed
//! again.
//!
//! A key with a dot in its name cannot be added.

mod add;
mod address;
mod build;
mod describe;
mod edit;
mod files;
mod node;
mod parse;
pub mod paths;
mod read;
mod spec;
mod text;
mod timeline;
mod upright;

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::{Error, Result};
use cutaway::scene::Scene;
use toml_edit::DocumentMut;

use crate::load::{Assets, Disk, Files, input_file};
#[doc(hidden)]
pub use read::reader;

pub(crate) use address::{Lost, PathStep, astray, children, farther, walk};
pub use build::{
    CutDraft, PartDraft, SurfaceDraft, cut, defect, parse_defect, part, plane, section,
};
pub use describe::{Interpolation, Settings, StrategySettings};
pub(crate) use node::Place;
pub use node::{Node, Number, Origin, Value, hex};
pub(crate) use parse::parse;
pub(crate) use paths::Keys;
pub use read::{Key, RoleBy, named_style, parse_value, style_names};
pub use timeline::Timeline;
pub use upright::{GuessedUp, UpReason};

/// A scene as a tree of values.
#[derive(Clone, Debug)]
pub struct Document {
    path: PathBuf,
    root: Node,
    /// Text as it was read.
    text: Arc<str>,
    /// Text with all changes, if there are any.
    edited: Option<DocumentMut>,
    /// True if the document is only one part of a file.
    is_within: bool,
}

impl Default for Document {
    fn default() -> Self {
        Self::new()
    }
}

impl Document {
    /// An empty document without a file. Paths in it are relative to the current folder.
    pub fn new() -> Self {
        Self {
            path: PathBuf::new(),
            root: Node::new(Value::Table(Vec::new())),
            text: Arc::default(),
            edited: None,
            is_within: false,
        }
    }

    /// Reads a file from disk.
    ///
    /// # Errors
    ///
    /// Fails if the file cannot be read or is not TOML. A TOML error gives the line.
    pub fn read(path: &Path) -> Result<Self> {
        Self::read_from(path, &Disk)
    }

    /// Reads a file from a host's store. The files that it names are read when it is opened, through
    /// [`Assets::from_files`].
    ///
    /// # Errors
    ///
    /// The errors of [`Document::read`].
    pub fn read_from(path: &Path, store: &dyn Files) -> Result<Self> {
        let bytes = input_file::read(path, store)?;
        let text = std::str::from_utf8(&bytes).map_err(|e| {
            let what = format!("byte {} is not valid UTF-8", e.valid_up_to());
            Error::file(path, what, "save the scene file as TOML text in UTF-8")
        })?;
        // Editors on Windows put a byte order mark before the text.
        Self::parse(path, text.trim_start_matches('\u{feff}'))
    }

    /// Parses a text. Paths in the text are relative to the folder of `path`, and errors name `path`.
    ///
    /// # Errors
    ///
    /// Fails if the text is not TOML, and gives the line.
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self> {
        let path = path.into();
        let root = parse(&path, text)?;
        Ok(Self {
            path,
            root,
            text: text.into(),
            edited: None,
            is_within: false,
        })
    }

    /// Creates a document from a tree that is part of a file with another purpose.
    ///
    /// # Errors
    ///
    /// Fails if the root of the tree is not a table.
    pub fn of_node(path: impl Into<PathBuf>, root: Node) -> Result<Self> {
        let mut document = Self {
            path: path.into(),
            is_within: true,
            ..Self::new()
        };
        let Value::Table(entries) = root.value else {
            return Err(lost(
                "scene",
                ("it is not a table".into(), "write `{ part = [..] }`".into()),
            ));
        };
        for (key, node) in entries {
            document.add_at(&Place::new(), &[&key], node)?;
        }
        Ok(document)
    }

    /// Path of the file that the document was read from, or an empty path if there is no file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Folder to which paths in the document are relative.
    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or_else(|| Path::new(""))
    }

    /// Returns the name of the document, which is the name of its file or, without a file, of its models.
    pub fn name(&self) -> String {
        if let Some(stem) = self.path.file_stem().filter(|_| !self.is_within) {
            return stem.to_string_lossy().into_owned();
        }
        let Some(Value::List(parts)) = self.root.get("part").map(|n| &n.value) else {
            return String::new();
        };
        let names: Vec<String> = parts.iter().filter_map(Node::model).collect();
        names.join("+")
    }

    /// Returns the root of the tree.
    pub fn root(&self) -> &Node {
        &self.root
    }

    /// A required value at the top level, with its position. If it is missing, the error shows `example`.
    #[doc(hidden)]
    pub fn need(&self, key: &str, example: &str) -> Result<reader::Entry<'_>> {
        read::top(&self.path, &self.root)?.need(key, example)
    }

    /// The scene at a time in seconds. For many times, build the [`Document::timeline`] once and call [`Timeline::at`].
    ///
    /// # Errors
    ///
    /// The errors of [`Document::timeline`] and [`Timeline::at`].
    pub fn resolve(&self, time_s: f64, assets: &mut Assets) -> Result<Scene> {
        self.timeline(assets)?.at(time_s)
    }

    /// Refuses unknown keys, shapes and files, and invalid values. The values of parts and cuts are not checked, because that requires
    /// opening their files.
    ///
    /// # Errors
    ///
    /// The errors of [`Document::timeline`].
    pub fn check(&self, assets: &Assets) -> Result<()> {
        let root = read::root(self.path(), &self.root, None)?;
        read::check(&root, self.folder(), assets)
    }

    /// Opens all files that the document names, and checks all its values, including animated ones at their key times and between them.
    ///
    /// # Errors
    ///
    /// Fails if a file cannot be opened or a value is invalid, and gives the line or the option.
    pub fn timeline(&self, assets: &mut Assets) -> Result<Timeline> {
        Timeline::of(self, assets)
    }

    /// Returns the value at a path.
    ///
    /// # Errors
    ///
    /// Fails if the path does not resolve, and suggests the nearest names.
    pub fn get(&self, path: &str) -> Result<&Node> {
        let step = walk(&self.root, path);
        match step.rest.as_str() {
            "" => Ok(step.node),
            _ => Err(lost(path, astray(&step))),
        }
    }
}

/// Documents are equal if they hold the same values, whatever the names of their files.
impl PartialEq for Document {
    fn eq(&self, other: &Self) -> bool {
        self.root == other.root
    }
}

/// The current text of the file.
impl fmt::Display for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.edited {
            Some(text) => write!(f, "{text}"),
            None => f.write_str(&self.text),
        }
    }
}

fn lost(path: &str, (what, help): Lost) -> Error {
    Error::input(format!("`{path}`"), what, help)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "\
# A scene.
height_filter = \"exact\"

[camera]
azimuth_deg = 35   # from the side

[[part]]
name = \"a.b\"
shape = \"cube\"
material = { color = \"#fff\" } # white

[[part]]
shape = \"sphere\"
translate = [0, 0.5, 1]

[[cut]]
name = \"front\"
surfaces = [
  { section = \"z=50%\" }, # the middle
]
";

    fn scene() -> Document {
        Document::parse("scene.toml", SCENE).expect("a scene")
    }

    #[test]
    fn what_is_set_stands_in_the_tree_and_in_the_text() {
        for (path, value) in [
            ("height_filter", Value::from("hardware")),
            ("camera.azimuth_deg", 20.5.into()),
            ("camera.azimuth_deg", 20_i64.into()),
            ("camera.near_cap", false.into()),
            ("camera.up", "+Z".into()),
            ("part.a.b.material.color", "#000".into()),
            ("part.a.b.material.cap_color", "#000".into()),
            ("part.1.translate", vec![1.0, 2.0, 3.0].into()),
            ("part.1.translate.2", 9.0.into()),
            ("part.1.material.hatch", "steel".into()),
            ("cut.front.surfaces.0.section", "z=10%".into()),
            ("cut.0.surfaces.0.flip", true.into()),
            ("cut.front.wedge.to_deg", 90.0.into()),
            ("relief.rock.kind", "fractal".into()),
            ("strategy.name", "stencil".into()),
        ] {
            let mut document = scene();
            document.set(path, value.clone()).expect(path);
            assert_eq!(document.get(path).expect(path).value, value, "{path}");
            let text = document.to_string();
            let again =
                Document::parse("scene.toml", &text).unwrap_or_else(|e| panic!("{e}: {text}"));
            assert_eq!(again.get(path).expect(path).value, value, "{path}: {text}");
            for comment in ["# A scene.", "# from the side", "# white", "# the middle"] {
                assert!(text.contains(comment), "{path}: {text}");
            }
            assert_eq!(again.root(), document.root(), "{path}: {text}");
        }
        let mut document = scene();
        document
            .set("camera.azimuth_deg", 36_i64)
            .expect("it is there");
        assert_eq!(document.to_string(), SCENE.replace("= 35", "= 36"));
    }

    #[test]
    fn comments_stay_with_what_they_are_about() {
        let (start, end) = (
            "# Mine.\n\n[[part]]\nshape = \"cube\"\n\n[[cut]]\nsurfaces = [\n",
            "]\n",
        );
        for held in [
            "  { section = \"z=1\" }, # one\n",
            "  { section = \"z=1\" } # one\n",
        ] {
            let text = format!("{start}{held}{end}");
            let mut document = Document::parse("scene.toml", &text).expect("a scene");
            let node = Node::new(Value::read("{ section = \"z=2\" }"));
            document.push("cut.0.surfaces", node).expect("a list");
            let expected = "  { section = \"z=1\" }, # one\n  { section = \"z=2\" },\n";
            assert_eq!(document.to_string(), format!("{start}{expected}{end}"));
            let list = Value::read("[{ shape = \"knot\" }, { shape = \"cube\" }]");
            document.set("part", list).expect("a list");
            let parts =
                "# Mine.\n\n[[part]]\nshape = \"knot\"\n\n[[part]]\nshape = \"cube\"\n\n[[cut]]";
            assert!(document.to_string().starts_with(parts), "{document}");
        }
    }

    #[test]
    fn tables_and_lists_are_replaced_as_a_whole() {
        for (path, value) in [
            (
                "part.1",
                "{ shape = \"knot\", material = { color = \"#fff\" } }",
            ),
            ("cut.0.surfaces", "[{ section = \"x=1\" }]"),
            ("part", "[{ shape = \"knot\" }]"),
            ("camera", "{ near = 1 }"),
        ] {
            let mut document = scene();
            document.set(path, Value::read(value)).expect(path);
            assert_eq!(document.get(path).expect(path).value, Value::read(value));
            let text = document.to_string();
            let again =
                Document::parse("scene.toml", &text).unwrap_or_else(|e| panic!("{e}: {text}"));
            assert_eq!(again.root(), document.root(), "{path}: {text}");
        }
        assert_eq!(
            scene().to_string(),
            SCENE,
            "a document that nothing was set in is its text"
        );
    }

    #[test]
    fn paths_that_lead_nowhere_name_what_is_there() {
        for (path, phrase) in [
            ("part.c.shape", "there is no part `c`"),
            ("part.2.shape", "use one of: a.b, sphere"),
            ("cut.frnt.enabled", "did you mean `front`"),
            ("camera.azimuth_deg.x", "nothing below `camera.azimuth_deg`"),
            (
                "cut.front.surfaces.1.section",
                "there is no `1` in `cut.front.surfaces`",
            ),
            ("cut.front", "continue with one of: name, surfaces"),
            ("camera", "it is a table"),
            ("", "names no value"),
            ("camera..near", "names no value"),
        ] {
            let error = scene().set(path, 1.0).expect_err(path).to_string();
            assert!(error.contains(phrase), "{path}: {error}");
            assert!(error.contains("help:"), "{error}");
        }
        assert!(scene().get("camera.near").is_err(), "it is not there");
    }
}
