//! The scene as a document: the tree of a scene file, in which values are found and set by dotted paths.
//!
//! ```
//! use cutaway::scene::document::{Document, Value};
//! let text = "[[part]]\nname = \"box\" # the solid\nshape = \"cube\"\n\n[camera]\nazimuth_deg = 35\n";
//! let mut document = Document::parse("scene.toml", text)?;
//! document.set("camera.azimuth_deg", 20.0)?;
//! document.set("part.box.shape", Value::read("sphere"))?;
//! assert!(document.to_string().contains("shape = \"sphere\""));
//! assert!(document.to_string().contains("# the solid"));
//! # Ok::<(), cutaway::Error>(())
//! ```
//!
//! A path goes by the keys of tables and by the names of entries, or their numbers from 0: `cut.front.surfaces.0.amplitude`. It is what
//! `[[key]]` has as its target. What a value means is for [`load_scene`](super::load_scene) to say, which reads all of the tree: a
//! document holds any TOML.
//!
//! Cost: the tree; and from the first value that is set on the text once more, with its comments. Both are changed together, and nothing
//! is parsed again.
//!
//! Cannot: put an entry into a list, take a value away, or add a key with a point in its name.

mod address;
mod node;
mod parse;
mod text;

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml_edit::DocumentMut;

pub(crate) use address::{Lost, Step, astray, children, farther, walk};
pub(crate) use node::Place;
pub use node::{Node, Number, Value};
pub(crate) use parse::parse;

use super::input_file;
use crate::error::{Error, Result};

/// The tree of a scene file.
#[derive(Clone, Debug)]
pub struct Document {
    path: PathBuf,
    root: Node,
    /// As it was read.
    text: Arc<str>,
    /// The text as it is now, if something was set.
    edited: Option<DocumentMut>,
}

impl Document {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// A file that cannot be read or is no TOML, with its line.
    pub fn read(path: &Path) -> Result<Self> {
        let text = String::from_utf8(input_file::read(path)?).map_err(|e| {
            let what = format!("byte {} is not text in UTF-8", e.utf8_error().valid_up_to());
            Error::file(path, what, "save the scene file as TOML text in UTF-8")
        })?;
        // Editors on Windows put a byte order mark before the text.
        Self::parse(path, text.trim_start_matches('\u{feff}'))
    }

    /// Reads a text. Files that it names are looked for beside `path`, which errors name too.
    ///
    /// # Errors
    ///
    /// A text that is no TOML, with its line.
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self> {
        let path = path.into();
        let root = parse(&path, text)?;
        Ok(Self {
            path,
            root,
            text: text.into(),
            edited: None,
        })
    }

    /// The file that it was read from.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// All of it.
    pub fn root(&self) -> &Node {
        &self.root
    }

    /// The value at a path.
    ///
    /// # Errors
    ///
    /// A path that leads nowhere, with the nearest names.
    pub fn get(&self, path: &str) -> Result<&Node> {
        let step = walk(&self.root, path);
        match step.rest.as_str() {
            "" => Ok(step.node),
            _ => Err(lost(path, astray(&step))),
        }
    }

    /// Sets the value at a path. A key that a table does not have yet is added, with the tables that lead to it.
    ///
    /// # Errors
    ///
    /// A path through something that is no table: an entry that a list does not have, or a number. A value in the place of a table.
    pub fn set(&mut self, path: &str, value: impl Into<Value>) -> Result<()> {
        let mut value = value.into();
        if path.split('.').any(str::is_empty) {
            let mend = "write keys with points between them, as in `camera.azimuth_deg`";
            return Err(lost(path, ("it names no value".into(), mend.into())));
        }
        let step = walk(&self.root, path);
        let is_table = matches!(step.node.value, Value::Table(_));
        if !step.rest.is_empty() && !is_table {
            return Err(lost(path, astray(&step)));
        }
        if step.rest.is_empty() && is_table && !matches!(value, Value::Table(_)) {
            return Err(lost(path, ("it is a table".into(), farther(step.node))));
        }
        let (place, rest) = (step.place, step.rest);
        let new: Vec<&str> = rest.split('.').filter(|key| !key.is_empty()).collect();
        let text = match &mut self.edited {
            Some(text) => text,
            None => {
                let text = self.text.parse().map_err(|e| {
                    let mend = "report it: one reader of TOML takes the text and another does not";
                    Error::file(&self.path, format!("{e}"), mend)
                })?;
                self.edited.insert(text)
            }
        };
        text::set(text, (&self.root, &place), &new, &value);
        for key in new.iter().skip(1).rev() {
            value = Value::Table(vec![((*key).into(), Node::new(value))]);
        }
        if let Some(node) = self.root.at_mut(&place) {
            match (&mut node.value, new.first()) {
                (Value::Table(entries), Some(key)) => {
                    entries.push(((*key).into(), Node::new(value)));
                }
                (held, _) => *held = value,
            }
        }
        Ok(())
    }
}

/// The text of the file as it is now.
impl fmt::Display for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.edited {
            Some(text) => write!(f, "{text}"),
            None => f.write_str(&self.text),
        }
    }
}

fn lost(path: &str, (what, mend): Lost) -> Error {
    Error::input(format!("`{path}`"), what, mend)
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
        for (path, told) in [
            ("part.c.shape", "there is no part `c`"),
            ("part.2.shape", "use one of: a.b, 1"),
            ("cut.frnt.enabled", "did you mean `front`"),
            ("camera.azimuth_deg.x", "nothing below `camera.azimuth_deg`"),
            (
                "cut.front.surfaces.1.section",
                "there is no `1` in `cut.front.surfaces`",
            ),
            ("cut.front", "go on to one of: name, surfaces"),
            ("camera", "it is a table"),
            ("", "names no value"),
            ("camera..near", "names no value"),
        ] {
            let error = scene().set(path, 1.0).expect_err(path).to_string();
            assert!(error.contains(told), "{path}: {error}");
            assert!(error.contains("help:"), "{error}");
        }
        assert!(scene().get("camera.near").is_err(), "it is not there");
    }
}
