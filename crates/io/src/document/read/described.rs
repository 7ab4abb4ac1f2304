//! Reads tables whose values are declared by a struct. Each value must have its declared type and be within its range.

use cutaway::error::{Error, Result, did_you_mean, nearest};
use cutaway::scene::describe::{Described, Field, Given, Leaf, ValueType};
use cutaway::scene::{Amount, color_help, parse_color};

use super::reader::{Entry, Source, Table};
use crate::document::spec::number_or_text;
use crate::document::{Node, Value, paths};

/// Returns the keys that these fields have in tables.
pub(super) fn keys_of(fields: &'static [Field]) -> Vec<&'static str> {
    let keys = |field: &'static Field| match field.key {
        "" => keys_of(field.below),
        key => vec![key],
    };
    fields.iter().flat_map(keys).collect()
}

/// Returns the words that a choice field accepts.
pub(super) fn choices(fields: &'static [Field], key: &str) -> &'static [&'static str] {
    match fields.iter().find(|f| f.key == key).map(|f| f.takes) {
        Some(ValueType::Choice(words)) => words,
        _ => &[],
    }
}

/// Reads a table as a description. Missing values get their defaults.
pub(super) fn read<T: Described + Default>(table: &Table<'_>) -> Result<T> {
    let mut described = T::default();
    amend(&mut described, table)?;
    Ok(described)
}

/// Sets the values that a table has, and leaves all other values unchanged. The keys are checked by the code that opens the table.
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
                if let Some(entry) = table.get(key)
                    && !described.set(index, entry.given(&field.takes, field.example)?)
                {
                    let help =
                        "please report this: the declaration and the type of the value differ";
                    return Err(entry.fault("internal error: the value was not accepted", help));
                }
            }
            (_, None) => {}
        }
    }
    Ok(())
}

