//! Typed reading of TOML, with errors that name the file, the line and the key.
//!
//! Values are taken one by one, and a table states the keys it knows when it is opened: an unknown key is an error there
//! and then, with the nearest known one. Derived deserialisation would report neither the path of a key nor a mend.

use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

use super::keys::Moment;
use super::target::Shape;
use crate::error::{Error, Result, did_you_mean};
use crate::scene::document::{Node, Value, parse};
use crate::scene::range::{LARGEST, SMALLEST};
use crate::scene::section::Amount;

/// Where values come from, for errors.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    /// When it is, and what moves, if something does.
    pub(crate) moment: Option<Moment<'a>>,
}

/// A value, where it stands and what its key is.
#[derive(Clone)]
pub(crate) struct Entry<'a> {
    source: Source<'a>,
    /// Dotted path, as keys of animations write it.
    pub(crate) key: String,
    pub(crate) node: &'a Node,
}

/// A table whose keys are all known.
pub(crate) struct Table<'a> {
    /// The table as a value.
    pub(crate) entry: Entry<'a>,
    entries: &'a [(Arc<str>, Node)],
}

impl<'a> Entry<'a> {
    pub(crate) fn fault(&self, what: impl Display, mend: impl Into<String>) -> Error {
        // The file as a whole has no key.
        let what = match self.key.as_str() {
            "" => what.to_string(),
            key => format!("`{key}`: {what}"),
        };
        let what = match &self.source.moment {
            Some(moment) => format!("{}: {what}", moment.blame(&self.key)),
            None => what,
        };
        match self.node.line {
            0 => Error::file(self.source.path, what, mend),
            line => Error::file_line(self.source.path, line, what, mend),
        }
    }

    /// An error from elsewhere, placed at this value. Errors about other files already name their place.
    pub(crate) fn place(&self, error: Error) -> Error {
        match error {
            Error::Input {
                culprit,
                what,
                mend,
            } => self.fault(format_args!("{culprit}: {what}"), mend),
            other => other,
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

    fn expected(&self, expected: &str, example: &str) -> Error {
        let what = format!("it must be {expected}, but is {}", self.found());
        self.fault(
            what,
            format!("write for example `{} = {example}`", self.last_key()),
        )
    }

    fn last_key(&self) -> &str {
        let mut keys = self.key.rsplit('.');
        keys.find(|k| k.parse::<usize>().is_err())
            .unwrap_or(&self.key)
    }

    /// A finite number.
    pub(crate) fn number(&self) -> Result<f64> {
        let value = match &self.node.value {
            Value::Number(n) => Some(n.value),
            _ => None,
        };
        value.filter(|v: &f64| v.abs() <= LARGEST).ok_or_else(|| {
            let expected = format!("a finite number, {LARGEST:.0e} at most");
            self.expected(&expected, "1.5")
        })
    }

    /// A number above zero.
    pub(crate) fn positive(&self) -> Result<f64> {
        let value = self.number()?;
        if value >= SMALLEST {
            Ok(value)
        } else {
            let expected = format!("a number above 0, {SMALLEST:.0e} at least");
            Err(self.expected(&expected, "1.5"))
        }
    }

    /// A whole number that fits.
    pub(crate) fn whole<T: TryFrom<i64>>(&self) -> Result<T> {
        let value = match &self.node.value {
            Value::Number(n) => n.whole,
            _ => None,
        };
        value
            .and_then(|v| T::try_from(v).ok())
            .ok_or_else(|| self.expected("a whole number in range", "1"))
    }

    /// Text.
    pub(crate) fn text(&self) -> Result<&'a str> {
        match &self.node.value {
            Value::Text(s) => Ok(s),
            _ => Err(self.expected("text in quotes", "\"text\"")),
        }
    }

    /// `true` or `false`.
    pub(crate) fn flag(&self) -> Result<bool> {
        match &self.node.value {
            Value::Flag(b) => Ok(*b),
            _ => Err(self.expected("true or false", "true")),
        }
    }

    /// One of some words.
    pub(crate) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let word = self.text()?;
        choices
            .iter()
            .find(|(name, _)| *name == word)
            .map(|(_, value)| *value)
            .ok_or_else(|| {
                let mend = did_you_mean(word, choices.iter().map(|(name, _)| *name));
                self.fault(format_args!("{word:?} is no choice"), mend)
            })
    }

    /// The elements of a list.
    pub(crate) fn list(&self) -> Result<Vec<Self>> {
        let Value::List(list) = &self.node.value else {
            return Err(self.expected("a list", "[ ... ]"));
        };
        let element = |(i, node)| Self {
            source: self.source,
            key: format!("{}.{i}", self.key),
            node,
        };
        Ok(list.iter().enumerate().map(element).collect())
    }

    /// Text, or a number as text, as it is written.
    pub(crate) fn word(&self) -> Result<String> {
        match &self.node.value {
            Value::Number(n) => self.number().map(|_| n.to_string()),
            Value::Text(s) => Ok(s.to_string()),
            _ => Err(self.expected("text or a number", "\"1%\"")),
        }
    }

    /// A list of `N` finite numbers.
    pub(crate) fn vector<const N: usize>(&self) -> Result<[f64; N]> {
        let elements = match &self.node.value {
            Value::List(a) if a.len() == N => self.list()?,
            _ => {
                let example = format!("[{}]", ["1"; N].join(", "));
                return Err(self.expected(&format!("a list of {N} numbers"), &example));
            }
        };
        let mut vector = [0.0; N];
        for (slot, element) in vector.iter_mut().zip(&elements) {
            *slot = element.number()?;
        }
        Ok(vector)
    }

