//! The files that a document names, and the conversion of their paths when the document moves to another folder.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use cutaway::error::Result;

use super::node::{Node, Place, Value};
use super::paths::{self, ValueType};
use super::{Document, read};
use crate::load::frames::Pattern;
use crate::load::{Files, companions, place_of};

impl Document {
    /// The files that the document names, and the files that those name in turn. A frame pattern gives its existing frames. A file that is
    /// not in the store yet is listed without its companions, so a host that fetches files repeats the call until it lists no new file.
    pub fn files(&self, store: &dyn Files) -> Vec<PathBuf> {
        let mut files = Vec::new();
        for Named { name, first, .. } in names(&self.root) {
            let path = self.folder().join(name);
            let pattern = Pattern::parse(name).map(|p| p.inside(self.folder()));
            let numbered = match pattern {
                Ok(pattern) if !store.is_file(&path) => pattern.files(first, store).ok(),
                _ => None,
            };
            for path in numbered.map_or_else(|| vec![path], |(files, _)| files) {
                files.extend(companions(&path, store));
                files.push(path);
            }
        }
        files
    }

    /// Returns the document under another file name. Paths in it are converted so that they still lead to the same files.
    ///
    /// # Errors
    ///
    /// Fails if the text cannot be edited.
    pub fn moved_to(&self, path: &Path) -> Result<Self> {
        let mut moved = self.clone();
        path.clone_into(&mut moved.path);
        moved.is_within = false;
        for Named { place, name, .. } in names(&self.root) {
            if let Some(name) = renamed(name, self.folder(), moved.folder()) {
                moved.set_at(&place, Node::new(name))?;
            }
        }
        Ok(moved)
    }
}

/// A file, or a pattern of numbered files, as named in the document.
struct Named<'a> {
    /// Position in the document tree.
    place: Place,
    name: &'a str,
    /// The number of the first file of a pattern, if given.
    first: Option<u32>,
}

/// All files named in a document.
fn names(root: &Node) -> Vec<Named<'_>> {
    let mut names = Vec::new();
    for path in paths::all()
        .iter()
        .filter(|path| path.takes == ValueType::File)
    {
        let keys: Vec<&str> = path.path.split('.').collect();
        named_below(root, &keys, None, &mut Vec::new(), &mut names);
    }
    if let Value::Table(entries) = &root.value
        && let Some(at) = entries.iter().position(|(key, _)| **key == *"style")
    {
        names.extend(style(at, &entries[at].1));
    }
    names.sort_by(|a, b| a.place.cmp(&b.place));
    names
}

/// Collects the files at a key path, in which `*` matches any key. The argument `beside` is the table that contains the node.
fn named_below<'a>(
    node: &'a Node,
    keys: &[&str],
    beside: Option<&'a [(Arc<str>, Node)]>,
    place: &mut Place,
    names: &mut Vec<Named<'a>>,
) {
    let Some((key, rest)) = keys.split_first() else {
        if let Some(name) = node.text().filter(|name| !name.starts_with("shape:")) {
            let first = beside.and_then(|fields| fields.iter().find(|(key, _)| **key == *"first"));
            let first = first.and_then(|(_, node)| match &node.value {
                Value::Number(number) => number.whole?.try_into().ok(),
                _ => None,
            });
            names.push(Named {
                place: place.clone(),
                name,
                first,
            });
        }
        return;
    };
    let mut go_on = |at: usize, node: &'a Node, beside| {
        place.push(at);
        named_below(node, rest, beside, place, names);
        place.pop();
    };
    match &node.value {
        Value::Table(fields) => {
            for (at, (name, node)) in fields.iter().enumerate() {
                if *key == "*" || **name == **key {
                    go_on(at, node, Some(fields.as_slice()));
                }
            }
        }
        Value::List(list) if *key == "*" => {
            for (at, node) in list.iter().enumerate() {
                go_on(at, node, None);
            }
        }
        _ => {}
    }
}

