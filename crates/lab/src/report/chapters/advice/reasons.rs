//! Reasons for refusals, shortened to fit in a table cell.

use crate::report::document::Cell;

/// The reasons, shortened to one line; the tooltip has the full text.
pub(in crate::report::chapters) fn short(reasons: &[String]) -> Cell {
    const MOST: usize = 48;
    let Some(first) = reasons.first() else {
        return Cell::default();
    };
    let sentence = first
        .split(['.', ';', ',', '('])
        .next()
        .unwrap_or(first)
        .trim_end();
    let mut text: String = sentence.chars().take(MOST).collect();
    if text.len() < first.len() {
        text.push('…');
    }
    if reasons.len() > 1 {
        text.push_str(&format!(" (and {} more)", reasons.len() - 1));
    }
    Cell::from(text).titled(reasons.join("; "))
}