    /// A number, or a list of numbers.
    pub(crate) fn numbers(&self) -> Result<Vec<f64>> {
        match &self.node.value {
            Value::List(_) => self.list()?.iter().map(Self::number).collect(),
            _ => Ok(vec![self.number()?]),
        }
    }

    /// A number, or lists of numbers in lists: the numbers in their order, and how they are nested. A flag is 0 or 1.
    pub(super) fn nested(&self) -> Result<(Vec<f64>, Shape)> {
        if let Value::Flag(flag) = &self.node.value {
            return Ok((vec![f64::from(u8::from(*flag))], Shape::Flag));
        }
        if !self.is_list() {
            return Ok((vec![self.number()?], Shape::Number));
        }
        let elements: Vec<_> = self
            .list()?
            .iter()
            .map(Self::nested)
            .collect::<Result<_>>()?;
        let (numbers, shapes): (Vec<_>, Vec<_>) = elements.into_iter().unzip();
        Ok((numbers.concat(), Shape::List(shapes)))
    }

    /// A length, or text with a percentage.
    pub(crate) fn amount(&self) -> Result<Amount> {
        if self.is_text() {
            let mend = "write a number, or text such as \"6%\"";
            return Amount::parse(self.text()?).map_err(|what| self.fault(what, mend));
        }
        self.number().map(Amount::Units)
    }

    /// A list of `N` lengths or texts with percentages.
    pub(crate) fn amounts<const N: usize>(&self) -> Result<[Amount; N]> {
        let elements = match &self.node.value {
            Value::List(a) if a.len() == N => self.list()?,
            _ => {
                let example = format!("[{}]", ["\"50%\""; N].join(", "));
                let what = format!("a list of {N} numbers or percentages");
                return Err(self.expected(&what, &example));
            }
        };
        let mut amounts = [Amount::Units(0.0); N];
        for (slot, element) in amounts.iter_mut().zip(&elements) {
            *slot = element.amount()?;
        }
        Ok(amounts)
    }

    /// Texts of a list.
    pub(crate) fn texts(&self) -> Result<Vec<String>> {
        match &self.node.value {
            Value::List(_) => self
                .list()?
                .iter()
                .map(|e| e.text().map(str::to_owned))
                .collect(),
            _ => Err(self.expected("a list of texts", "[\"*\"]")),
        }
    }

    /// Whether the value is text: some keys take a number or text with a unit.
    pub(crate) fn is_text(&self) -> bool {
        matches!(self.node.value, Value::Text(_))
    }

    /// Whether the value is a table.
    pub(crate) fn is_table(&self) -> bool {
        matches!(self.node.value, Value::Table(_))
    }

    /// Whether the value is a list.
    pub(crate) fn is_list(&self) -> bool {
        matches!(self.node.value, Value::List(_))
    }

    /// The table, if all its keys are among `known`.
    pub(crate) fn table(&self, known: &[&str]) -> Result<Table<'a>> {
        let table = self.open_table()?;
        for (key, node) in table.entries {
            if !known.contains(&&**key) {
                let mend = did_you_mean(key, known.iter().copied());
                let stray = self.child(key, node);
                return Err(stray.fault("there is no such key here", mend));
            }
        }
        Ok(table)
    }

    /// The table, whose keys are names of the user.
    pub(crate) fn open_table(&self) -> Result<Table<'a>> {
        match &self.node.value {
            Value::Table(entries) => Ok(Table {
                entry: self.clone(),
                entries,
            }),
            _ => Err(self.expected("a table", "{ key = value }")),
        }
    }

    /// The same value under the name it gives itself, so that errors and animation keys speak of `cut.front`, not `cut.0`.
    pub(crate) fn named(mut self) -> Self {
        if let Some(name) = self.node.name()
            && let Some((list, _)) = self.key.rsplit_once('.')
        {
            self.key = format!("{list}.{name}");
        }
        self
    }

    fn child(&self, key: &str, node: &'a Node) -> Self {
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

/// Reads the text of a file of TOML whose keys are among `known`.
pub(crate) fn with_table<T>(
    path: &Path,
    text: &str,
    known: &[&str],
    read: impl FnOnce(&Table<'_>) -> Result<T>,
) -> Result<T> {
    let root = parse(path, text)?;
    let source = Source { path, moment: None };
    read(&Table::of_file(source, &root, known)?)
}

impl<'a> Table<'a> {
    /// The whole file.
    pub(crate) fn of_file(source: Source<'a>, root: &'a Node, known: &[&str]) -> Result<Self> {
        let entry = Entry {
            source,
            key: String::new(),
            node: root,
        };
        entry.table(known)
    }

    /// The value of a key, if it is there.
    pub(crate) fn get(&self, key: &str) -> Option<Entry<'a>> {
        let (key, node) = self.entries.iter().find(|(name, _)| **name == *key)?;
        Some(self.entry.child(key, node))
    }

    /// The value of a key that has to be there.
    pub(crate) fn need(&self, key: &str, example: &str) -> Result<Entry<'a>> {
        self.get(key).ok_or_else(|| {
            let mend = format!("add for example `{key} = {example}`");
            self.entry.fault(format_args!("it has no `{key}`"), mend)
        })
    }

    /// All values with their keys, by name.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&'a str, Entry<'a>)> {
        let mut all: Vec<_> = self.entries.iter().collect();
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        let entry = self.entry.clone();
        all.into_iter()
            .map(move |(key, node)| (&**key, entry.child(key, node)))
    }

    /// The tables of a list `[[key]]`; none if the key is missing.
    pub(crate) fn tables(&self, key: &str) -> Result<Vec<Entry<'a>>> {
        match self.get(key) {
            Some(entry) => Ok(entry.list()?.into_iter().map(Entry::named).collect()),
            None => Ok(Vec::new()),
        }
    }
}
