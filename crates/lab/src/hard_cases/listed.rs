//! The list: every hard case by its number, what is expected in words, and the tests that hold what is more than its pictures.
//!
//! It is data, `list.toml` next to this file, and read once.

use std::path::Path;
use std::sync::LazyLock;

use cutaway::Result;
use cutaway_io::document::reader::{Entry, with_table};

const FILE: &str = "list.toml";

/// A line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its number, or its letter and number where users of other projects met it: `B` by the thread of a project, `U` by many.
    pub id: String,
    /// Description of the case.
    pub name: String,
    /// Expected result of an exact strategy, in words.
    pub expected: String,
    /// Modules of the tests and functions below them, separated by a space.
    pub tests: Vec<String>,
}

impl Listed {
    /// The tests as one would type them after `cargo test -p cutaway-tests`, one after the other; none if pictures cover all.
    pub fn held_by(&self) -> Option<String> {
        let functions = self.tests.iter().filter_map(|t| t.split_once(' '));
        let typed: Vec<String> = functions
            .map(|(_, name)| format!("--test it {name}"))
            .collect();
        (!typed.is_empty()).then(|| typed.join("; "))
    }
}

/// All of them, in order.
pub fn list() -> impl Iterator<Item = &'static Listed> {
    static LIST: LazyLock<Vec<Listed>> = LazyLock::new(|| {
        let read = read(include_str!("list.toml"));
        read.unwrap_or_else(|fault| panic!("the list of hard cases: {fault}"))
    });
    LIST.iter()
}

fn read(text: &str) -> Result<Vec<Listed>> {
    with_table(Path::new(FILE), text, &["case"], |root| {
        root.tables("case")?.iter().map(listed).collect()
    })
}

fn listed(entry: &Entry<'_>) -> Result<Listed> {
    let table = entry.table(&["id", "name", "expected", "tests"])?;
    let text = |key| table.need(key, "\"...\"")?.text().map(str::to_owned);
    Ok(Listed {
        id: text("id")?,
        name: text("name")?,
        expected: text("expected")?,
        tests: table.need("tests", "[]")?.texts()?,
    })
}
