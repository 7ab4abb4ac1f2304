//! Parses TOML to a tree, with the line and the column of every value.

use std::cell::Cell;
use std::iter;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use cutaway::error::{Error, Result};
use toml_edit::{Item, TableLike, Value as Toml};

use super::node::{Node, Number, Origin, Value};

/// Parses a text to a tree. Errors name `path`.
pub(crate) fn parse(path: &Path, text: &str) -> Result<Node> {
    let lines = LineIndex::of(text);
    let root = toml_edit::Document::parse(text).map_err(|e| {
        let (line, column) = lines.place(e.span().map_or(0, |s| s.start));
        let help = "correct the TOML: `key = value`, texts in double quotes, tables in [brackets], numbers of 64 bits";
        Error::file_line(path, line, e.message().trim_end(), help).at_column(column)
    })?;
    Ok(Node {
        value: lines.table(root.as_table()),
        origin: Origin::Text { line: 1, column: 1 },
    })
}

/// A text and the start of each of its lines.
struct LineIndex<'a> {
    text: &'a str,
    begins: Vec<usize>,
    /// Byte and character number of the last lookup within its line. The next lookup usually lies a little further on.
    last: Cell<(usize, usize)>,
}

impl<'a> LineIndex<'a> {
    fn of(text: &'a str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let begins = iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        let last = Cell::default();
        Self { text, begins, last }
    }

    /// Returns the line of a byte, and the number of the character in that line, both from 1.
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

    fn node(&self, at: usize, value: Value) -> Node {
        let (line, column) = self.place(at);
        Node {
            value,
            origin: Origin::Text { line, column },
        }
    }

    fn table(&self, table: &dyn TableLike) -> Value {
        let entries = (table.iter()).filter_map(|(name, _)| table.get_key_value(name));
        let entries = entries.map(|(key, item)| (begin(key.span()), key.get(), item));
        let mut entries: Vec<_> = entries.collect();
        entries.sort_by_key(|(at, ..)| *at);
        let entry = |(at, name, item)| (Arc::from(name), self.node(at, self.item(item)));
        Value::Table(entries.into_iter().map(entry).collect())
    }

    fn item(&self, item: &Item) -> Value {
        match item {
            // This only occurs in items that were removed from a document, and the parser removes none.
            Item::None => Value::List(Vec::new()),
            Item::Value(value) => self.value(value),
            Item::Table(table) => self.table(table),
            Item::ArrayOfTables(tables) => {
                let nodes = (tables.iter()).map(|t| self.node(begin(t.span()), self.table(t)));
                Value::List(nodes.collect())
            }
        }
    }

    fn value(&self, value: &Toml) -> Value {
        match value {
            Toml::Boolean(flag) => Value::Flag(*flag.value()),
            Toml::Integer(i) => {
                let whole = *i.value();
                Value::Number(Number {
                    value: whole as f64,
                    whole: Some(whole),
                })
            }
            Toml::Float(f) => Value::Number((*f.value()).into()),
            Toml::String(text) => Value::Text(Arc::from(text.value().as_str())),
            Toml::Datetime(date) => Value::Date(date.value().to_string().into()),
            Toml::Array(list) => {
                let nodes = (list.iter()).map(|v| self.node(begin(v.span()), self.value(v)));
                Value::List(nodes.collect())
            }
            Toml::InlineTable(table) => self.table(table),
        }
    }
}

/// Returns the start of a parsed item, whose span is present.
fn begin(span: Option<Range<usize>>) -> usize {
    span.map_or(0, |span| span.start)
}
