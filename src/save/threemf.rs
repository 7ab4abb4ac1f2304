//! 3MF, core specification 1.3: an object for each solid, base materials for faces and for caps, and a group of colours for corners that
//! have some.

use std::fmt::Write;

use super::zip::archive;
use super::{Solid, Unwritable, bytes_of};
use crate::scene::LengthUnit;

const CONTENT_TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
"#;

const RELATIONSHIPS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
"#;

/// The number of the materials among the resources.
const MATERIALS: usize = 1;

/// The number of the colours of corners among the resources; objects follow.
const COLORS: usize = 2;

/// All colours of corners, each once.
struct Colors(Vec<[u8; 4]>);

impl Colors {
    fn of(solids: &[Solid<'_>]) -> Self {
        let coats = solids.iter().filter_map(|s| s.coat.as_ref());
        let mut all: Vec<[u8; 4]> = coats
            .flat_map(|c| &c.triangles)
            .flat_map(|t| t.colors)
            .collect();
        all.sort_unstable();
        all.dedup();
        Self(all)
    }

    fn number(&self, color: [u8; 4]) -> usize {
        self.0.partition_point(|known| *known < color)
    }

    fn write(&self, text: &mut String) {
        if self.0.is_empty() {
            return;
        }
        let _ = writeln!(text, "<m:colorgroup id=\"{COLORS}\">");
        for [r, g, b, _] in &self.0 {
            let _ = writeln!(text, "<m:color color=\"#{r:02X}{g:02X}{b:02X}\"/>");
        }
        text.push_str("</m:colorgroup>\n");
    }
}

pub(super) fn encoded(solids: &[Solid<'_>], unit: LengthUnit) -> Result<Vec<u8>, Unwritable> {
    let model = model(solids, unit.in_3mf());
    archive(&[
        ("[Content_Types].xml", CONTENT_TYPES.as_bytes()),
        ("_rels/.rels", RELATIONSHIPS.as_bytes()),
        ("3D/3dmodel.model", model.as_bytes()),
    ])
    .map_err(|e| Unwritable::Archive(e.to_string()))
}

fn model(solids: &[Solid<'_>], unit: &str) -> String {
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"{unit}\" xml:lang=\"en-US\" \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" \
         xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n\
         <metadata name=\"Application\">cutaway</metadata>\n<resources>\n<basematerials id=\"{MATERIALS}\">\n"
    );
    // Writing to a string cannot fail.
    for solid in solids {
        let name = escaped(solid.name);
        for (name, color) in [
            (name.clone(), solid.color),
            (format!("{name} cap"), solid.cap_color),
        ] {
            let [r, g, b] = bytes_of(color);
            let _ = writeln!(
                text,
                "<base name=\"{name}\" displaycolor=\"#{r:02X}{g:02X}{b:02X}\"/>"
            );
        }
    }
    text.push_str("</basematerials>\n");
    let colors = Colors::of(solids);
    colors.write(&mut text);
    let object = |index: usize| COLORS + 1 + index;
    for (index, solid) in solids.iter().enumerate() {
        let (id, name) = (object(index), escaped(solid.name));
        let [faces, caps] = [2 * index, 2 * index + 1];
        let _ = writeln!(
            text,
            "<object id=\"{id}\" name=\"{name}\" type=\"model\" pid=\"{MATERIALS}\" pindex=\"{faces}\">\n<mesh>\n<vertices>"
        );
        for p in &solid.mesh.positions {
            let _ = writeln!(text, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
        }
        text.push_str("</vertices>\n<triangles>\n");
        for (triangle, [a, b, c]) in solid.mesh.triangles.iter().enumerate() {
            let _ = write!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"");
            if triangle >= solid.faces {
                let _ = write!(text, " pid=\"{MATERIALS}\" p1=\"{caps}\"");
            } else if let Some(coat) = &solid.coat {
                let [p1, p2, p3] = coat.triangles[triangle].colors.map(|c| colors.number(c));
                let _ = write!(
                    text,
                    " pid=\"{COLORS}\" p1=\"{p1}\" p2=\"{p2}\" p3=\"{p3}\""
                );
            }
            text.push_str("/>\n");
        }
        text.push_str("</triangles>\n</mesh>\n</object>\n");
    }
    text.push_str("</resources>\n<build>\n");
    for index in 0..solids.len() {
        let _ = writeln!(text, "<item objectid=\"{}\"/>", object(index));
    }
    text.push_str("</build>\n</model>\n");
    text
}

/// Text as a value of an attribute.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars().filter(|c| !c.is_control()) {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}
