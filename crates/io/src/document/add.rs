//! Adds parts and cuts to a document. Each gets a unique name, and its file paths are made relative to the document's folder.

use std::path::Path;

use cutaway::error::Result;

use super::build::{CutDraft, PartDraft, TableEntries, put};
use super::node::{Node, Origin, Value};
use super::{Document, files, read};

impl Document {
    /// Adds a part.
    ///
    /// # Errors
    ///
    /// Fails if words in the draft are invalid, or if the document's `part` is not a list.
    pub fn add_part(&mut self, draft: PartDraft) -> Result<()> {
        if let Some(fault) = draft.fault {
            return Err(fault);
        }
        let value = Value::Table(self.seen_from_here(draft.table, &["mesh"]));
        let origin = draft.origin;
        self.push("part", Node { value, origin })
    }

    /// Sets the base style, by name or file. The document's own style changes still apply to it.
    ///
    /// # Errors
    ///
    /// Fails if the document's text cannot be edited.
    pub fn set_style(&mut self, name_or_file: &str, option: &str) -> Result<()> {
        let from_here = read::is_style_file(name_or_file)
            .then(|| files::renamed(name_or_file, Path::new(""), self.folder()))
            .flatten();
        let name = from_here.unwrap_or_else(|| name_or_file.to_owned());
        let is_table = (self.get("style")).is_ok_and(|n| matches!(n.value, Value::Table(_)));
        let path = if is_table { "style.base" } else { "style" };
        let origin = Origin::Option(option.into());
        self.set_node(path, Node::new(name).said(&origin))
    }

    /// Adds a cut with the reliefs of its surfaces.
    ///
    /// # Errors
    ///
    /// Fails if words in the draft are invalid, or if the document's `cut` is not a list.
    pub fn add_cut(&mut self, mut draft: CutDraft) -> Result<()> {
        let of_surfaces = draft.surfaces.iter_mut().find_map(|s| s.fault.take());
        if let Some(fault) = of_surfaces.or(draft.fault) {
            return Err(fault);
        }
        let mut table = TableEntries::new();
        let said = draft.table.iter().find(|(key, _)| **key == *"name");
        let said = said.and_then(|(_, node)| node.text());
        let made_of = draft.names.join(" and ");
        let name = match said.unwrap_or(&made_of) {
            "" => "cut",
            name => name,
        };
        let name = self.free_name("cut", name);
        put(&mut table, "name", name.into(), &Origin::Program);
        let mut surfaces = Vec::new();
        for surface in draft.surfaces {
            let mut table = surface.table;
            if let Some((name, relief)) = surface.relief {
                let origin = relief.origin.clone();
                let name = self.add_relief(&name, relief)?;
                put(&mut table, "relief", name.into(), &origin);
            }
            surfaces.push(Node {
                value: Value::Table(table),
                origin: surface.origin,
            });
        }
        if !surfaces.is_empty() {
            table.push(("surfaces".into(), Node::new(Value::List(surfaces))));
        }
        for (key, mut regions) in [("box", draft.boxes), ("wedge", draft.wedges)] {
            match (regions.len(), regions.pop()) {
                (1, Some(one)) => table.push((key.into(), one)),
                (_, Some(last)) => {
                    regions.push(last);
                    table.push((key.into(), Node::new(Value::List(regions))));
                }
                (_, None) => {}
            }
        }
        for (key, node) in self.seen_from_here(draft.table, &["volume"]) {
            match table.iter_mut().find(|(held, _)| *held == key) {
                // The name was made unique.
                Some(_) if *key == *"name" => {}
                Some((_, held)) => *held = node,
                None => table.push((key, node)),
            }
        }
        self.push("cut", Node::new(Value::Table(table)))
    }

    /// Adds a relief, unless an equal one exists, and returns the name of the new or existing relief.
    fn add_relief(&mut self, name: &str, relief: Node) -> Result<String> {
        let relief = match relief.value {
            Value::Table(table) => Node {
                value: Value::Table(self.seen_from_here(table, &["image"])),
                ..relief
            },
            _ => relief,
        };
        // A relief from the file is not reused. Animation keys may move it, and edits to it should affect only cuts from the file.
        let is_it =
            |(_, node): &&(_, Node)| *node == relief && matches!(node.origin, Origin::Option(_));
        if let Some(Value::Table(held)) = self.root().get("relief").map(|n| &n.value)
            && let Some((name, _)) = held.iter().find(is_it)
        {
            return Ok(name.to_string());
        }
        let name = self.free_name("relief", name);
        self.set_node(&format!("relief.{name}"), relief)?;
        Ok(name)
    }

    /// Returns a name that no entry of a list or table has yet.
    fn free_name(&self, list: &str, wanted: &str) -> String {
        let is_taken = |name: &str| match self.root().get(list).map(|n| &n.value) {
            Some(Value::List(entries)) => entries.iter().any(|n| n.name() == Some(name)),
            Some(Value::Table(entries)) => entries.iter().any(|(key, _)| **key == *name),
            _ => false,
        };
        let numbered = (2..).map(|count| format!("{wanted}_{count}"));
        let mut names = std::iter::once(wanted.to_owned()).chain(numbered);
        names.find(|name| !is_taken(name)).unwrap_or_default()
    }

    /// Converts file paths relative to the current folder to paths relative to the document's folder.
    fn seen_from_here(&self, mut table: TableEntries, files: &[&str]) -> TableEntries {
        for (_, node) in table.iter_mut().filter(|(key, _)| files.contains(&&**key)) {
            if let Value::Text(name) = &node.value
                && !name.starts_with("shape:")
                && let Some(path) = files::renamed(name, Path::new(""), self.folder())
            {
                node.value = path.into();
            }
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use crate::document::{Document, cut, part, section};

    #[test]
    fn a_key_of_a_cut_is_there_once() {
        let half = || cut([section("z=50%")]);
        let globs = ["a", "b"].map(|glob| [glob.to_owned()]);
        for (draft, expected) in [
            (half().with("name", "x"), "name = \"x\""),
            (
                half().name("front").block("0,0,0:1,1,1"),
                "name = \"front\"",
            ),
            (
                half().except(&globs[0]).except(&globs[1]),
                "except = [\"a\", \"b\"]",
            ),
            (half().name("a").and(half().name("b")), "name = \"a and b\""),
            (cut([]).with("volume", "shape:cube"), "name = \"cut\""),
        ] {
            let mut document = Document::new();
            document.add_part(part("shape:cube")).expect("a part");
            document.add_cut(draft).expect(expected);
            let text = document.to_string();
            let again = Document::parse("scene.toml", &text).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(again.root(), document.root(), "{text}");
            assert!(text.contains(expected), "{text}");
        }
        let two = cut([]).volume("a.stl").and(cut([]).volume("b.stl"));
        let error = Document::new().add_cut(two).expect_err("two volumes");
        assert!(error.to_string().contains("volume"), "{error}");
    }
}
