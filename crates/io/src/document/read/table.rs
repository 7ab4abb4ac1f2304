//! Tables of a document, accessed by key.

use std::path::Path;
use std::sync::Arc;

use cutaway::error::Result;

use super::reader::{Entry, Source};
use crate::document::node::Node;
use crate::document::parse;

/// A table whose keys are all known.
pub struct Table<'a> {
    /// The table as a value.
    pub entry: Entry<'a>,
    pub(super) entries: &'a [(Arc<str>, Node)],
}

/// Reads the text of a TOML file. Its keys must be among `known`.
pub fn with_table<T>(
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
    /// The root table of a file.
    pub(crate) fn of_file(source: Source<'a>, root: &'a Node, known: &[&str]) -> Result<Self> {
        Entry::root(source, root).table(known)
    }

    /// The value of a key, if it exists.
    pub fn get(&self, key: &str) -> Option<Entry<'a>> {
        let (key, node) = self.entries.iter().find(|(name, _)| **name == *key)?;
        Some(self.entry.child(key, node))
    }

    /// The value of a required key.
    pub fn need(&self, key: &str, example: &str) -> Result<Entry<'a>> {
        self.get(key).ok_or_else(|| {
            let help = format!("add for example `{key} = {example}`");
            self.entry.fault(format_args!("it has no `{key}`"), help)
        })
    }

    /// All values with their keys, in key order.
    pub fn all(&self) -> impl Iterator<Item = (&'a str, Entry<'a>)> {
        let mut all: Vec<_> = self.entries.iter().collect();
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        let entry = self.entry.clone();
        all.into_iter()
            .map(move |(key, node)| (&**key, entry.child(key, node)))
    }

    /// The tables of a list `[[key]]`, or none if the key is missing.
    pub fn tables(&self, key: &str) -> Result<Vec<Entry<'a>>> {
        match self.get(key) {
            Some(entry) => Ok(entry.list()?.into_iter().map(Entry::named).collect()),
            None => Ok(Vec::new()),
        }
    }
}
