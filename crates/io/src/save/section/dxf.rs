//! Writes sections as ASCII DXF for AutoCAD 2004 (`AC1018`), the first with true colours. Loops are closed polylines on part layers.
//!
//! Coordinates are those of [`svg`](super::svg): each plane is seen from the removed side, with `v` up, and planes are side by side. Points
//! in the first plane have exactly the coordinates `u` and `v` of the JSON. All digits are kept. Curves that do not close are open
//! polylines on a red layer `PART open`. Other layers have the part's cap colour. Programs without true colours show the nearest of the
//! first seven index colours. DXF has no fill rules, so in nested loops the inner loops are holes.
//!
//! Cost: one pass over the points.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use cutaway::scene::LengthUnit;

use super::svg::places;
use super::{Curve, PartReport, SectionReport};

/// The index colours that all programs agree on, each with its number and sRGB value.
const INDEXED: [(u8, [u8; 3]); 7] = [
    (1, [255, 0, 0]),
    (2, [255, 255, 0]),
    (3, [0, 255, 0]),
    (4, [0, 255, 255]),
    (5, [0, 0, 255]),
    (6, [255, 0, 255]),
    (7, [0, 0, 0]),
];

/// The layer that every drawing must have.
const ZERO: &str = "0";

/// First handle available to layers and polylines. Lower handles belong to tables, blocks and dictionaries.
const FIRST_FREE: u32 = 0x100;

/// The pairs of code and value written so far, and the next free handle.
struct DxfWriter {
    text: String,
    next: u32,
}

impl DxfWriter {
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

/// Returns the text of the DXF file.
pub fn dxf(report: &SectionReport, unit: Option<LengthUnit>) -> String {
    let mut draft = DxfWriter {
        text: String::new(),
        next: FIRST_FREE,
    };
    let layers = DxfLayers::of(report);
    let mut entities = DxfWriter {
        text: String::new(),
        next: FIRST_FREE + layers.colors.len() as u32 + 1,
    };
    for (plane, by) in report.sections.iter().zip(places(report)) {
        for part in &plane.parts {
            let [closed, open] = &layers.of_parts[&part.part];
            for (curves, layer, is_closed) in [
                (&part.loops, closed, true),
                (&part.open_chains, open, false),
                (&part.bridges, open, false),
            ] {
                curves
                    .iter()
                    .for_each(|curve| polyline(&mut entities, curve, layer, is_closed, by));
            }
        }
    }
    header(&mut draft, unit, entities.next);
    tables(&mut draft, &layers.colors);
    blocks(&mut draft);
    draft.pairs(&[(0, "SECTION"), (2, "ENTITIES")]);
    draft.text.push_str(&entities.text);
    draft.pairs(&[(0, "ENDSEC")]);
    objects(&mut draft);
    draft.pair(0, "EOF");
    draft.text
}

/// The layers of a drawing.
#[derive(Default)]
struct DxfLayers {
    /// The two layers of each part, for closed and for open curves, by part name.
    of_parts: BTreeMap<String, [String; 2]>,
    /// Colours by layer name.
    colors: BTreeMap<String, [u8; 3]>,
}

impl DxfLayers {
    fn of(report: &SectionReport) -> Self {
        let mut layers = Self::default();
        // Upper and lower case do not distinguish layer names.
        let mut taken = BTreeSet::from([ZERO.to_owned()]);
        for part in report.sections.iter().flat_map(|s| &s.parts) {
            let names = (layers.of_parts.entry(part.part.clone()))
                .or_insert_with(|| layer_names(&part.part, &mut taken));
            layers.colors.insert(names[0].clone(), color_of(part));
            if !part.open_chains.is_empty() || !part.bridges.is_empty() {
                layers.colors.insert(names[1].clone(), [255, 0, 0]);
            }
        }
        layers
    }
}

fn color_of(part: &PartReport) -> [u8; 3] {
    [0, 1, 2].map(|i| {
        let digits = part.color.get(1 + 2 * i..3 + 2 * i);
        let channel = digits.and_then(|d| u8::from_str_radix(d, 16).ok());
        channel.unwrap_or_default()
    })
}

/// Unique names for the two layers of a part, without invalid characters.
fn layer_names(part: &str, taken: &mut BTreeSet<String>) -> [String; 2] {
    let banned = |c: char| c.is_control() || "<>/\\\":;?*|=`,".contains(c);
    let plain: String = part
        .chars()
        .map(|c| if banned(c) { '_' } else { c })
        .take(200)
        .collect();
    let plain = match plain.trim() {
        "" | ZERO => "part",
        plain => plain,
    };
    let numbered = (2..).map(|i| format!("{plain}_{i}"));
    let mut pairs = std::iter::once(plain.to_owned())
        .chain(numbered)
        .map(|name| [name.clone(), format!("{name} open")]);
    let is_free = |pair: &[String; 2]| pair.iter().all(|n| !taken.contains(&n.to_lowercase()));
    let pair = pairs.find(is_free).unwrap_or_default();
    taken.extend(pair.iter().map(|name| name.to_lowercase()));
    pair.map(|name| in_ascii(&name))
}

/// Escapes characters that are not ASCII by their code numbers, in DXF notation.
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

fn polyline(draft: &mut DxfWriter, curve: &Curve, layer: &str, is_closed: bool, by: [f64; 2]) {
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

/// The value of `$INSUNITS`.
fn insunits(unit: LengthUnit) -> u8 {
    match unit {
        LengthUnit::In => 1,
        LengthUnit::Ft => 2,
        LengthUnit::Mm => 4,
        LengthUnit::Cm => 5,
        LengthUnit::M => 6,
        LengthUnit::Micron => 13,
    }
}

fn header(draft: &mut DxfWriter, unit: Option<LengthUnit>, next: u32) {
    draft.pairs(&[
        (999, "written by cutaway"),
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1018"),
        (9, "$DWGCODEPAGE"),
        (3, "ANSI_1252"),
        (9, "$INSUNITS"),
    ]);
    draft.pair(70, unit.map_or(0, insunits));
    draft.pairs(&[(9, "$MEASUREMENT")]);
    draft.pair(
        70,
        u8::from(!matches!(unit, Some(LengthUnit::In | LengthUnit::Ft))),
    );
    draft.pairs(&[(9, "$HANDSEED")]);
    draft.pair(5, format!("{next:X}"));
    draft.pairs(&[(0, "ENDSEC")]);
}

fn tables(draft: &mut DxfWriter, layers: &BTreeMap<String, [u8; 3]>) {
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

fn table(draft: &mut DxfWriter, name: &str, handle: &str, count: usize) {
    draft.pairs(&[
        (0, "TABLE"),
        (2, name),
        (5, handle),
        (330, "0"),
        (100, "AcDbSymbolTable"),
    ]);
    draft.pair(70, count);
}

fn record(draft: &mut DxfWriter, kind: &str, owner: &str, handle: &str, class: &str, name: &str) {
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

fn blocks(draft: &mut DxfWriter) {
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

fn objects(draft: &mut DxfWriter) {
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
