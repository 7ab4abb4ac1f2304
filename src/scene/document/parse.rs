//! TOML as a tree, with the line of every value.

use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::node::{Node, Number, Value};
use crate::error::{Error, Result};

/// The tree of a text that a file holds; `path` is for errors.
pub(crate) fn parse(path: &Path, text: &str) -> Result<Node> {
    let lines = Lines::of(text);
    let root = DeTable::parse(text).map_err(|e| {
        let line = lines.line(e.span().map_or(0, |s| s.start));
        let mend = "correct the TOML: `key = value`, texts in double quotes, tables in [brackets]";
        Error::file_line(path, line, e.message().trim_end(), mend)
    })?;
    Ok(Node {
        value: lines.table(root.get_ref()),
        line: 1,
    })
}

/// Where lines begin.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        Self(ends.map(|(at, _)| at + 1).collect())
    }

    /// Line of a byte, from 1.
    fn line(&self, at: usize) -> usize {
        1 + self.0.partition_point(|begin| *begin <= at)
    }

    fn node(&self, at: usize, value: &DeValue<'_>) -> Node {
        let value = match value {
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Integer(i) => {
                let whole = i64::from_str_radix(i.as_str(), i.radix()).ok();
                let value = whole.map_or(f64::NAN, |w| w as f64);
                let text = match (i.radix(), whole) {
                    (10, _) | (_, None) => i.as_str().replace('_', ""),
                    (_, Some(whole)) => whole.to_string(),
                };
                Value::Number(Number::written(value, whole, &text))
            }
            DeValue::Float(f) => {
                let value = f.as_str().parse().unwrap_or(f64::NAN);
                Value::Number(Number::written(value, None, &f.as_str().replace('_', "")))
            }
            DeValue::String(text) => Value::Text(Arc::from(text.as_ref())),
            DeValue::Datetime(date) => Value::Date(date.to_string().into()),
            DeValue::Array(list) => {
                let nodes = list.iter().map(|v| self.node(v.span().start, v.get_ref()));
                Value::List(nodes.collect())
            }
            DeValue::Table(table) => self.table(table),
        };
        Node {
            value,
            line: self.line(at),
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
