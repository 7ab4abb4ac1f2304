//! Schema of a scene: every path, with its value type. `cutaway help scene` prints the list, and readers refuse any other path.
//!
//! A `*` stands for an entry's name or index, so `part.*.translate` matches `part.crank.translate` and `part.0.translate`.

use std::sync::{LazyLock, OnceLock};

use cutaway::generate::defects::{Defect, DefectKind};
pub use cutaway::scene::describe::ValueType;
use cutaway::scene::describe::{Described, Field, Leaf};
use cutaway::scene::relief::Procedure;
use cutaway::scene::{Amount, Breakaway, Style};

use super::describe::{
    BoxDesc, CameraDesc, CutDesc, CutoutDesc, DeformDesc, KeyDesc, PartDesc, ReliefDesc, RolesDesc,
    Settings, SurfaceDesc, WedgeDesc,
};
use super::node::Value;

/// A value of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Dotted path.
    pub path: String,
    /// Type of the value.
    pub takes: ValueType,
    /// Unit of the numbers, or an empty string if they have none.
    pub unit: &'static str,
    /// Description in one line.
    pub help: &'static str,
    /// Example value, as TOML.
    pub example: &'static str,
    /// True if a `[[key]]` can animate the value.
    pub moves: bool,
}

/// All values of a scene, in the order in which they are listed.
pub fn all() -> &'static [Path] {
    static ALL: LazyLock<Vec<Path>> = LazyLock::new(|| {
        let mut all = Vec::new();
        for (above, fields) in TABLES {
            append(&mut all, above, fields);
        }
        all
    });
    &ALL
}

/// The value at a path, in which `*` stands for entries.
pub fn find(path: &str) -> Option<&'static Path> {
    all().iter().find(|known| known.path == path)
}

fn append(all: &mut Vec<Path>, above: &str, fields: &'static [Field]) {
    for field in fields {
        match (field.key, field.takes) {
            ("", _) => append(all, above, field.below),
            (key, ValueType::Table) => append(all, &below(above, key), field.below),
            (key, _) => all.push(path_of(below(above, key), field)),
        }
    }
}

/// Values of a style or another description, with their paths below `above`.
pub fn values(of: &dyn Described, above: &str) -> Vec<(String, Value)> {
    let mut all = Vec::new();
    for (index, field) in of.fields().iter().enumerate() {
        let path = match field.key {
            "" => above.to_owned(),
            key => below(above, key),
        };
        match (of.below(index), of.get(index)) {
            (Some(table), _) => all.extend(values(table, &path)),
            (None, Some(given)) => all.push((path, given.into())),
            (None, None) => {}
        }
    }
    all
}

fn below(above: &str, key: &str) -> String {
    match above {
        "" => key.to_owned(),
        above => format!("{above}.{key}"),
    }
}

fn path_of(path: String, field: &Field) -> Path {
    Path {
        path,
        takes: field.takes,
        unit: field.unit,
        help: field.help,
        example: field.example,
        moves: field.moves,
    }
}

/// Tables and their values, in the order in which they are listed.
const TABLES: &[(&str, &[Field])] = &[
    ("", Settings::FIELDS),
    ("style", &[BASE]),
    ("style", Style::FIELDS),
    ("camera", CameraDesc::FIELDS),
    ("part.*", PartDesc::FIELDS),
    ("part.*.defects.*", &[KIND_OF_DEFECT]),
    ("part.*.defects.*", Defect::FIELDS),
    ("part.*.deform.*", DeformDesc::FIELDS),
    ("roles", RolesDesc::FIELDS),
    ("relief.*", ReliefDesc::FIELDS),
    ("relief.*", Procedure::FIELDS),
    ("cut.*", CutDesc::FIELDS),
    ("cut.*.offset", &[OFFSET]),
    ("cut.*.surfaces.*", SurfaceDesc::FIELDS),
    ("cut.*.box", BoxDesc::FIELDS),
    ("cut.*.wedge", WedgeDesc::FIELDS),
    ("cut.*.cutout", CutoutDesc::FIELDS),
    ("cut.*.breakaway", Breakaway::FIELDS),
    ("key.*", KeyDesc::FIELDS),
];

const BASE: Field = Field::leaf(
    "base",
    "name or file of the base style, which the other keys change; without changes write style = \"technical\"",
    ValueType::Text,
    "\"technical\"",
);

const KIND_OF_DEFECT: Field = Field::leaf(
    "kind",
    "kind of deliberate mesh damage",
    ValueType::Choice(&DefectKind::NAMES),
    "\"holes\"",
);

const OFFSET: Field = Field::leaf(
    "*",
    "distance by which the cut is moved back for a part, so that more of the part is kept; the key is the part's name or a glob",
    Amount::TYPE,
    "\"5%\"",
)
.unit("units");

/// Keys directly below a path, computed once. Below `part.*`, for example, they are `name`, `mesh` and so on.
pub(crate) struct Keys {
    above: &'static str,
    found: OnceLock<Vec<&'static str>>,
}

impl Keys {
    /// Keys below a path. An empty path gives the top-level keys.
    pub(crate) const fn below(above: &'static str) -> Self {
        Self {
            above,
            found: OnceLock::new(),
        }
    }

    /// All keys, in the order of [`all`].
    pub(crate) fn all(&self) -> &[&'static str] {
        self.found.get_or_init(|| keys_below(self.above))
    }
}

/// Keys directly below a path.
pub(crate) fn keys_below(above: &str) -> Vec<&'static str> {
    let mut keys: Vec<&str> = Vec::new();
    for path in all() {
        let below: Option<&'static str> = match above {
            "" => Some(path.path.as_str()),
            above => (path.path.strip_prefix(above)).and_then(|rest| rest.strip_prefix('.')),
        };
        let Some(key) = below.and_then(|below| below.split('.').next()) else {
            continue;
        };
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}
