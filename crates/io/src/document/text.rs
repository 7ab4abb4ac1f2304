//! Writes values into TOML text. The rest of the text is left unchanged.

use std::fmt;

use toml_edit::{
    Array, ArrayOfTables, DocumentMut, InlineTable, Item, RawString, Table, Value as Toml,
};

use super::node::{Node, Value};

/// Sets the value at a place in a text's tree or, if there are `new` keys, below that place under these keys.
pub(super) fn set(
    text: &mut DocumentMut,
    (root, place): (&Node, &[usize]),
    new: &[&str],
    value: &Value,
) {
    let Some(item) = find(text, root, place) else {
        return;
    };
    let Some((last, tables)) = new.split_last() else {
        replace(item, value);
        return;
    };
    let mut item = item;
    for key in tables {
        let Some(parent) = item.as_table_like_mut() else {
            return;
        };
        item = parent.entry(key).or_insert_with(|| {
            let mut between = Table::new();
            // The table gets no header as long as it holds only tables.
            between.set_implicit(true);
            Item::Table(between)
        });
    }
    // An item next to tables with headers gets a header too.
    let is_block = item.as_table().is_some();
    if let Some(parent) = item.as_table_like_mut() {
        let item = match value {
            Value::Table(entries) if is_block => Item::Table(block(entries)),
            Value::List(list) if is_block && place.is_empty() && tables.is_empty() => blocks(list),
            value => Item::Value(toml(value)),
        };
        parent.insert(last, item);
    }
}

/// Appends a value to the list at a place.
pub(super) fn push(text: &mut DocumentMut, (root, place): (&Node, &[usize]), value: &Value) {
    match (find(text, root, place), value) {
        (Some(Item::ArrayOfTables(tables)), Value::Table(entries)) => tables.push(block(entries)),
        (Some(Item::Value(Toml::Array(array))), value) => append(array, toml(value)),
        _ => {}
    }
}

/// Appends a value to a list. It gets its own line if each existing value has one. A comment after the last value stays with that value.
fn append(array: &mut Array, mut value: Toml) {
    let text = |raw: Option<&RawString>| raw.and_then(RawString::as_str).unwrap_or("").to_owned();
    let before = array
        .iter()
        .next()
        .map(|first| text(first.decor().prefix()));
    let Some((_, indent)) = before.as_deref().and_then(|b| b.rsplit_once('\n')) else {
        array.push(value);
        return;
    };
    // The comment of the last value follows its comma or, without a comma, the value itself.
    let last = array.len() - 1;
    let mut behind = text(Some(array.trailing()));
    if let Some(last) = array.get_mut(last) {
        behind = text(last.decor().suffix()) + &behind;
        last.decor_mut().set_suffix("");
    }
    value
        .decor_mut()
        .set_prefix(format!("{}\n{indent}", behind.trim_end()));
    array.push_formatted(value);
    array.set_trailing_comma(true);
    array.set_trailing("\n");
}

/// Removes a child from a table or list.
pub(super) fn remove(text: &mut DocumentMut, (root, parent): (&Node, &[usize]), child: usize) {
    let mut node = root;
    for index in parent {
        let Some(below) = node.child(*index) else {
            return;
        };
        node = below;
    }
    let Some(item) = find(text, root, parent) else {
        return;
    };
    match (&node.value, item) {
        (Value::Table(entries), item) => {
            let key = entries.get(child).map(|(key, _)| key);
            if let (Some(key), Some(table)) = (key, item.as_table_like_mut()) {
                table.remove(key);
            }
        }
        (_, Item::ArrayOfTables(tables)) => {
            tables.remove(child);
        }
        (_, Item::Value(Toml::Array(array))) => {
            array.remove(child);
        }
        _ => {}
    }
}

/// The item at a place in the tree of a text.
fn find<'a>(text: &'a mut DocumentMut, root: &Node, place: &[usize]) -> Option<&'a mut Item> {
    let (mut item, mut node) = (text.as_item_mut(), root);
    for index in place {
        item = match &node.value {
            Value::Table(entries) => item.get_mut(&*entries.get(*index)?.0)?,
            _ => item.get_mut(*index)?,
        };
        node = node.child(*index)?;
    }
    Some(item)
}

/// Replaces a value. Other text on the same line is kept, and a table keeps its header.
fn replace(item: &mut Item, value: &Value) {
    let mut new = toml(value);
    if let Some(old) = item.as_value() {
        *new.decor_mut() = old.decor().clone();
    }
    if let (Some(old), Value::List(list)) = (item.as_array_of_tables(), value)
        && let Item::ArrayOfTables(mut tables) = blocks(list)
        && let Some(first) = old.get(0)
    {
        // Text above the first table belongs to the file, not to the table.
        for table in tables.iter_mut() {
            table.set_position(first.position());
        }
        if let Some(table) = tables.get_mut(0) {
            *table.decor_mut() = first.decor().clone();
        }
        *item = Item::ArrayOfTables(tables);
        return;
    }
    let new = Item::Value(new);
    match item.as_table() {
        Some(old) => {
            let decor = old.decor().clone();
            // Tables are only replaced by tables.
            if let Ok(mut table) = new.into_table() {
                *table.decor_mut() = decor;
                *item = Item::Table(table);
            }
        }
        None => *item = new,
    }
}

/// A table with its own header.
fn block(entries: &[(std::sync::Arc<str>, Node)]) -> Table {
    let mut table = Table::new();
    for (key, node) in entries {
        table.insert(key, Item::Value(toml(&node.value)));
    }
    table
}

/// Formats a list. If all entries are tables, each gets a header.
fn blocks(list: &[Node]) -> Item {
    let tables = list.iter().map(|node| match &node.value {
        Value::Table(entries) => Some(block(entries)),
        _ => None,
    });
    match tables.collect::<Option<ArrayOfTables>>() {
        Some(tables) if !tables.is_empty() => Item::ArrayOfTables(tables),
        _ => Item::Value(toml(&Value::List(list.to_vec()))),
    }
}

/// Formats the value as TOML in a single line.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut value = toml(self);
        in_one_line(&mut value);
        write!(f, "{value}")
    }
}

/// Removes the line breaks between the entries of lists.
fn in_one_line(value: &mut Toml) {
    match value {
        Toml::Array(array) => {
            array.iter_mut().for_each(in_one_line);
            array.fmt();
        }
        Toml::InlineTable(table) => {
            table.iter_mut().for_each(|(_, value)| in_one_line(value));
            table.fmt();
        }
        _ => {}
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
        // Dates are not valid in a scene; the reader reports them.
        Value::Date(date) => date.parse().unwrap_or_else(|_| Toml::from(&**date)),
        Value::List(list) => Toml::Array(array(list)),
        Value::Table(entries) => {
            let entries = entries
                .iter()
                .map(|(key, node)| (&**key, toml(&node.value)));
            Toml::InlineTable(entries.collect::<InlineTable>())
        }
    }
}

/// Formats a list. If it holds several tables, each is written on its own line.
fn array(list: &[Node]) -> Array {
    let mut array: Array = list.iter().map(|n| toml(&n.value)).collect();
    let is_table = |node: &Node| matches!(node.value, Value::Table(_));
    if list.len() > 1 && list.iter().all(is_table) {
        for value in array.iter_mut() {
            value.decor_mut().set_prefix("\n  ");
        }
        array.set_trailing_comma(true);
        array.set_trailing("\n");
    }
    array
}
