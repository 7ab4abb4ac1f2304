//! Reads the elements of an ASCII PLY.
//!
//! Each element is a line, as the format requires, and blank lines are ignored. If reading by lines fails, elements are read word by word
//! regardless of lines, and all words must be used.

use std::str::SplitAsciiWhitespace;

use ply_rs_bw::ply::{ElementDef, PropertyType, ScalarType};

use super::PlyError;
use super::elements::Rows;
use crate::load::lines::{Lines, lines};

/// The words of a payload, grouped by line.
#[derive(Clone)]
pub(super) struct Words<'a> {
    lines: Lines<'a>,
    words: SplitAsciiWhitespace<'a>,
    line: &'a str,
    number: usize,
    /// True if each line is an element.
    by_line: bool,
}

/// Reads a payload that follows `lines_before` lines, first by lines and, if that fails, by words. Errors are those of reading by lines.
pub(super) fn in_either_layout<T>(
    text: &str,
    lines_before: usize,
    read: impl Fn(&mut Words<'_>) -> Result<T, PlyError>,
) -> Result<T, PlyError> {
    let mut words = Words {
        lines: lines(text),
        words: "".split_ascii_whitespace(),
        line: "",
        number: lines_before,
        by_line: true,
    };
    read(&mut words.clone()).or_else(|fault| {
        words.by_line = false;
        let all = read(&mut words).map_err(|_| ());
        match all {
            Ok(all) if words.next().is_none() => Ok(all),
            _ => Err(fault),
        }
    })
}

impl<'a> Words<'a> {
    pub(super) fn read<R: Rows>(
        &mut self,
        element: &ElementDef,
        mut rows: R,
    ) -> Result<R, PlyError> {
        let mut values = Vec::new();
        for number in 0..element.count {
            if self.by_line && !self.next_line() {
                return Err(PlyError::cut_off(Some(self.number), number, element));
            }
            rows.begin();
            for (column, property) in element.properties.values().enumerate() {
                let (count, kind) = match &property.data_type {
                    PropertyType::Scalar(kind) => (Some(1), kind),
                    PropertyType::List(_, kind) => (self.next().and_then(whole), widened(kind)),
                };
                let is_read = count.is_some_and(|count| self.values(count, kind, &mut values));
                if !is_read {
                    return Err(PlyError::of_line(self.number, self.line));
                }
                if rows.wants(column) {
                    let taken = rows.property(column, kind, &values);
                    let line = Some(self.number);
                    taken.map_err(|what| PlyError { line, what })?;
                }
            }
        }
        Ok(rows)
    }

    /// Advances to the next line with words.
    fn next_line(&mut self) -> bool {
        for line in self.lines.by_ref() {
            self.number += 1;
            if !line.trim_ascii().is_empty() {
                self.line = line;
                self.words = line.split_ascii_whitespace();
                return true;
            }
        }
        false
    }

    fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            if self.by_line || !self.next_line() {
                return None;
            }
        }
    }

    /// Reads the next values. Returns false if a word is not of this type.
    fn values(&mut self, count: i64, kind: &ScalarType, values: &mut Vec<f64>) -> bool {
        values.clear();
        for _ in 0..count {
            let Some(value) = self.next().and_then(|word| value(kind, word)) else {
                return false;
            };
            values.push(value);
        }
        count >= 0
    }
}

/// The widest type of the same kind. Programs declare lists of bytes and write indices of any size.
fn widened(kind: &ScalarType) -> &ScalarType {
    use ScalarType as Of;
    match kind {
        Of::Char | Of::Short | Of::Int => &Of::Int,
        Of::UChar | Of::UShort | Of::UInt => &Of::UInt,
        Of::Float | Of::Double => &Of::Double,
    }
}

/// Parses a number of this type.
fn value(kind: &ScalarType, word: &str) -> Option<f64> {
    use ScalarType as Of;
    let (least, greatest) = match kind {
        Of::Char => (i8::MIN.into(), i8::MAX.into()),
        Of::UChar => (0, u8::MAX.into()),
        Of::Short => (i16::MIN.into(), i16::MAX.into()),
        Of::UShort => (0, u16::MAX.into()),
        Of::Int => (i32::MIN.into(), i32::MAX.into()),
        Of::UInt => (0, u32::MAX.into()),
        Of::Float => {
            let number: f32 = word.parse().ok()?;
            return Some(number.into()).filter(|n: &f64| n.is_finite());
        }
        Of::Double => return finite(word),
    };
    let number: i64 = whole(word)?;
    (least..=greatest)
        .contains(&number)
        .then_some(number as f64)
}

fn finite(word: &str) -> Option<f64> {
    word.parse().ok().filter(|n: &f64| n.is_finite())
}

/// Parses a whole number, written as 3 or 3.0.
fn whole(word: &str) -> Option<i64> {
    let of_float = || finite(word).filter(|n| n.fract() == 0.0).map(|n| n as i64);
    word.parse().ok().or_else(of_float)
}
