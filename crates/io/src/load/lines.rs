//! The lines of a text, whichever of LF, CR LF and CR alone ends them.

use std::iter::Map;
use std::str::SplitTerminator;

pub(super) type Lines<'a> = Map<SplitTerminator<'a, char>, fn(&'a str) -> &'a str>;

/// The lines of a text. CR ends them where no line ends by LF.
pub(super) fn lines(text: &str) -> Lines<'_> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let bare: fn(&str) -> &str = |line| line.strip_suffix('\r').unwrap_or(line);
    text.split_terminator(end).map(bare)
}
