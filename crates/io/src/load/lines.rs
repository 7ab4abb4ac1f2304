//! Splits text into lines that end with LF, CR LF or CR alone, and removes a byte order mark.

use std::iter::Map;
use std::str::SplitTerminator;

pub(super) type Lines<'a> = Map<SplitTerminator<'a, char>, fn(&'a str) -> &'a str>;

/// The lines of a text. CR ends a line only if the text contains no LF.
pub(super) fn lines(text: &str) -> Lines<'_> {
    lines_ending(text, line_end(text.as_bytes()))
}

/// The character that ends the lines of a text: LF, or CR if the text contains no LF.
pub(super) fn line_end(text: &[u8]) -> char {
    if text.contains(&b'\n') { '\n' } else { '\r' }
}

/// The lines of a text that end with this character. CR before LF is no part of a line.
pub(super) fn lines_ending(text: &str, end: char) -> Lines<'_> {
    let bare: fn(&str) -> &str = |line| line.strip_suffix('\r').unwrap_or(line);
    text.split_terminator(end).map(bare)
}

/// Returns a text without the byte order mark that Windows editors put at its start.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}
