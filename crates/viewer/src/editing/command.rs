//! Writes a scene as a command line that draws exactly the picture in the window.
//!
//! Values that the input files already give are left out. Plain planes become `--section`; everything else becomes `--set`, which takes any
//! document value.

use cutaway::{Error, Result};
use cutaway_io::Document;
use cutaway_io::document::{Node, Value, part};

use crate::picture::slot::Painter;

/// Settings of the exported picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExportSettings {
    /// The renderer.
    pub painter: Painter,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

/// The arguments of a command that draws a document. `origin` is the document as read from its file, if it was read from one.
///
/// # Errors
///
/// A value of the document's file was removed: no command-line option can do that.
pub fn words(
    document: &Document,
    origin: &Document,
    picture: ExportSettings,
) -> Result<Vec<String>> {
    let mut words = vec!["cutaway".to_owned(), "render".to_owned()];
    let is_file = !origin.path().as_os_str().is_empty();
    let base = match is_file {
        true => {
            words.push(origin.path().display().to_string());
            origin.clone()
        }
        false => {
            let parts = document.root().get("part").map_or(&[] as &[_], Node::items);
            let mut base = Document::new();
            for input in parts.iter().filter_map(input) {
                base.add_part(part(&input))?;
                words.push(input);
            }
            base
        }
    };
    let mut settings = Vec::new();
    for (key, node) in entries(document.root()) {
        let before = base.root().get(key);
        match (key, planes(node)) {
            ("cut", Some(planes)) if before.is_none() => {
                for plane in planes {
                    words.extend(["--section".to_owned(), plane]);
                }
            }
            // The renderer and the size are set below.
            ("strategy" | "resolution", _) => {}
            _ => differences(key, before, node, &mut settings)?,
        }
    }
    let gone = entries(base.root()).find(|(key, _)| document.root().get(key).is_none());
    if let Some((key, _)) = gone {
        return Err(cannot_remove(key));
    }
    for setting in settings {
        words.extend(["--set".to_owned(), setting]);
    }
    let [width, height] = picture.size_px;
    let painter = picture.painter.to_string();
    let last = [
        "--strategy",
        &painter,
        "--resolution",
        &format!("{width},{height}"),
        "-o",
        "cut.png",
    ];
    words.extend(last.map(str::to_owned));
    Ok(words)
}

/// Arguments quoted for a shell.
pub fn quoted(words: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=+./,:%@".contains(c);
    let quote = |word: &String| match !word.is_empty() && word.chars().all(plain) {
        true => word.clone(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    };
    words.iter().map(quote).collect::<Vec<_>>().join(" ")
}

/// A part's name on a command line.
fn input(part: &Node) -> Option<String> {
    let shape = || Some(format!("shape:{}", part.get("shape")?.text()?));
    match part.get("mesh") {
        Some(mesh) => mesh.text().map(str::to_owned),
        None => shape(),
    }
}

fn entries(node: &Node) -> impl Iterator<Item = (&str, &Node)> {
    let entries = match &node.value {
        Value::Table(entries) => entries.as_slice(),
        _ => &[],
    };
    entries.iter().map(|(key, node)| (&**key, node))
}

/// The `--section` texts of the cuts, if every cut is a single plane.
fn planes(cuts: &Node) -> Option<Vec<String>> {
    let plane = |cut: &Node| {
        let [surface] = cut.get("surfaces")?.items() else {
            return None;
        };
        let is_bare = entries(surface).count() == 1
            && entries(cut).all(|(k, _)| k == "surfaces" || k == "name");
        Some(surface.get("section")?.text()?.to_owned()).filter(|_| is_bare)
    };
    cuts.items().iter().map(plane).collect()
}

/// Collects the settings that turn one value into another.
fn differences(
    path: &str,
    before: Option<&Node>,
    node: &Node,
    settings: &mut Vec<String>,
) -> Result<()> {
    if before == Some(node) {
        return Ok(());
    }
    let goes_below = |held: &Node| {
        let is_table = |node: &Node| matches!(node.value, Value::Table(_));
        is_table(held) && is_table(node) && entries(node).all(|(key, _)| !key.contains(['.', '=']))
    };
    if let (Some(Value::List(was)), Value::List(is)) = (before.map(|b| &b.value), &node.value)
        && was.len() == is.len()
        && was.iter().zip(is).all(|(was, is)| {
            was == is || matches!((&was.value, &is.value), (Value::Table(_), Value::Table(_)))
        })
    {
        for (index, (was, is)) in was.iter().zip(is).enumerate() {
            differences(&format!("{path}.{index}"), Some(was), is, settings)?;
        }
        return Ok(());
    }
    let empty = Node::new(Value::Table(Vec::new()));
    let held = before.unwrap_or(&empty);
    if !goes_below(held) || (before.is_none() && entries(node).next().is_none()) {
        settings.push(format!("{path}={}", node.value));
        return Ok(());
    }
    if let Some((key, _)) = entries(held).find(|(key, _)| node.get(key).is_none()) {
        return Err(cannot_remove(&format!("{path}.{key}")));
    }
    for (key, below) in entries(node) {
        differences(&format!("{path}.{key}"), held.get(key), below, settings)?;
    }
    Ok(())
}

fn cannot_remove(path: &str) -> Error {
    Error::input(
        format!("`{path}`"),
        "it was removed from the scene file, and no option can do that",
        "save the scene, then copy the command again",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shells_take_words_as_they_are() {
        let words = ["cutaway", "a b", "it's", "z=50%", ""].map(str::to_owned);
        assert_eq!(quoted(&words), r"cutaway 'a b' 'it'\''s' z=50% ''");
    }
}
