//! Converts errors in a PLY file to messages of one line.

use std::io::ErrorKind;

use ply_rs_bw::parser::ParseError;
use ply_rs_bw::ply::ElementDef;

/// An error message, and the line of the error.
pub(super) struct PlyError {
    pub(super) line: Option<usize>,
    pub(super) what: String,
}

impl PlyError {
    /// The parser's error message in one line.
    pub(super) fn of(error: &ParseError) -> Self {
        let text = error.to_string();
        let text = match text.split_once(": ") {
            Some((_, rest)) if error.line().is_some() => rest,
            _ => &text,
        };
        Self {
            line: None,
            what: shown(text.lines().next().unwrap_or(text)),
        }
    }

    /// The parser's error message about a header, and the faulty line.
    pub(super) fn in_header(error: &ParseError, header: &str) -> Self {
        match error.line() {
            Some(line) if error.kind() != ErrorKind::UnexpectedEof => {
                Self::of_line(line, header.lines().nth(line - 1).unwrap_or_default())
            }
            line => Self {
                line,
                ..Self::of(error)
            },
        }
    }

    /// The error of a payload that ends before the last row of an element.
    pub(super) fn cut_off(line: Option<usize>, rows: usize, element: &ElementDef) -> Self {
        let (count, name) = (element.count, &element.name);
        Self {
            line,
            what: format!("the file ends after {rows} of {count} `{name}`"),
        }
    }

    pub(super) fn of_line(line: usize, text: &str) -> Self {
        Self {
            line: Some(line),
            what: format!("`{}` is not valid PLY here", shown(text.trim())),
        }
    }
}

fn shown(text: &str) -> String {
    text.chars().take(160).collect()
}
