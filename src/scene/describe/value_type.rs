//! Types of values, with their ranges.

use std::fmt;

use crate::scene::units::range::SMALLEST;

/// Type of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ValueType {
    /// A number between two limits.
    Number(f64, f64),
    /// A whole number between two limits.
    Whole(f64, f64),
    /// A list of this many numbers between two limits.
    Numbers(usize, f64, f64),
    /// A list of this many whole numbers between two limits.
    Wholes(usize, f64, f64),
    /// A number, or text with a percentage such as `"5%"`, between two limits.
    Amount(f64, f64),
    /// A list of three amounts.
    Amounts,
    /// One value of another type for all of this many directions, or one value for each direction.
    OneOrMore(&'static Self, usize),
    /// True or false.
    Flag,
    /// One of several keywords.
    Choice(&'static [&'static str]),
    /// A colour: `"#8a94a6"` or a CSS colour name.
    Color,
    /// A value of another type, or one of several keywords.
    Or(&'static Self, &'static [&'static str]),
    /// A file name, relative to the scene's folder.
    File,
    /// Text.
    Text,
    /// The name or the number of a named item.
    Name,
    /// A list of texts.
    Texts,
    /// A table of values.
    Table,
    /// Described in the help.
    Other,
}

impl ValueType {
    /// The same type with numbers from `least` to `most`. In a constant, a type without a range does not compile.
    ///
    /// # Panics
    ///
    /// If the type has no range.
    #[must_use]
    pub const fn within(self, least: f64, most: f64) -> Self {
        match self {
            Self::Number(..) => Self::Number(least, most),
            Self::Whole(..) => Self::Whole(least, most),
            Self::Numbers(count, ..) => Self::Numbers(count, least, most),
            Self::Wholes(count, ..) => Self::Wholes(count, least, most),
            Self::Amount(..) => Self::Amount(least, most),
            _ => panic!("the type has no range"),
        }
    }

    /// The least and the greatest allowed number, infinite if unlimited; `None` for types without numbers.
    pub const fn range(self) -> Option<(f64, f64)> {
        match self {
            Self::Number(least, most)
            | Self::Whole(least, most)
            | Self::Numbers(_, least, most)
            | Self::Wholes(_, least, most)
            | Self::Amount(least, most) => Some((least, most)),
            Self::Or(one, _) | Self::OneOrMore(one, _) => one.range(),
            _ => None,
        }
    }

    /// Returns true if the type is numeric or a flag, and can therefore be animated.
    pub const fn is_numeric(self) -> bool {
        match self {
            Self::Or(one, _) | Self::OneOrMore(one, _) => one.is_numeric(),
            Self::Choice(_)
            | Self::Color
            | Self::File
            | Self::Text
            | Self::Name
            | Self::Texts
            | Self::Table => false,
            _ => true,
        }
    }

    /// The type with the unit of its numbers: "number, degrees, or auto".
    pub fn with_unit(&self, unit: &str) -> String {
        match (self, unit) {
            (_, "") => self.to_string(),
            (Self::Or(one, words), _) => {
                format!("{}, or {}", one.with_unit(unit), words.join(" | "))
            }
            _ => format!("{self}, {unit}"),
        }
    }

    /// The type as a noun with its article and exact range: "a number from 0 to 1".
    pub fn noun(&self) -> String {
        match self {
            Self::Numbers(..) | Self::Wholes(..) | Self::Amounts => format!("a list of {self}"),
            Self::Number(least, _) | Self::Amount(least, _) if is_open(*least) => {
                format!("a {self}, at least {SMALLEST:.0e}")
            }
            Self::Whole(least, most) => format!("a whole number from {least} to {most}"),
            Self::Or(one, words) => {
                let words: Vec<String> = words.iter().map(|word| format!("{word:?}")).collect();
                format!("{}, or {}", one.noun(), words.join(", "))
            }
            Self::Number(least, most) if least.is_infinite() && most.is_infinite() => {
                "a finite number".to_owned()
            }
            _ => format!("a {self}"),
        }
    }
}

/// For example `number from 0 to 1`.
impl fmt::Display for ValueType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(least, most) => write!(f, "number{}", Range(*least, *most)),
            Self::Whole(least, most) => write!(f, "whole number{}", Range(*least, *most)),
            Self::Numbers(count, least, most) => {
                write!(f, "{count} numbers{}", Range(*least, *most))
            }
            Self::Wholes(count, least, most) => {
                write!(f, "{count} whole numbers{}", Range(*least, *most))
            }
            Self::Amount(least, most) => {
                write!(f, "number or percentage{}", Range(*least, *most))
            }
            Self::Amounts => f.write_str("3 numbers or percentages"),
            Self::OneOrMore(one, count) => write!(f, "{one}, or {count} of them"),
            Self::Flag => f.write_str("true or false"),
            Self::Choice(words) => write!(f, "{}", words.join(" | ")),
            Self::Color => f.write_str("#rrggbb or a name"),
            Self::Or(one, words) => write!(f, "{one}, or {}", words.join(" | ")),
            Self::File => f.write_str("file"),
            Self::Text => f.write_str("text"),
            Self::Name => f.write_str("name or number"),
            Self::Texts => f.write_str("list of texts"),
            Self::Table => f.write_str("table"),
            Self::Other => f.write_str("see there"),
        }
    }
}

/// Returns true if this minimum stands for "any number above 0".
fn is_open(least: f64) -> bool {
    least > 0.0 && least <= SMALLEST
}

/// The ends of a range, printed as words that follow the noun.
struct Range(f64, f64);

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(least, most) = self;
        let is_open = is_open(*least);
        // Limits that come only from a Rust type's range are not shown to users.
        let is_end = |end: f64| end.is_finite() && end.abs() < f64::from(i32::MAX);
        match (is_end(*least), is_end(*most)) {
            (true, true) if is_open => write!(f, " above 0, up to {most}"),
            (true, false) if is_open => f.write_str(" above 0"),
            (true, true) => write!(f, " from {least} to {most}"),
            (true, false) => write!(f, ", {least} or more"),
            (false, true) => write!(f, ", {most} or less"),
            (false, false) => Ok(()),
        }
    }
}
