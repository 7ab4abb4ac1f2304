//! The list: every hard case by its number, what is expected in words, and the tests that hold what is more than its pictures.

mod beyond;
mod frames;
mod solids;
mod surfaces;
mod users;

use beyond::BEYOND;
use frames::FRAMES;
use solids::SOLIDS;
use surfaces::SURFACES;
use users::USERS;

/// A line of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its number, or its letter and number where users of other projects met it: `B` by the thread of a project, `U` by many.
    pub id: &'static str,
    /// What it is.
    pub name: &'static str,
    /// What is expected of an exact strategy, in words.
    pub expected: &'static str,
    /// Modules of the tests and functions below them, separated by a space.
    pub tests: &'static [&'static str],
}

impl Listed {
    /// The tests as one would type them after `cargo test -p cutaway-tests`, one after the other; none if pictures are all of it.
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
    [SOLIDS, SURFACES, FRAMES, BEYOND, USERS]
        .into_iter()
        .flatten()
}

const fn listed(
    id: &'static str,
    name: &'static str,
    expected: &'static str,
    tests: &'static [&'static str],
) -> Listed {
    Listed {
        id,
        name,
        expected,
        tests,
    }
}
