//! The list of hard cases: each with its number, the expected result in words, and the tests of what its pictures cannot show.
//!
//! The list is data, in `list.toml` next to this file, and read once.

use std::path::Path;
use std::sync::LazyLock;

use cutaway::Result;
use cutaway_io::document::reader::{Entry, with_table};

const FILE: &str = "list.toml";

/// A line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// The case's number or, if users of other projects met it, a letter and a number: `B` for one project's thread, `U` for many projects.
    pub id: String,
    /// Description of the case.
    pub name: String,
    /// Expected result of an exact strategy, in words.
    pub expected: String,
    /// Tests: a module and functions in it, separated by spaces.
    pub tests: Vec<String>,
}

impl Listed {
    /// Arguments after `cargo test -p cutaway-tests` that run the tests; `None` if the pictures cover everything.
    pub fn held_by(&self) -> Option<String> {
        let functions = self.tests.iter().filter_map(|t| t.split_once(' '));
        let typed: Vec<String> = functions
            .map(|(_, name)| format!("--test it {name}"))
            .collect();
        (!typed.is_empty()).then(|| typed.join("; "))
    }
}

/// All hard cases, in order.
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
