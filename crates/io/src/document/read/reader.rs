//! Typed reading of TOML, with errors that name the file, the line, the column and the key.
//!
//! Values are read one by one. Opening a table takes its list of known keys. An unknown key is an error at that point, which suggests the
//! nearest known key. Derived deserialisation would report neither the path of a key nor a remedy.

use std::fmt::Display;
use std::path::Path;

use cutaway::error::{Error, Result, did_you_mean};
use cutaway::scene::Amount;
use cutaway::scene::range::LARGEST;

use super::keys::KeyedTime;
use super::target::Nesting;
use crate::document::{Node, Origin, Value};

pub use super::table::{Table, with_table};

/// Source of values, which errors refer to.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    /// Time of an animated scene and its animation keys.
    pub(crate) moment: Option<KeyedTime<'a>>,
}

/// A value with its position and its key.
#[derive(Clone)]
pub struct Entry<'a> {
    source: Source<'a>,
    /// Dotted path of the value, in the notation of animation keys.
    pub(crate) key: String,
    /// The value itself.
    pub node: &'a Node,
}

impl<'a> Entry<'a> {
    /// An error at this value. `what` is the fault, and `help` is the remedy.
    pub fn fault(&self, what: impl Display, help: impl Into<String>) -> Error {
        let what = match (&self.node.origin, self.key.as_str()) {
            // If the root is a list, its elements have only numbers as keys.
            (_, key) if key.parse::<usize>().is_ok() => what.to_string(),
            // The root has no key, and the words of the option already identify it.
            (_, "") => what.to_string(),
            (Origin::Option(words), _) if self.is_table() || !words.contains('`') => {
                what.to_string()
            }
            (Origin::Option(words), _) if words.starts_with(self.last_key()) => what.to_string(),
            (Origin::Option(_), _) => format!("{}: {what}", self.last_key()),
            (_, key) => format!("`{key}`: {what}"),
        };
        let what = match &self.source.moment {
            Some(moment) => format!("{}: {what}", moment.blame(&self.key)),
            None => what,
        };
        match &self.node.origin {
            Origin::Text { line, column } => {
                Error::file_line(self.source.path, *line, what, help).at_column(*column)
            }
            Origin::Elsewhere { file, line, column } => {
                Error::file_line(file, *line, what, help).at_column(*column)
            }
            Origin::Option(words) => Error::input(words.to_string(), what, help),
            Origin::Program if self.source.path.as_os_str().is_empty() => {
                Error::input("the scene", what, help)
            }
            Origin::Program => Error::file(self.source.path, what, help),
        }
    }

    /// Adds this value's position to an error from elsewhere. Errors about other files keep their own position.
    pub fn place(&self, error: Error) -> Error {
        match (error, &self.node.origin) {
            (Error::Missing(error), _) => self.place(*error).missing(),
            // Options are excluded, because the error already quotes their words.
            (
                Error::Input {
                    culprit,
                    what,
                    help,
                },
                Origin::Text { .. } | Origin::Elsewhere { .. } | Origin::Program,
            ) => self.fault(format_args!("{culprit}: {what}"), help),
            (other, _) => other,
        }
    }

    fn found(&self) -> String {
        match &self.node.value {
            Value::Text(s) => format!("the text {s:?}"),
            Value::Number(n) => format!("the number {n}"),
            Value::Flag(b) => format!("{b}"),
            Value::Date(d) => format!("the date {d}"),
            Value::List(a) => format!("a list of {}", a.len()),
            Value::Table(_) => "a table".into(),
        }
    }

    pub(super) fn expected(&self, expected: &str, example: &str) -> Error {
        let help = match self.last_key() {
            "" => format!("write for example {example}"),
            key => format!("write for example `{key} = {example}`"),
        };
        self.expected_but(expected, help)
    }

    /// Like `expected`, but with the given help.
    pub(super) fn expected_but(&self, expected: &str, help: impl Into<String>) -> Error {
        self.fault(
            format_args!("it must be {expected}, but is {}", self.found()),
            help,
        )
    }

    fn last_key(&self) -> &str {
        let mut keys = self.key.rsplit('.');
        keys.find(|k| k.parse::<usize>().is_err())
            .unwrap_or(&self.key)
    }

    /// Reads a finite number.
    pub fn number(&self) -> Result<f64> {
        let value = match &self.node.value {
            Value::Number(n) => Some(n.value),
            _ => None,
        };
        value.filter(|v: &f64| v.abs() <= LARGEST).ok_or_else(|| {
            let expected = format!("a finite number, {LARGEST:.0e} at most");
            self.expected(&expected, "1.5")
        })
    }

    /// Reads an integer within the range of its type.
    pub fn whole<T: TryFrom<i64>>(&self) -> Result<T> {
        let value = match &self.node.value {
            Value::Number(n) => n.whole,
            _ => None,
        };
        value
            .and_then(|v| T::try_from(v).ok())
            .ok_or_else(|| self.expected("a whole number in range", "1"))
    }

    /// Replaces the node, but keeps the key and the source.
    pub fn of(&self, node: &'a Node) -> Self {
        Self {
            node,
            ..self.clone()
        }
    }

    /// Returns true if the document is animated.
    pub(super) fn is_moved(&self) -> bool {
        self.source.moment.is_some()
    }

