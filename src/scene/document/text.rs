//! Values as TOML text, set where the rest of a text stays as it is written.

use toml_edit::{Array, DocumentMut, InlineTable, Item, Value as Toml};

use super::node::{Node, Value};

/// Sets a value: at a place of the tree of a text, or below it under `new` keys.
pub(super) fn set(
    text: &mut DocumentMut,
    (root, place): (&Node, &[usize]),
    new: &[&str],
    value: &Value,
) {
    let (mut item, mut node) = (text.as_item_mut(), root);
    for index in place {
        let child = match &node.value {
            Value::Table(entries) => (entries.get(*index))
                .and_then(|(name, child)| Some((item.get_mut(&**name)?, child))),
            Value::List(list) => {
                (list.get(*index)).and_then(|child| Some((item.get_mut(*index)?, child)))
            }
            _ => None,
        };
        let Some(child) = child else {
            return;
        };
        (item, node) = child;
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
