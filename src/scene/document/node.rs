//! The tree of a scene: values, and the lines of the file that they stand in.
//!
//! A tree is made by [`parse`](super::parse) or by hand, and changed at places: the way to a value, as numbers of children. A place
//! stays right as long as nothing is added before it.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// A value and where it stands. Nodes are equal that hold the same, in whichever line.
#[derive(Clone, Debug)]
pub struct Node {
    /// What it is.
    pub value: Value,
    /// Line of the file, from 1; 0 of what no file says.
    pub line: usize,
}

/// What a key of a scene holds. Tables are equal in whichever order.
#[derive(Clone, Debug)]
pub enum Value {
    /// True or false.
    Flag(bool),
    /// A number.
    Number(Number),
    /// Text, without its quotes.
    Text(Arc<str>),
    /// A date, which no key of a scene takes.
    Date(Arc<str>),
    /// A list.
    List(Vec<Node>),
    /// Values by key, in the order of the file.
    Table(Vec<(Arc<str>, Node)>),
}

/// A number, and how a file writes it.
#[derive(Clone, Debug)]
pub struct Number {
    /// Its value; not a number where the text is out of range.
    pub value: f64,
    /// The same without a point, if it is written so.
    pub whole: Option<i64>,
    /// As it is written.
    written: Option<Arc<str>>,
}

impl Value {
    /// The value that a text means: a number, a flag, a list or a table in TOML, or else the text itself.
    pub fn read(text: &str) -> Self {
        let alone = |root: Node| match root.value {
            Self::Table(entries) => <[_; 1]>::try_from(entries).ok(),
            _ => None,
        };
        let read = super::parse(Path::new("value"), &format!("value = {text}")).ok();
        match read.and_then(alone) {
            Some([(_, node)]) => node.unplaced().value,
            None => Self::Text(text.into()),
        }
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number.into())
    }
}

impl From<i64> for Value {
    fn from(number: i64) -> Self {
        Self::Number(number.into())
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl<T: Into<Self>> From<Vec<T>> for Value {
    fn from(list: Vec<T>) -> Self {
        Self::List(list.into_iter().map(|v| Node::new(v.into())).collect())
    }
}

/// Where a value is: the child of the root to follow, the child of that, and so on.
pub(crate) type Place = Vec<usize>;

impl Number {
    /// A number as a file writes it.
    pub(super) fn written(value: f64, whole: Option<i64>, text: &str) -> Self {
        Self {
            value,
            whole,
            written: Some(text.into()),
        }
    }

    /// A number that is written as it was: whole where it can be and `like` is.
    pub(crate) fn like(value: f64, like: &Self) -> Self {
        let is_whole = value.fract().abs() <= 0.0 && value.abs() < 1e15;
        let whole = (like.whole.is_some() && is_whole).then_some(value as i64);
        Self {
            value,
            whole,
            written: None,
        }
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self {
            value,
            whole: None,
            written: None,
        }
    }
}

impl From<i64> for Number {
    fn from(whole: i64) -> Self {
        Self {
            value: whole as f64,
            whole: Some(whole),
            written: None,
        }
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Flag(a), Self::Flag(b)) => a == b,
            (Self::Number(a), Self::Number(b)) => a == b,
            (Self::Text(a), Self::Text(b)) | (Self::Date(a), Self::Date(b)) => a == b,
            (Self::List(a), Self::List(b)) => a == b,
            (Self::Table(a), Self::Table(b)) => {
                let holds =
                    |(key, node): &(Arc<str>, Node)| b.iter().any(|(k, n)| k == key && n == node);
                a.len() == b.len() && a.iter().all(holds)
            }
            _ => false,
        }
    }
}

/// Numbers are equal that mean the same, however they are written.
impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.value.total_cmp(&other.value).is_eq() && self.whole == other.whole
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.written, self.whole) {
            (Some(text), _) => f.write_str(text),
            (None, Some(whole)) => write!(f, "{whole}"),
            (None, None) => write!(f, "{:?}", self.value),
        }
    }
}

impl Node {
    /// A value that no file says.
    pub fn new(value: Value) -> Self {
        Self { value, line: 0 }
    }

    /// The same in no line.
    fn unplaced(self) -> Self {
        Self::new(match self.value {
            Value::List(list) => Value::List(list.into_iter().map(Self::unplaced).collect()),
            Value::Table(entries) => {
                let entries = entries
                    .into_iter()
                    .map(|(key, node)| (key, node.unplaced()));
                Value::Table(entries.collect())
            }
            other => other,
        })
    }

    /// The value at a place, to be changed.
    pub(crate) fn at_mut(&mut self, place: &[usize]) -> Option<&mut Self> {
        let Some((first, rest)) = place.split_first() else {
            return Some(self);
        };
        let child = match &mut self.value {
            Value::List(list) => list.get_mut(*first),
            Value::Table(entries) => entries.get_mut(*first).map(|(_, node)| node),
            _ => None,
        };
        child?.at_mut(rest)
    }

    /// The value of a key, of a table that has it.
    pub(crate) fn get(&self, key: &str) -> Option<&Self> {
        match &self.value {
            Value::Table(entries) => entries
                .iter()
                .find(|(name, _)| **name == *key)
                .map(|(_, node)| node),
            _ => None,
        }
    }

    /// What an entry of a list calls itself.
    pub(crate) fn name(&self) -> Option<&str> {
        match &self.get("name")?.value {
            Value::Text(name) => Some(name),
            _ => None,
        }
    }
}
