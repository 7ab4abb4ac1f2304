//! Table of hard cases, each with the expected results of strategies. Each row is a file.

use std::sync::LazyLock;

use super::case::Case;
use super::files;

static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    // The files are part of the program, and a test reads them.
    files::read_all().unwrap_or_else(|e| panic!("internal error: {e}"))
});

/// All cases judged by their pictures.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    CASES.iter()
}
