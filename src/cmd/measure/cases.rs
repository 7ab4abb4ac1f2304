//! Runs of hard cases and of the property search: the one place where they are asked.

use crate::Result;
use crate::experiment::CaseRecord;
use crate::experiment::definition::{AskedCases, AskedSearch};
use crate::session::Session;

/// What came of the hard cases that are asked for; none where they are not built into this program.
pub(super) fn cases(
    _session: &mut Session,
    _asked: &AskedCases,
    _step: &mut dyn FnMut(String),
) -> Result<Option<Vec<CaseRecord>>> {
    Ok(None)
}

/// What a search found, as one case; none where the search is not built into this program.
pub(super) fn search(
    _session: &mut Session,
    _asked: &AskedSearch,
    _step: &mut dyn FnMut(String),
) -> Result<Option<Vec<CaseRecord>>> {
    Ok(None)
}
