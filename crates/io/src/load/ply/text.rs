//! Reads the elements of an ASCII PLY.
//!
//! Each element is a line, as the format requires, and blank lines are ignored. If reading by lines fails, elements are read word by word
//! regardless of lines, and all words must be used.

use std::str::SplitAsciiWhitespace;

use ply_rs_bw::ply::{
    ElementDef, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType,
};

use super::PlyError;
use crate::load::lines::{Lines, lines};

/// Maximum capacity that is reserved before the elements that the header counts have been seen.
const MOST_RESERVED: usize = 1 << 16;

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
    pub(super) fn read<E: PropertyAccess>(
        &mut self,
        element: &ElementDef,
    ) -> Result<Vec<E>, PlyError> {
        let mut all = Vec::with_capacity(element.count.min(MOST_RESERVED));
        for number in 0..element.count {
            if self.by_line && !self.next_line() {
                return Err(PlyError {
                    line: Some(self.number),
                    what: format!(
                        "the file ends after {number} of {} `{}`",
                        element.count, element.name
                    ),
                });
            }
            let mut item = E::new();
            for (name, property) in &element.properties {
                let value = self.value(&property.data_type);
                let set = value.map(|value| item.set_property(name, value));
                if !matches!(
                    set,
                    Some(PropertyAccessResult::Set | PropertyAccessResult::Ignored)
                ) {
                    return Err(PlyError::of_line(self.number, self.line));
                }
            }
            all.push(item);
        }
        Ok(all)
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

    /// Returns the next value, or `None` if the next word is not of this type.
    fn value(&mut self, kind: &PropertyType) -> Option<Property> {
        use ScalarType as Of;
        let (length, kind) = match kind {
            PropertyType::List(_, kind) => (usize::try_from(whole(self.next()?)?).ok()?, kind),
            PropertyType::Scalar(kind) => {
                let word = self.next()?;
                return Some(match kind {
                    Of::Char => Property::Char(whole(word)?.try_into().ok()?),
                    Of::UChar => Property::UChar(whole(word)?.try_into().ok()?),
                    Of::Short => Property::Short(whole(word)?.try_into().ok()?),
                    Of::UShort => Property::UShort(whole(word)?.try_into().ok()?),
                    Of::Int => Property::Int(whole(word)?.try_into().ok()?),
                    Of::UInt => Property::UInt(whole(word)?.try_into().ok()?),
                    Of::Float => {
                        Property::Float(word.parse().ok().filter(|n: &f32| n.is_finite())?)
                    }
                    Of::Double => Property::Double(finite(word)?),
                });
            }
        };
        let mut words = (0..length).map(|_| self.next());
        Some(match kind {
            Of::Char | Of::Short | Of::Int => Property::ListInt(
                words
                    .map(|w| whole(w?)?.try_into().ok())
                    .collect::<Option<_>>()?,
            ),
            Of::UChar | Of::UShort | Of::UInt => Property::ListUInt(
                words
                    .map(|w| whole(w?)?.try_into().ok())
                    .collect::<Option<_>>()?,
            ),
            Of::Float | Of::Double => {
                Property::ListDouble(words.by_ref().map(|w| finite(w?)).collect::<Option<_>>()?)
            }
        })
    }
}

fn finite(word: &str) -> Option<f64> {
    word.parse().ok().filter(|n: &f64| n.is_finite())
}

/// Parses a whole number, written as 3 or 3.0.
fn whole(word: &str) -> Option<i64> {
    let of_float = || finite(word).filter(|n| n.fract() == 0.0).map(|n| n as i64);
    word.parse().ok().or_else(of_float)
}
