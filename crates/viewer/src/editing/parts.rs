//! The parts of a document: list entries, and visibility. A part has as many solids as its file contains;
//! [`Timeline::names_of`](cutaway_io::document::Timeline::names_of) returns the names of the solids.

use cutaway::Result;
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};

/// List entry of a part, which may contain several solids of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartEntry {
    /// Name of the part, or its default name.
    pub name: String,
    /// True if the part is enabled, before animation.
    pub is_enabled: bool,
}

/// The parts of a document, in order.
pub fn parts(document: &Document) -> Vec<PartEntry> {
    let entries = document.root().get("part").map_or(&[] as &[_], Node::items);
    let entry = |(index, entry): (usize, &Node)| PartEntry {
        name: name(index, entry),
        is_enabled: entry.get("enabled").is_none_or(|n| n.value != false.into()),
    };
    entries.iter().enumerate().map(entry).collect()
}

/// Name of an entry.
pub fn name(index: usize, entry: &Node) -> String {
    let name = entry.name().map(str::to_owned).or_else(|| entry.model());
    name.unwrap_or_else(|| index.to_string())
}

/// Shows or hides a part. Hiding a part and showing it again restores the document.
///
/// # Errors
///
/// A part that does not exist.
pub fn show(document: &mut Document, index: usize, is_shown: bool) -> Result<()> {
    let path = format!("part.{index}.enabled");
    document.get(&format!("part.{index}"))?;
    // A value that keys animate has to stay in the file.
    let entry = format!("part.{}", parts(document)[index].name);
    let targets = [path.clone(), format!("{entry}.enabled")];
    let keys = document.root().get("key").map_or(&[] as &[_], Node::items);
    let is_target = |key: &Node| {
        let target = key.get("target").and_then(Node::text);
        target.is_some_and(|target| targets.iter().any(|own| own == target))
    };
    match is_shown && !keys.iter().any(is_target) {
        true => document.remove(&path),
        false => document.set(&path, Value::from(is_shown)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_that_is_shown_again_is_as_it_was() {
        let text = "[[part]]\nname = \"a\"\nshape = \"cube\"\n\n[[part]]\nshape = \"torus\"\n";
        let before = Document::parse("s.toml", text).expect("a scene");
        let mut document = before.clone();
        show(&mut document, 1, false).expect("a part");
        let all = parts(&document);
        let listed: Vec<_> = all
            .iter()
            .map(|p| (p.name.as_str(), p.is_enabled))
            .collect();
        assert_eq!(listed, [("a", true), ("torus", false)]);
        show(&mut document, 1, true).expect("a part");
        assert_eq!(document, before);
        assert!(show(&mut document, 2, false).is_err(), "there is none");

        let keyed = "[[part]]\nname = \"a\"\nshape = \"cube\"\nenabled = false\n\n[[key]]\ntarget = \"part.a.enabled\"\ntimes_s = [0, 1]\nvalues = [false, true]\n";
        let mut document = Document::parse("s.toml", keyed).expect("a scene");
        show(&mut document, 0, true).expect("a part");
        assert!(document.get("part.0.enabled").is_ok(), "{document}");
    }
}
