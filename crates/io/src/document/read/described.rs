//! Tables whose values are declared by a struct: each is read by its type, within its range.

use cutaway::error::Result;
use cutaway::scene::describe::{Described, Field, Given, ValueType};
use cutaway::scene::{Amount, color_help, parse_color};

use super::reader::{Entry, Source, Table};
use crate::document::{Node, Number, Value, paths};

/// Keys of a table.
pub(super) fn keys_of(fields: &'static [Field]) -> Vec<&'static str> {
    let keys = |field: &'static Field| match field.key {
        "" => keys_of(field.below),
        key => vec![key],
    };
    fields.iter().flat_map(keys).collect()
}

/// Words of a field that takes one of some.
pub(super) fn choices(fields: &'static [Field], key: &str) -> &'static [&'static str] {
    match fields.iter().find(|f| f.key == key).map(|f| f.takes) {
        Some(ValueType::Choice(words)) => words,
        _ => &[],
    }
}

/// The description that a table is, where what the table lacks has its default.
pub(super) fn read<T: Described + Default>(table: &Table<'_>) -> Result<T> {
    let mut described = T::default();
    amend(&mut described, table)?;
    Ok(described)
}

/// Sets the values that a table has, and leaves the others as they are. Keys of the table itself are for its opener to check.
pub(super) fn amend(described: &mut dyn Described, table: &Table<'_>) -> Result<()> {
    for (index, field) in described.fields().iter().enumerate() {
        match (field.key, described.below_mut(index)) {
            ("", Some(beside)) => amend(beside, table)?,
            (key, Some(below)) => {
                if let Some(entry) = table.get(key) {
                    amend(below, &entry.table(&keys_of(field.below))?)?;
                }
            }
            (key, None) if !field.is_read_by_hand => {
                if let Some(entry) = table.get(key) {
                    described.set(index, entry.given(&field.takes, field.example)?);
                }
            }
            (_, None) => {}
        }
    }
    Ok(())
}

/// The value that words of a command line are for a path: lists are written with commas, sizes with an `x` as well.
///
/// # Errors
///
/// Words that the type does not take.
pub fn parse_value(path: &paths::Path, text: &str) -> Result<Value> {
    let text = text.trim();
    let number = |text: &str| match Value::read(text.trim()) {
        number @ Value::Number(_) => number,
        _ => text.into(),
    };
    let value = match path.takes {
        ValueType::Number(..) | ValueType::Whole(..) => number(text),
        ValueType::Numbers(..) => text.split(',').map(number).collect::<Vec<_>>().into(),
        ValueType::Wholes(..) => text
            .split([',', 'x'])
            .map(number)
            .collect::<Vec<_>>()
            .into(),
        ValueType::Or(one, words) if one.is_numeric() && !words.contains(&text) => number(text),
        _ => text.into(),
    };
    let node = Node::new(value);
    let source = Source {
        path: std::path::Path::new(""),
        moment: None,
    };
    Entry::root(source, &node).given(&path.takes, path.example)?;
    Ok(node.value)
}

/// Several numbers or amounts as one value.
fn joined(each: Vec<Given>) -> Given {
    let mut numbers = Vec::new();
    let mut amounts = Vec::new();
    for one in each {
        match one {
            Given::Number(number) => numbers.push(number),
            Given::Whole(whole) => numbers.push(whole as f64),
            Given::Amount(amount) => amounts.push(amount),
            _ => {}
        }
    }
    match amounts.is_empty() {
        true => Given::Numbers(numbers),
        false => Given::Amounts(amounts),
    }
}

impl Entry<'_> {
    /// The value as one of a type; `example` is one for errors.
    pub(super) fn given(&self, takes: &ValueType, example: &str) -> Result<Given> {
        let within = |numbers: &[f64], least: f64, most: f64| {
            if numbers.iter().all(|n| (least..=most).contains(n)) {
                return Ok(());
            }
            let help = format!("write for example `{} = {example}`", self.last_key());
            Err(self.fault(format_args!("it must be {}", takes.noun()), help))
        };
        Ok(match *takes {
            ValueType::Number(least, most) => {
                let number = self.number()?;
                within(&[number], least, most)?;
                Given::Number(number)
            }
            ValueType::Whole(least, most) => {
                let Value::Number(Number {
                    whole: Some(whole), ..
                }) = self.node.value
                else {
                    let what = format!("it must be {}", takes.noun());
                    return Err(self.fault(what, self.help_of_number(example)));
                };
                within(&[whole as f64], least, most)?;
                Given::Whole(whole)
            }
            ValueType::Numbers(count, least, most) => {
                let numbers = self.numbers_of(count)?;
                within(&numbers, least, most)?;
                Given::Numbers(numbers)
            }
            ValueType::Wholes(count, least, most) => {
                let numbers = self.numbers_of(count)?;
                let is_whole = numbers.iter().all(|n| n.fract() == 0.0);
                let numbers = if is_whole { numbers } else { vec![f64::NAN] };
                within(&numbers, least, most)?;
                Given::Numbers(numbers)
            }
            ValueType::Amount(least, most) => {
                let amount = self.amount()?;
                let (Amount::Units(number) | Amount::Percent(number)) = amount;
                within(&[number], least, most)?;
                Given::Amount(amount)
            }
            ValueType::Amounts => Given::Amounts(self.amounts::<3>()?.to_vec()),
            ValueType::OneOrMore(one, count) => {
                let each = match &self.node.value {
                    Value::List(list) if list.len() == count => self.list()?,
                    Value::List(_) => {
                        return Err(self.expected(&takes.noun(), example));
                    }
                    _ => vec![self.clone(); count],
                };
                let each = each.iter().map(|e| e.given(one, example));
                joined(each.collect::<Result<_>>()?)
            }
            ValueType::Flag => Given::Flag(self.flag()?),
            ValueType::Choice(words) => Given::Text(self.word(words)?.to_owned()),
            ValueType::Color => Given::Color(self.color()?),
            ValueType::Or(one, words) => match &self.node.value {
                Value::Text(word) if words.contains(&&**word) => Given::Text(word.to_string()),
                Value::Text(_) if one.is_numeric() => {
                    return self.word(words).map(|word| Given::Text(word.to_owned()));
                }
                _ => self.given(one, example)?,
            },
            ValueType::Name if matches!(self.node.value, Value::Number(_)) => {
                Given::Text(self.whole::<u32>()?.to_string())
            }
            ValueType::Texts => Given::Texts(self.texts()?),
            ValueType::Text
            | ValueType::Name
            | ValueType::File
            | ValueType::Table
            | ValueType::Other => Given::Text(self.text()?.to_owned()),
        })
    }

    /// One of some words.
    fn word(&self, words: &[&'static str]) -> Result<&'static str> {
        let choices: Vec<_> = words.iter().map(|word| (*word, *word)).collect();
        self.choice(&choices)
    }

    /// `#rrggbb`, `#rgb` or a name of CSS.
    pub(super) fn color(&self) -> Result<glam::Vec3> {
        let text = self.text()?;
        let help = || color_help(text);
        parse_color(text).ok_or_else(|| self.fault(format_args!("{text:?} is no colour"), help()))
    }
}