    /// Reads a text.
    pub fn text(&self) -> Result<&'a str> {
        match &self.node.value {
            Value::Text(s) => Ok(s),
            _ => Err(self.expected("text in quotes", "\"text\"")),
        }
    }

    /// Reads `true` or `false`.
    pub fn flag(&self) -> Result<bool> {
        match &self.node.value {
            Value::Flag(b) => Ok(*b),
            _ => Err(self.expected("true or false", "true")),
        }
    }

    /// Reads one of some words.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let word = self.text()?;
        choices
            .iter()
            .find(|(name, _)| *name == word)
            .map(|(_, value)| *value)
            .ok_or_else(|| {
                let help = did_you_mean(word, choices.iter().map(|(name, _)| *name));
                self.fault(format_args!("{word:?} is not a valid choice"), help)
            })
    }

    /// Reads the elements of a list.
    pub fn list(&self) -> Result<Vec<Self>> {
        let Value::List(list) = &self.node.value else {
            return Err(self.expected("a list", "[ ... ]"));
        };
        let element = |(i, node): (usize, &'a Node)| Self {
            source: self.source,
            key: self.below(&i.to_string()),
            node,
        };
        Ok(list.iter().enumerate().map(element).collect())
    }

    /// Reads a list of `N` finite numbers.
    pub(crate) fn vector<const N: usize>(&self) -> Result<[f64; N]> {
        let numbers: Vec<f64> = match &self.node.value {
            Value::List(list) if list.len() == N => self
                .list()?
                .iter()
                .map(Self::number)
                .collect::<Result<_>>()?,
            _ => Vec::new(),
        };
        numbers.try_into().map_err(|_| {
            let example = format!("[{}]", ["1"; N].join(", "));
            self.expected(&format!("a list of {N} numbers"), &example)
        })
    }

    /// Reads a number, or a list of numbers.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>> {
        match &self.node.value {
            Value::List(_) => self.list()?.iter().map(Self::number).collect(),
            _ => Ok(vec![self.number()?]),
        }
    }

    /// Reads a number or nested lists of numbers. Returns the numbers in order, and their nesting. A flag is read as 0 or 1.
    pub(super) fn nested(&self) -> Result<(Vec<f64>, Nesting)> {
        if let Value::Flag(flag) = &self.node.value {
            return Ok((vec![f64::from(u8::from(*flag))], Nesting::Flag));
        }
        if !self.is_list() {
            return Ok((vec![self.number()?], Nesting::Number));
        }
        let elements: Vec<_> = self
            .list()?
            .iter()
            .map(Self::nested)
            .collect::<Result<_>>()?;
        let (numbers, shapes): (Vec<_>, Vec<_>) = elements.into_iter().unzip();
        Ok((numbers.concat(), Nesting::List(shapes)))
    }

    /// Reads a length, or text with a percentage.
    pub(crate) fn amount(&self) -> Result<Amount> {
        if self.is_text() {
            let help = "write a number, or text such as \"6%\"";
            return Amount::parse(self.text()?).map_err(|what| self.fault(what, help));
        }
        self.number().map(Amount::Units)
    }

    /// Reads a list of texts.
    pub fn texts(&self) -> Result<Vec<String>> {
        match &self.node.value {
            Value::List(_) => self
                .list()?
                .iter()
                .map(|e| e.text().map(str::to_owned))
                .collect(),
            _ => Err(self.expected("a list of texts", "[\"*\"]")),
        }
    }

    /// Returns true if the value is text. Some keys take either a number or text with a unit.
    pub fn is_text(&self) -> bool {
        matches!(self.node.value, Value::Text(_))
    }

    /// Returns true if the value is a table.
    pub fn is_table(&self) -> bool {
        matches!(self.node.value, Value::Table(_))
    }

    /// Returns true if the value is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.node.value, Value::List(_))
    }

    /// Reads the table, whose keys must be among `known`.
    pub fn table(&self, known: &[&str]) -> Result<Table<'a>> {
        let table = self.open_table()?;
        for (key, node) in table.entries {
            if !known.contains(&&**key) {
                let help = did_you_mean(key, known.iter().copied());
                let stray = self.child(key, node);
                return Err(stray.fault("there is no such key in this table", help));
            }
        }
        Ok(table)
    }

    /// Reads the table, whose keys are names chosen by the user.
    pub fn open_table(&self) -> Result<Table<'a>> {
        match &self.node.value {
            Value::Table(entries) => Ok(Table {
                entry: self.clone(),
                entries,
            }),
            _ => Err(self.expected("a table", "{ key = value }")),
        }
    }

    /// The same value with its `name` in the path, so that errors and animation keys use `cut.front` instead of `cut.0`.
    pub(crate) fn named(mut self) -> Self {
        if let Some(name) = self.node.name()
            && let Some((list, _)) = self.key.rsplit_once('.')
        {
            self.key = format!("{list}.{name}");
        }
        self
    }

    /// Another value from the same source, with this key.
    pub(super) fn at(&self, key: &str, node: &'a Node) -> Self {
        self.child(key, node)
    }

    /// The root of a file.
    pub(super) fn root(source: Source<'a>, node: &'a Node) -> Self {
        let key = String::new();
        Self { source, key, node }
    }

    pub(super) fn child(&self, key: &str, node: &'a Node) -> Self {
        Self {
            source: self.source,
            key: self.below(key),
            node,
        }
    }

    fn below(&self, key: &str) -> String {
        if self.key.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.key)
        }
    }
}
