//! The lines of a text, whichever of LF, CR LF and CR alone ends them, and the mark that may stand before them.

use std::iter::Map;
use std::str::SplitTerminator;

pub(super) type Lines<'a> = Map<SplitTerminator<'a, char>, fn(&'a str) -> &'a str>;

/// The lines of a text. CR ends them where no line ends by LF.
pub(super) fn lines(text: &str) -> Lines<'_> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    let bare: fn(&str) -> &str = |line| line.strip_suffix('\r').unwrap_or(line);
    text.split_terminator(end).map(bare)
}

/// Text without the byte order mark that editors on Windows put before it.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
