//! Values as TOML text, set where the rest of a text stays as it is written.

use toml_edit::{Array, DocumentMut, InlineTable, Item, Value as Toml};

use super::node::{Node, Value};

/// A step of a way through a text.
pub(super) enum Key<'a> {
    /// Into a table.
    Name(&'a str),
    /// Into a list.
    Number(usize),
}

/// The way to a place as names and numbers.
pub(super) fn keys<'a>(root: &'a Node, place: &[usize]) -> Vec<Key<'a>> {
    let mut node = root;
    let mut keys = Vec::new();
    for index in place {
        let (key, child) = match &node.value {
            Value::Table(entries) => match entries.get(*index) {
                Some((name, child)) => (Key::Name(name), child),
                None => break,
            },
            Value::List(list) => match list.get(*index) {
                Some(child) => (Key::Number(*index), child),
                None => break,
            },
            _ => break,
        };
        keys.push(key);
        node = child;
    }
    keys
}

/// Sets a value: at a place, or below it under `new` keys.
pub(super) fn set(text: &mut DocumentMut, keys: &[Key<'_>], new: &[&str], value: &Value) {
    let mut item = text.as_item_mut();
    for key in keys {
        let child = match key {
            Key::Name(name) => item.get_mut(*name),
            Key::Number(index) => item.get_mut(*index),
        };
        let Some(child) = child else {
            return;
        };
        item = child;
    }
    let Some((last, tables)) = new.split_last() else {
        replace(item, value);
        return;
    };
    for table in tables {
        let Some(parent) = item.as_table_like_mut() else {
            return;
        };
        item = parent.entry(table).or_insert(toml_edit::table());
    }
    if let Some(parent) = item.as_table_like_mut() {
        parent.insert(last, Item::Value(toml(value)));
    }
}

/// Puts a value in the place of another; what stands around that in its line stays, and a table keeps its header.
fn replace(item: &mut Item, value: &Value) {
    let mut new = toml(value);
    if let Some(old) = item.as_value() {
        *new.decor_mut() = old.decor().clone();
    }
    let new = Item::Value(new);
    match item.as_table() {
        Some(old) => {
            let decor = old.decor().clone();
            // None but tables take the place of tables.
            if let Ok(mut table) = new.into_table() {
                *table.decor_mut() = decor;
                *item = Item::Table(table);
            }
        }
        None => *item = new,
    }
}

fn toml(value: &Value) -> Toml {
    match value {
        Value::Flag(flag) => Toml::from(*flag),
        Value::Number(number) => match number.whole {
            Some(whole) => Toml::from(whole),
            None => Toml::from(number.value),
        },
        Value::Text(text) => Toml::from(&**text),
        // No scene has one, and whoever reads this one says so.
        Value::Date(date) => date.parse().unwrap_or_else(|_| Toml::from(&**date)),
        Value::List(list) => Toml::Array(list.iter().map(|n| toml(&n.value)).collect::<Array>()),
        Value::Table(entries) => {
            let entries = entries
                .iter()
                .map(|(key, node)| (&**key, toml(&node.value)));
            Toml::InlineTable(entries.collect::<InlineTable>())
        }
    }
}
