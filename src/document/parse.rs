//! TOML as a tree, with the line and the column of every value.

use std::cell::Cell;
use std::iter;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::node::{Node, Number, Origin, Value};
use crate::error::{Error, Result};

/// The tree of a text that a file holds; `path` is for errors.
pub(crate) fn parse(path: &Path, text: &str) -> Result<Node> {
    let lines = Lines::of(text);
    let root = DeTable::parse(text).map_err(|e| {
        let (line, column) = lines.place(e.span().map_or(0, |s| s.start));
        let help = "correct the TOML: `key = value`, texts in double quotes, tables in [brackets]";
        Error::file_line(path, line, e.message().trim_end(), help).at_column(column)
    })?;
    Ok(Node {
        value: lines.table(root.get_ref()),
        origin: Origin::Text { line: 1, column: 1 },
    })
}

/// A text and where its lines begin.
struct Lines<'a> {
    text: &'a str,
    begins: Vec<usize>,
    /// The byte of the last place, and which character of its line that is: the next one is mostly behind it.
    last: Cell<(usize, usize)>,
}

impl<'a> Lines<'a> {
    fn of(text: &'a str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let begins = iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        let last = Cell::default();
        Self { text, begins, last }
    }

    /// Line of a byte and character of that line, both from 1.
    fn place(&self, at: usize) -> (usize, usize) {
        let line = self.begins.partition_point(|begin| *begin <= at);
        let begin = self.begins[line - 1];
        let (from, counted) = match self.last.get() {
            (byte, counted) if (begin..=at).contains(&byte) => (byte, counted),
            _ => (begin, 0),
        };
        let before = self.text.get(from..at).unwrap_or_default();
        let counted = counted + before.chars().count();
        self.last.set((at, counted));
        (line, 1 + counted)
    }

    fn node(&self, at: usize, value: &DeValue<'_>) -> Node {
        let value = match value {
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Integer(i) => {
                let whole = i64::from_str_radix(i.as_str(), i.radix()).ok();
                let value = whole.map_or(f64::NAN, |w| w as f64);
                Value::Number(Number { value, whole })
            }
            DeValue::Float(f) => Value::Number(f.as_str().parse().unwrap_or(f64::NAN).into()),
            DeValue::String(text) => Value::Text(Arc::from(text.as_ref())),
            DeValue::Datetime(date) => Value::Date(date.to_string().into()),
            DeValue::Array(list) => {
                let nodes = list.iter().map(|v| self.node(v.span().start, v.get_ref()));
                Value::List(nodes.collect())
            }
            DeValue::Table(table) => self.table(table),
        };
        let (line, column) = self.place(at);
        Node {
            value,
            origin: Origin::Text { line, column },
        }
    }

    fn table(&self, table: &DeTable<'_>) -> Value {
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        let entry = |(key, value): (&Spanned<_>, &Spanned<DeValue<'_>>)| {
            let name: &std::borrow::Cow<'_, str> = key.get_ref();
            let node = self.node(key.span().start, value.get_ref());
            (Arc::from(name.as_ref()), node)
        };
        Value::Table(entries.into_iter().map(entry).collect())
    }
}
