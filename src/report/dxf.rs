//! Sections as a drawing for CAD: ASCII DXF of AutoCAD 2000 (`AC1015`), each loop a closed polyline on the layer of its part.
//!
//! Coordinates are those of [`svg`](super::svg): each plane as it is seen from the side that is removed, `v` up, the planes beside each
//! other, the first with the very `u` and `v` of the JSON. All digits of a coordinate are kept. Curves that do not close are open polylines on
//! a layer `PART open`, which is red; a layer has the colour of the cap, which programs that know only the 255 colours of the index
//! show in the nearest of the first seven. A drawing says nothing of fill rules: where loops nest, the inner ones are holes.
//!
//! Cost: one pass over the points.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::section::{Curve, SectionReport};
use super::svg::{Unit, places};

/// The colours of the index that all programs have: number and sRGB.
const INDEXED: [(u8, [u8; 3]); 7] = [
    (1, [255, 0, 0]),
    (2, [255, 255, 0]),
    (3, [0, 255, 0]),
    (4, [0, 255, 255]),
    (5, [0, 0, 255]),
    (6, [255, 0, 255]),
    (7, [0, 0, 0]),
];

/// The layer that every drawing has.
const ZERO: &str = "0";

/// Handles of what comes before the layers and the polylines: tables, blocks and dictionaries.
const FIRST_FREE: u32 = 0x100;

/// Pairs of a code and a value, as the format has them, and the next free handle.
struct Draft {
    text: String,
    next: u32,
}

impl Draft {
    fn pair(&mut self, code: u16, value: impl std::fmt::Display) {
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{code:>3}\n{value}\n");
    }

    fn pairs(&mut self, pairs: &[(u16, &str)]) {
        pairs
            .iter()
            .for_each(|(code, value)| self.pair(*code, value));
    }

    fn handle(&mut self) -> String {
        self.next += 1;
        format!("{:X}", self.next - 1)
    }
}

/// The drawing as the text of a file.
pub fn dxf(report: &SectionReport, unit: Option<Unit>) -> String {
    let mut draft = Draft {
        text: String::new(),
        next: FIRST_FREE,
    };
    let layers = layers(report);
    let mut entities = Draft {
        text: String::new(),
        next: FIRST_FREE + layers.len() as u32 + 1,
    };
    for (plane, by) in report.sections.iter().zip(places(report)) {
        for part in &plane.parts {
            for (curves, layer, is_closed) in [
                (&part.loops, layer_of(&part.part), true),
                (&part.open_chains, open_layer_of(&part.part), false),
            ] {
                curves
                    .iter()
                    .for_each(|curve| polyline(&mut entities, curve, &layer, is_closed, by));
            }
        }
    }
    header(&mut draft, unit, entities.next);
    tables(&mut draft, &layers);
    blocks(&mut draft);
    draft.pairs(&[(0, "SECTION"), (2, "ENTITIES")]);
    draft.text.push_str(&entities.text);
    draft.pairs(&[(0, "ENDSEC")]);
    objects(&mut draft);
    draft.pair(0, "EOF");
    draft.text
}

/// Names of layers, and their colours.
fn layers(report: &SectionReport) -> BTreeMap<String, [u8; 3]> {
    let mut layers = BTreeMap::new();
    for part in report.sections.iter().flat_map(|s| &s.parts) {
        let channel = |i: usize| {
            let digits = part.color.get(1 + 2 * i..3 + 2 * i);
            digits
                .and_then(|d| u8::from_str_radix(d, 16).ok())
                .unwrap_or_default()
        };
        layers.insert(layer_of(&part.part), [0, 1, 2].map(channel));
        if !part.open_chains.is_empty() {
            layers.insert(open_layer_of(&part.part), [255, 0, 0]);
        }
    }
    layers
}

/// A name without the characters that names of layers must not have.
fn layer_of(part: &str) -> String {
    let banned = |c: char| c.is_control() || "<>/\\\":;?*|=`,".contains(c);
    let name: String = part
        .chars()
        .map(|c| if banned(c) { '_' } else { c })
        .take(200)
        .collect();
    match name.trim() {
        "" | ZERO => "part".to_owned(),
        name => in_ascii(name),
    }
}

fn open_layer_of(part: &str) -> String {
    format!("{} open", layer_of(part))
}

/// Other characters by their numbers, as the format writes them.
fn in_ascii(text: &str) -> String {
    let mut ascii = String::with_capacity(text.len());
    for unit in text.encode_utf16() {
        match u8::try_from(unit) {
            Ok(byte) if byte.is_ascii() => ascii.push(char::from(byte)),
            _ => {
                let _ = write!(ascii, "\\U+{unit:04X}");
            }
        }
    }
    ascii
}

fn polyline(draft: &mut Draft, curve: &Curve, layer: &str, is_closed: bool, by: [f64; 2]) {
    let handle = draft.handle();
    draft.pairs(&[
        (0, "LWPOLYLINE"),
        (5, &handle),
        (330, "1F"),
        (100, "AcDbEntity"),
        (8, layer),
        (100, "AcDbPolyline"),
    ]);
    draft.pair(90, curve.uv.len());
    draft.pair(70, u8::from(is_closed));
    for [u, v] in &curve.uv {
        draft.pair(10, format!("{:?}", u + by[0]));
        draft.pair(20, format!("{:?}", v - by[1]));
    }
}

fn header(draft: &mut Draft, unit: Option<Unit>, next: u32) {
    draft.pairs(&[
        (999, "written by cutaway"),
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1015"),
        (9, "$DWGCODEPAGE"),
        (3, "ANSI_1252"),
        (9, "$INSUNITS"),
    ]);
    draft.pair(70, unit.map_or(0, Unit::in_dxf));
    draft.pairs(&[(9, "$MEASUREMENT")]);
    draft.pair(70, u8::from(unit != Some(Unit::In)));
    draft.pairs(&[(9, "$HANDSEED")]);
    draft.pair(5, format!("{next:X}"));
    draft.pairs(&[(0, "ENDSEC")]);
}