/// Parses a command-line text into the value of a path that takes numbers, a text or a colour. Lists are separated by commas, and sizes may
/// be separated by `x`.
///
/// # Errors
///
/// Fails if the text is invalid for the type.
pub fn parse_value(path: &paths::Path, text: &str) -> Result<Value> {
    let text = text.trim();
    let value = match path.takes {
        ValueType::Number(..) | ValueType::Whole(..) => number_or_text(text),
        ValueType::Numbers(..) => text
            .split(',')
            .map(number_or_text)
            .collect::<Vec<_>>()
            .into(),
        ValueType::Wholes(..) => text
            .split([',', 'x'])
            .map(number_or_text)
            .collect::<Vec<_>>()
            .into(),
        ValueType::Or(one, words) if one.is_numeric() && !words.contains(&text) => {
            number_or_text(text)
        }
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

/// The numbers or amounts of a list. A single one is repeated `count` times.
fn repeated(given: Given, count: usize) -> Given {
    match given {
        Given::Numbers(one) if one.len() == 1 => Given::Numbers(vec![one[0]; count]),
        Given::Amounts(one) if one.len() == 1 => Given::Amounts(vec![one[0]; count]),
        all => all,
    }
}

/// Combines several numbers or amounts into one value.
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
    /// Reads the value as a type. Errors show `example`.
    pub(super) fn given(&self, takes: &ValueType, example: &str) -> Result<Given> {
        let other = || self.expected(&takes.noun(), example);
        let within = |number: f64, least: f64, most: f64| match (least..=most).contains(&number) {
            true => Ok(()),
            false => Err(other()),
        };
        let is_number = matches!(self.node.value, Value::Number(_));
        Ok(match *takes {
            ValueType::Number(least, most) if is_number => {
                let number = self.number()?;
                within(number, least, most)?;
                Given::Number(number)
            }
            ValueType::Whole(least, most) => {
                let whole = match self.node.value {
                    Value::Number(number) => number.as_whole(),
                    _ => None,
                };
                let whole = whole.ok_or_else(|| self.expected_whole(&takes.noun(), example))?;
                within(whole as f64, least, most)?;
                Given::Whole(whole)
            }
            ValueType::Numbers(count, least, most) => {
                self.each(&ValueType::Number(least, most), count, takes, example)?
            }
            ValueType::Wholes(count, least, most) => {
                self.each(&ValueType::Whole(least, most), count, takes, example)?
            }
            ValueType::Amount(least, most) => {
                let amount = self.amount()?;
                let (Amount::Units(number) | Amount::Percent(number)) = amount;
                within(number, least, most)?;
                Given::Amount(amount)
            }
            ValueType::Amounts => self.each(&Amount::TYPE, 3, takes, example)?,
            ValueType::OneOrMore(one, count) if self.is_list() => {
                let is_one = self.node.items().len() == 1;
                let given = self.each(one, if is_one { 1 } else { count }, takes, example)?;
                repeated(given, count)
            }
            ValueType::OneOrMore(one, count) => {
                repeated(joined(vec![self.given(one, example)?]), count)
            }
            ValueType::Flag => Given::Flag(self.flag()?),
            ValueType::Choice(words) => Given::Text(self.word(words)?.to_owned()),
            ValueType::Color => Given::Color(self.color()?),
            ValueType::Or(one, words) => match &self.node.value {
                Value::Text(word) if words.contains(&&**word) => Given::Text(word.to_string()),
                Value::Text(word)
                    if matches!(one, ValueType::Number(..) | ValueType::Numbers(..)) =>
                {
                    return Err(match nearest(word, words) {
                        Some(_) => {
                            let help = did_you_mean(word, words.iter().copied());
                            self.expected_but(&takes.noun(), help)
                        }
                        None => other(),
                    });
                }
                Value::Text(word) => self.given(one, example).map_err(|e| match e {
                    // The error of the innermost type already lists the valid words.
                    e if matches!(one, ValueType::Or(..)) => e,
                    _ => {
                        let help = format!(
                            "write {}, or a colour: {}",
                            words.join(", "),
                            color_help(word)
                        );
                        self.fault(format_args!("{word:?} is no colour"), help)
                    }
                })?,
                _ => self.given(one, example)?,
            },
            ValueType::Name if is_number => Given::Text(self.whole::<u32>()?.to_string()),
            ValueType::Texts => Given::Texts(self.texts()?),
            ValueType::Number(..) => return Err(other()),
            ValueType::Text
            | ValueType::Name
            | ValueType::File
            | ValueType::Table
            | ValueType::Other => Given::Text(self.text()?.to_owned()),
        })
    }

    /// Reads the elements of a list, all of the same type.
    fn each(
        &self,
        one: &ValueType,
        count: usize,
        takes: &ValueType,
        example: &str,
    ) -> Result<Given> {
        if !self.is_list() || self.node.items().len() != count {
            return Err(self.expected(&takes.noun(), example));
        }
        let each = self.list()?.into_iter().map(|e| e.given(one, example));
        Ok(joined(each.collect::<Result<_>>()?))
    }

    /// An error about a number that is not an integer. An animation key may be the cause.
    fn expected_whole(&self, noun: &str, example: &str) -> Error {
        match &self.node.value {
            Value::Number(number) if self.is_moved() && number.value.fract() != 0.0 => {
                let help = "use whole numbers in the [[key]], with `interpolation = \"step\"`";
                self.expected_but(noun, help)
            }
            _ => self.expected(noun, example),
        }
    }

    /// Reads one of some words.
    fn word(&self, words: &[&'static str]) -> Result<&'static str> {
        let choices: Vec<_> = words.iter().map(|word| (*word, *word)).collect();
        self.choice(&choices)
    }

    /// Reads `#rrggbb`, `#rgb` or a CSS colour name.
    pub(super) fn color(&self) -> Result<glam::Vec3> {
        let text = self.text()?;
        let help = || color_help(text);
        parse_color(text).ok_or_else(|| self.fault(format_args!("{text:?} is no colour"), help()))
    }
}
