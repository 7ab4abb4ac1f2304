//! The values of a style, by path, and how a document changes them.
//!
//! A document names a style, or has a table with a base style and changes. The first change turns the name into a table; once all are
//! reset, the plain name returns.

use cutaway::Result;
use cutaway::scene::style::Style;
use cutaway_io::Document;
use cutaway_io::document::{Node, Value, paths};

use crate::editing::removal;

/// Values of a style by document path, such as `style.strokes.cut`. A single colour for all parts and the lightness of their hues
/// exclude each other: only the one in effect is listed. Lines without a colour of their own are listed with the ink's colour.
pub fn values(style: &Style) -> Vec<(String, Value)> {
    let mut style = *style;
    style.hatch.color.get_or_insert(style.ink);
    style.ghost.color.get_or_insert(style.ink);
    paths::values(&style, "style")
}

/// Prepares a change to a style: a plain style name becomes the base of a table.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn make_room(document: &mut Document, path: &str) -> Result<()> {
    let held = document.root().get("style");
    let name = held.and_then(Node::text).map(str::to_owned);
    match name.filter(|_| path.starts_with("style.")) {
        Some(name) => document.set("style", Value::from([("base", name.into())])),
        None => Ok(()),
    }
}

/// Resets a change to a style, and removes tables left empty.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn take_back(document: &mut Document, path: &str) -> Result<()> {
    removal::take_out(document, path)?;
    let Some(style) = document.root().get("style").cloned() else {
        return Ok(());
    };
    match (style.get("base"), &style.value) {
        (Some(base), Value::Table(entries)) if entries.len() == 1 => {
            document.remove("style")?;
            document.set("style", base.value.clone())
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cutaway_io::document::{named_style, style_names};
    use cutaway_io::load::Assets;

    #[test]
    fn a_table_of_all_values_is_the_style() {
        for name in style_names() {
            let style = named_style(name).expect(name);
            let mut document =
                Document::parse("s.toml", "[[part]]\nshape = \"cube\"\n").expect("a scene");
            for (path, value) in values(&style) {
                assert!(paths::all().iter().any(|p| p.path == path), "{path}");
                document.set(&path, value).expect(&path);
            }
            let timeline = document.timeline(&mut Assets::default()).expect(name);
            let mut read = timeline.scene().expect(name).style;
            // Without its own colour it has the ink's, as the table states.
            read.hatch.color = read.hatch.color.filter(|_| style.hatch.color.is_some());
            read.ghost.color = read.ghost.color.filter(|_| style.ghost.color.is_some());
            let colors =
                |of: Style| format!("{:?} {:?} {:?} {:?}", of.paper, of.ink, of.surface, of.cap);
            assert_eq!(colors(read), colors(style), "{name}");
            assert_eq!(read, style, "{name}");
        }
    }

    #[test]
    fn every_number_of_a_style_is_shown_by_some_style() {
        let shown: Vec<String> = style_names()
            .flat_map(|name| values(&named_style(name).expect(name)))
            .map(|(path, _)| path)
            .collect();
        let of_styles = paths::all().iter().filter(|p| p.path.starts_with("style."));
        for path in of_styles.filter(|p| p.path != "style.base") {
            assert!(shown.contains(&path.path), "{}", path.path);
        }
    }

    #[test]
    fn a_change_that_is_taken_back_leaves_the_name() {
        for text in ["style = \"ink\"\n\n", ""] {
            let text = format!("{text}[[part]]\nshape = \"cube\"\n");
            let before = Document::parse("s.toml", &text).expect("a scene");
            let mut document = before.clone();
            for path in ["style.strokes.cut", "style.hatch.width"] {
                make_room(&mut document, path).expect("room");
                document.set(path, 2.5).expect("a number");
            }
            assert_ne!(document, before);
            take_back(&mut document, "style.strokes.cut").expect("taken back");
            assert!(document.get("style.hatch.width").is_ok(), "{document}");
            assert!(document.get("style.strokes").is_err(), "{document}");
            take_back(&mut document, "style.hatch.width").expect("taken back");
            assert_eq!(document, before, "{document}");
        }
    }
}
