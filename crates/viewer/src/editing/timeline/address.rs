//! Resolution of key paths: a path identifies a list entry by its name, its model or its number. Among several matching entries,
//! the document uses the first in which the path resolves.
//!
//! A number identifies another entry once an earlier entry is removed, and a name shared by two entries means the first. The paths
//! written here therefore match only one entry, and are updated when its number changes.
//!
//! Cost: one traversal of the tree below each matching entry.

use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};

use super::{remove_below, tracks};
use crate::editing::removal;

/// The entry that a path leads into.
pub(super) struct Address<'a> {
    list: &'a str,
    index: usize,
    /// The path below the entry: empty, or with a leading dot.
    below: &'a str,
}

/// The entry that a path leads into; for an unresolved path, the first matching entry.
pub(super) fn address<'a>(document: &Document, path: &'a str) -> Option<Address<'a>> {
    let (list, rest) = path.split_once('.')?;
    let target = document.get(path).ok();
    let leads_into = |entry: &Node| target.is_none_or(|target| holds(entry, target));
    let entries = entries(document, list).iter().enumerate();
    let mut found = entries.filter(|(_, entry)| leads_into(entry));
    found.find_map(|(index, entry)| {
        let below = (names(index, entry).into_iter()).find_map(|name| {
            let below = rest.strip_prefix(&name)?;
            (below.is_empty() || below.starts_with('.')).then_some(below)
        })?;
        Some(Address { list, index, below })
    })
}

/// The path with its list entry given by number.
pub(super) fn by_number(document: &Document, path: &str) -> String {
    match address(document, path) {
        Some(Address { list, index, below }) => format!("{list}.{index}{below}"),
        None => path.to_owned(),
    }
}

/// A path that matches only this list entry: by its name if that is unique, else by its number.
///
/// # Errors
///
/// The entry does not exist, or its name and its number are both names of other entries.
pub fn path_of(document: &Document, list: &str, index: usize) -> Result<String> {
    let entries = entries(document, list);
    let culprit = || format!("{list} {index}");
    let entry = entries.get(index).ok_or_else(|| {
        let what = format!("there is no such {list}");
        Error::input(culprit(), what, "select another one")
    })?;
    let others = || (entries.iter().enumerate()).filter(|(other, _)| *other != index);
    let is_own = |name: &String| !others().any(|(other, entry)| names(other, entry).contains(name));
    let own = names(index, entry).into_iter().find(is_own);
    own.map(|name| format!("{list}.{name}")).ok_or_else(|| {
        let help = "give it a unique name in the scene file";
        let what =
            format!("no key can name it: its name and its number are both names of other {list}s");
        Error::input(culprit(), what, help)
    })
}

/// Removes a cut and the rows of its keys. Rows of other cuts still have the same targets.
///
/// # Errors
///
/// The document cannot be changed, or no key path could identify one of the remaining cuts any more.
pub fn take_out_cut(document: &mut Document, removed: usize) -> Result<()> {
    let path = format!("cut.{removed}");
    remove_below(document, &path)?;
    let before = document.clone();
    removal::take_out(document, &path)?;
    for (row, track) in tracks(&before).iter().enumerate() {
        let moved = address(&before, &track.target).filter(|moved| moved.list == "cut");
        let Some(Address { index, below, .. }) = moved else {
            continue;
        };
        let index = if index > removed { index - 1 } else { index };
        let is_the_same = address(document, &track.target).is_some_and(|now| now.index == index);
        if !is_the_same {
            let target = path_of(document, "cut", index)? + below;
            document.set(&format!("key.{row}.target"), target)?;
        }
    }
    Ok(())
}

/// The names of an entry, the preferred one first.
fn names(index: usize, entry: &Node) -> Vec<String> {
    let name = entry.name().map(str::to_owned).or_else(|| entry.model());
    name.into_iter().chain([index.to_string()]).collect()
}

fn entries<'a>(document: &'a Document, list: &str) -> &'a [Node] {
    document.root().get(list).map_or(&[], Node::items)
}

/// Returns true if a node equals another, or is its ancestor.
fn holds(node: &Node, below: &Node) -> bool {
    std::ptr::eq(node, below)
        || match &node.value {
            Value::List(list) => list.iter().any(|child| holds(child, below)),
            Value::Table(table) => table.iter().any(|(_, child)| holds(child, below)),
            _ => false,
        }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(text: &str) -> Document {
        Document::parse("s.toml", text).expect("a scene")
    }

    fn targets(document: &Document) -> Vec<String> {
        let tracks = tracks(document).into_iter();
        tracks.map(|track| track.target).collect()
    }

    const PARTS: &str = "[[part]]\nname = \"a\"\nshape = \"cube\"\ntranslate = [0, 0, 0]\n[[part]]\nname = \"a\"\nshape = \"cube\"\ntranslate = [0, 0, 0]\n[[part]]\nname = \"1\"\nshape = \"cube\"\n[[part]]\nname = \"b\"\nshape = \"cube\"\n";

    #[test]
    fn of_two_parts_with_one_name_each_has_a_path_or_a_reason() {
        let document = document(PARTS);
        assert_eq!(path_of(&document, "part", 0).expect("a path"), "part.0");
        assert_eq!(path_of(&document, "part", 3).expect("a path"), "part.b");
        let refused = path_of(&document, "part", 1).expect_err("`1` is a name");
        assert!(refused.to_string().contains("no key can name it"));
        assert!(path_of(&document, "part", 4).is_err(), "there is none");
    }

    #[test]
    fn a_path_is_that_of_the_entry_in_which_it_leads_to_something() {
        let mut document = document(PARTS);
        assert_eq!(by_number(&document, "part.a.translate"), "part.0.translate");
        document.remove("part.0.translate").expect("a number");
        assert_eq!(by_number(&document, "part.a.translate"), "part.1.translate");
        assert_eq!(by_number(&document, "part.a.scale"), "part.0.scale");
        assert_eq!(by_number(&document, "camera.zoom"), "camera.zoom");
    }

    #[test]
    fn rows_follow_their_cuts() {
        let cut = |name: &str| {
            format!("[[cut]]\n{name}surfaces = [{{ normal = [0, 0, 1], origin = [0, 0, 0] }}]\n")
        };
        let key = |target: &str| {
            format!(
                "[[key]]\ntarget = \"cut.{target}.surfaces.0.origin\"\ntimes_s = [0]\nvalues = [[0, 0, 0]]\n"
            )
        };
        let cuts = [cut(""), cut(""), cut("name = \"c\"\n"), cut("")].concat();
        let keys = ["0", "1", "2", "c", "3"].map(key).concat();
        let mut document = document(&format!("{cuts}\n{keys}"));
        take_out_cut(&mut document, 1).expect("a cut");
        let paths = |names: &[&str]| -> Vec<String> {
            let path = |name: &&str| format!("cut.{name}.surfaces.0.origin");
            names.iter().map(path).collect()
        };
        assert_eq!(targets(&document), paths(&["0", "c", "c", "2"]));
        take_out_cut(&mut document, 0).expect("a cut");
        assert_eq!(targets(&document), paths(&["c", "c", "1"]));
    }
}
