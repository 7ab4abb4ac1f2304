//! Table of hard cases and of the strategies expected to draw them. Its rows are files.

use std::sync::LazyLock;

use super::case::Case;
use super::files;

static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    // They are part of the program, and a test reads them.
    files::read_all().unwrap_or_else(|e| panic!("internal error: {e}"))
});

/// All cases that are judged by their pictures.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    CASES.iter()
}