fn tables(draft: &mut Draft, layers: &BTreeMap<String, [u8; 3]>) {
    draft.pairs(&[(0, "SECTION"), (2, "TABLES")]);
    table(draft, "VPORT", "8", 0);
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "LTYPE", "5", 3);
    for (handle, name) in [("14", "ByBlock"), ("15", "ByLayer"), ("16", "Continuous")] {
        record(draft, "LTYPE", "5", handle, "AcDbLinetypeTableRecord", name);
        draft.pairs(&[(3, ""), (72, "65"), (73, "0"), (40, "0.0")]);
    }
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "LAYER", "2", layers.len() + 1);
    let zero = (ZERO.to_owned(), [0; 3]);
    let all = std::iter::once((&zero.0, &zero.1)).chain(layers);
    for (name, color) in all {
        let handle = if name == ZERO {
            "10".to_owned()
        } else {
            draft.handle()
        };
        record(draft, "LAYER", "2", &handle, "AcDbLayerTableRecord", name);
        let [r, g, b] = color.map(u32::from);
        draft.pair(62, nearest_index(*color));
        if name != ZERO {
            draft.pair(420, (r << 16) | (g << 8) | b);
        }
        draft.pairs(&[(6, "Continuous"), (390, "0")]);
    }
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "STYLE", "3", 1);
    record(
        draft,
        "STYLE",
        "3",
        "11",
        "AcDbTextStyleTableRecord",
        "Standard",
    );
    draft.pairs(&[
        (40, "0.0"),
        (41, "1.0"),
        (50, "0.0"),
        (71, "0"),
        (42, "2.5"),
        (3, "txt"),
        (4, ""),
    ]);
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "VIEW", "6", 0);
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "UCS", "7", 0);
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "APPID", "9", 1);
    record(draft, "APPID", "9", "12", "AcDbRegAppTableRecord", "ACAD");
    draft.pairs(&[(0, "ENDTAB")]);
    table(draft, "DIMSTYLE", "A", 0);
    draft.pairs(&[(100, "AcDbDimStyleTable"), (0, "ENDTAB")]);
    table(draft, "BLOCK_RECORD", "1", 2);
    for (handle, name) in [("1F", "*Model_Space"), ("1B", "*Paper_Space")] {
        draft.pairs(&[
            (0, "BLOCK_RECORD"),
            (5, handle),
            (330, "1"),
            (100, "AcDbSymbolTableRecord"),
        ]);
        draft.pairs(&[(100, "AcDbBlockTableRecord"), (2, name), (340, "0")]);
    }
    draft.pairs(&[(0, "ENDTAB"), (0, "ENDSEC")]);
}

fn table(draft: &mut Draft, name: &str, handle: &str, count: usize) {
    draft.pairs(&[
        (0, "TABLE"),
        (2, name),
        (5, handle),
        (330, "0"),
        (100, "AcDbSymbolTable"),
    ]);
    draft.pair(70, count);
}

fn record(draft: &mut Draft, kind: &str, owner: &str, handle: &str, class: &str, name: &str) {
    draft.pairs(&[
        (0, kind),
        (5, handle),
        (330, owner),
        (100, "AcDbSymbolTableRecord"),
        (100, class),
        (2, name),
        (70, "0"),
    ]);
}

fn blocks(draft: &mut Draft) {
    draft.pairs(&[(0, "SECTION"), (2, "BLOCKS")]);
    for (owner, name, begin, end) in [
        ("1F", "*Model_Space", "20", "21"),
        ("1B", "*Paper_Space", "1C", "1D"),
    ] {
        draft.pairs(&[
            (0, "BLOCK"),
            (5, begin),
            (330, owner),
            (100, "AcDbEntity"),
            (8, ZERO),
        ]);
        draft.pairs(&[
            (100, "AcDbBlockBegin"),
            (2, name),
            (70, "0"),
            (10, "0.0"),
            (20, "0.0"),
            (30, "0.0"),
        ]);
        draft.pairs(&[(3, name), (1, "")]);
        draft.pairs(&[
            (0, "ENDBLK"),
            (5, end),
            (330, owner),
            (100, "AcDbEntity"),
            (8, ZERO),
            (100, "AcDbBlockEnd"),
        ]);
    }
    draft.pairs(&[(0, "ENDSEC")]);
}

fn objects(draft: &mut Draft) {
    draft.pairs(&[(0, "SECTION"), (2, "OBJECTS")]);
    draft.pairs(&[
        (0, "DICTIONARY"),
        (5, "C"),
        (330, "0"),
        (100, "AcDbDictionary"),
        (281, "1"),
    ]);
    draft.pairs(&[(3, "ACAD_GROUP"), (350, "D")]);
    draft.pairs(&[
        (0, "DICTIONARY"),
        (5, "D"),
        (330, "C"),
        (100, "AcDbDictionary"),
        (281, "1"),
    ]);
    draft.pairs(&[(0, "ENDSEC")]);
}

fn nearest_index(color: [u8; 3]) -> u8 {
    let distance = |other: [u8; 3]| -> i32 {
        let squares = color
            .iter()
            .zip(other)
            .map(|(a, b)| (i32::from(*a) - i32::from(b)).pow(2));
        squares.sum()
    };
    let nearest = INDEXED.iter().min_by_key(|(_, other)| distance(*other));
    nearest.map_or(7, |(index, _)| *index)
}