/// The file of a style, named directly or as its base.
fn style(at: usize, node: &Node) -> Option<Named<'_>> {
    let (place, node) = match &node.value {
        Value::Table(fields) => {
            let field = fields.iter().position(|(key, _)| **key == *"base")?;
            (vec![at, field], node.child(field)?)
        }
        _ => (vec![at], node),
    };
    let name = node.text().filter(|name| read::is_style_file(name))?;
    Some(Named {
        place,
        name,
        first: None,
    })
}

/// Converts a path relative to one folder to a path relative to another. Returns `None` if the path does not change.
pub(super) fn renamed(name: &str, from: &Path, to: &Path) -> Option<String> {
    if Path::new(name).is_absolute() || from == to {
        return None;
    }
    // In a pattern, `%` is doubled except in the placeholder. The folder above the placeholder is handled as an ordinary path.
    let first = if Pattern::is_in(name) {
        name.find('%')
    } else {
        None
    };
    let Some(first) = first else {
        return Some(from_folder(&place(&from.join(name)), to));
    };
    let (above, pattern) = match name[..first].rfind('/') {
        Some(slash) => name.split_at(slash + 1),
        None => ("", name),
    };
    let above = from_folder(&folder(&from.join(above)), to).replace('%', "%%");
    Some(match above.as_str() {
        "" => pattern.to_owned(),
        above => format!("{}/{pattern}", above.trim_end_matches('/')),
    })
}

/// Path relative to a folder, with slashes.
fn from_folder(path: &Path, to: &Path) -> String {
    let renamed = pathdiff::diff_paths(path, folder(to)).unwrap_or_else(|| path.to_owned());
    let text = renamed.to_string_lossy();
    text.replace(std::path::MAIN_SEPARATOR, "/")
}

/// Resolves the folder of a path. If the file itself is a link, the link is kept, because companions are relative to the link.
fn place(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default();
    folder(path.parent().unwrap_or_else(|| Path::new(""))).join(name)
}

/// Canonical path of a folder; an empty path is the current folder.
fn folder(path: &Path) -> PathBuf {
    place_of(&Path::new(".").join(path))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::load::Disk;

    #[test]
    fn numbered_files_begin_where_the_document_says() {
        let folder = std::env::temp_dir().join(format!("cutaway-files-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let frames = ["w_7.stl", "w_8.stl"].map(|name| folder.join(name));
        for frame in &frames {
            fs::write(frame, "").expect("a file");
        }
        let text = "part = [{ mesh = \"w_%d.stl\", first = 7 }]";
        let document = Document::parse(folder.join("scene.toml"), text).expect("a document");
        assert_eq!(document.files(&Disk), frames);
        fs::remove_dir_all(&folder).expect("a folder");
    }

    #[test]
    fn names_lead_to_the_same_files_from_elsewhere() {
        let text = "\
[[part]]
mesh = \"a.stl\" # the solid

[[part]]
mesh = \"/models/b_%04d.stl\"

[[cut]]
volume = \"shape:cube\"

[[cut]]
volume = \"../c.stl\"

[relief.rock]
image = \"maps/rock.png\"
";
        // Existing folders: links and `..` are resolved.
        let document = Document::parse("src/document/scene.toml", text).expect("a document");
        let moved = document
            .moved_to(Path::new("src/scene.toml"))
            .expect("moved");
        let expected = text
            .replace("a.stl", "document/a.stl")
            .replace("../c.stl", "c.stl")
            .replace("maps/", "document/maps/");
        assert_eq!(moved.to_string(), expected);
        // A pattern keeps its placeholder, and a `%` in its folder is not mistaken for a placeholder.
        for (name, from, to, expected) in [
            ("w_%d.stl", "src/d%d", "src", "d%%d/w_%d.stl"),
            ("a%%b/w_%d.stl", "src", "src/d%d", "../a%%b/w_%d.stl"),
            ("%d/w.stl", "src/document", "src", "document/%d/w.stl"),
            ("w%.stl", "src/d%", "src", "d%/w%.stl"),
        ] {
            let found = renamed(name, Path::new(from), Path::new(to));
            assert_eq!(found.as_deref(), Some(expected), "{name}");
        }
        let beside = document.moved_to(Path::new("src/document/other.toml"));
        assert_eq!(beside.expect("moved").to_string(), text);
    }
}
