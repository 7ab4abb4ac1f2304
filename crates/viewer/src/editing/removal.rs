//! Removes values from a document, and the tables and lists left empty by this. The document's tree keeps empty tables but its text does
//! not, so a scene whose changes were all undone would otherwise count as changed.
//!
//! Cost: one check per table on the path to the value.

use cutaway::Result;
use cutaway_io::Document;
use cutaway_io::document::{Node, Value};

/// Removes a value, and then the containers that became empty, unless an empty container has a meaning.
///
/// # Errors
///
/// A document that cannot be changed.
pub fn take_out(document: &mut Document, path: &str) -> Result<()> {
    document.remove(path)?;
    let mut path = path;
    while let Some((group, _)) = path.rsplit_once('.')
        && document.get(group).ok().and_then(count) == Some(0)
    {
        // An empty cutout table and an empty list entry have a meaning, so they stay.
        let is_entry = group.starts_with("part.") && group.matches('.').count() == 1;
        if is_entry || group.starts_with("cut.") {
            break;
        }
        document.remove(group)?;
        path = group;
    }
    Ok(())
}

/// Number of entries of a table or a list.
fn count(node: &Node) -> Option<usize> {
    match &node.value {
        Value::Table(entries) => Some(entries.len()),
        Value::List(list) => Some(list.len()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_empty_is_left_but_a_cut() {
        let text = "[[part]]\nshape = \"cube\"\n\n[[cut]]\ncutout = { angle_deg = 90 }\n";
        let before = Document::parse("s.toml", text).expect("a scene");
        let mut document = before.clone();
        for path in [
            "part.0.material.color",
            "style.hatch.width",
            "camera.zoom",
            "relief.rock.kind",
        ] {
            document.set(path, 1.0).expect("a value");
            take_out(&mut document, path).expect("taken out");
            assert_eq!(document, before, "{path}");
        }
        take_out(&mut document, "cut.0.cutout.angle_deg").expect("taken out");
        assert!(document.get("cut.0.cutout").is_ok(), "{document}");
        take_out(&mut document, "cut.0").expect("taken out");
        assert!(document.root().get("cut").is_none(), "{document}");
        let again = Document::parse("s.toml", &document.to_string()).expect("a scene");
        assert_eq!(again, document);
    }
}
