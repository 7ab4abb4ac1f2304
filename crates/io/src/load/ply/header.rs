//! Separates the header of a PLY file from its payload.
//!
//! A header line that does not begin with a header word is treated as a comment, because old versions of Blender wrote comments that way. A
//! misspelt header word does not become a comment. Blank lines do. Lines may end with LF, CR LF, or CR alone.

use cutaway::error::Diagnostic;
use std::path::Path;

/// First words of header lines.
const WORDS: [&str; 7] = [
    "ply",
    "format",
    "comment",
    "obj_info",
    "element",
    "property",
    "end_header",
];

/// Maximum header length in bytes.
const LONGEST: usize = 1 << 20;

/// Smallest similarity at which a word counts as a misspelling of a header word.
const MISSPELT: f64 = 0.8;

/// Splits a file into header and payload. In the returned header, lines end with LF, and unrecognized lines are comments. Without an end
/// marker the whole file is header.
pub(super) fn split<'a>(
    path: &Path,
    bytes: &'a [u8],
    notes: &mut Vec<Diagnostic>,
) -> (String, &'a [u8]) {
    let (header, payload) = bytes.split_at(length(bytes));
    let header = String::from_utf8_lossy(header);
    let mut text = String::with_capacity(header.len() + 64);
    for (number, line) in (1..).zip(super::super::lines::lines(&header)) {
        let word = line.split_whitespace().next().unwrap_or("").to_lowercase();
        let is_like = |known: &&str| strsim::jaro_winkler(known, &word) > MISSPELT;
        let is_known = WORDS.iter().any(is_like);
        if !word.is_empty() && !is_known {
            let shown: String = line.trim().chars().take(40).collect();
            let text = format!("read as a comment: {shown:?}");
            notes.push(Diagnostic::note("ply-unknown-keyword", text).at_line(path, number));
        }
        if !is_known {
            text.push_str("comment ");
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    (text, payload)
}

/// Length of the header in bytes, including its last line break.
fn length(bytes: &[u8]) -> usize {
    const END: &[u8] = b"end_header";
    let head = &bytes[..bytes.len().min(LONGEST)];
    let is_at = |at: &usize| head[*at..].starts_with(END) && matches!(head[at - 1], b'\n' | b'\r');
    let Some(end) = (1..head.len()).find(is_at) else {
        return bytes.len();
    };
    // If no earlier line ends with LF, header lines end with CR, and an LF after `end_header` may belong to the payload.
    let ends = if head[..end].contains(&b'\n') {
        b'\n'
    } else {
        b'\r'
    };
    let rest = bytes[end..].iter().position(|byte| *byte == ends);
    rest.map_or(bytes.len(), |rest| end + rest + 1)
}
