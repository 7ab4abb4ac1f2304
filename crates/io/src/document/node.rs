//! The tree of a scene: values with their source positions.
//!
//! A tree is created by [`parse`](super::parse) or by a program. Edits refer to a value by its place, which is the list of child indices
//! that leads to the value. A place is valid as long as nothing is added or removed before it.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use cutaway::scene::Amount;
use cutaway::scene::describe::Given;
use glam::Vec3;

/// A value with its source position. Nodes are equal if they hold equal values, whatever their positions.
#[derive(Clone, Debug)]
pub struct Node {
    /// The value.
    pub value: Value,
    /// Source position of the value.
    pub origin: Origin,
}

/// Source position of a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// No source text: the value was set by a program.
    #[default]
    Program,
    /// In the document's file.
    Text {
        /// Line, from 1.
        line: usize,
        /// Number of the character within the line, from 1.
        column: usize,
    },
    /// In a file other than the document's, such as an experiment that changes the document.
    Elsewhere {
        /// The file.
        file: Arc<Path>,
        /// Line, from 1.
        line: usize,
        /// Number of the character within the line, from 1.
        column: usize,
    },
    /// In a command-line option; holds the option as the user wrote it, such as `--section z=50%`.
    Option(Arc<str>),
}

/// Value of a key of a scene. Equality of tables ignores the order.
#[derive(Clone, Debug)]
pub enum Value {
    /// True or false.
    Flag(bool),
    /// A number.
    Number(Number),
    /// Text, without its quotes.
    Text(Arc<str>),
    /// A date. No scene key accepts one.
    Date(Arc<str>),
    /// A list.
    List(Vec<Node>),
    /// A table, with its keys in the order of the file.
    Table(Vec<(Arc<str>, Node)>),
}

/// A number, integer or not.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// Numeric value; NaN if the text is out of range.
    pub value: f64,
    /// The value as an integer, if it is written without a decimal point.
    pub whole: Option<i64>,
}

impl Value {
    /// Parses a text as a TOML number, flag, list or table. Anything else stays a text.
    pub fn read(text: &str) -> Self {
        let alone = |root: Node| match root.value {
            Self::Table(entries) => <[_; 1]>::try_from(entries).ok(),
            _ => None,
        };
        let read = super::parse(Path::new("value"), &format!("value = {text}")).ok();
        match read.and_then(alone) {
            Some([(_, node)]) => node.said(&Origin::Program).value,
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

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text.into())
    }
}

/// Converts a described value to its form in documents, where colours are written as `#rrggbb`.
impl From<Given> for Value {
    fn from(given: Given) -> Self {
        match given {
            Given::Flag(flag) => flag.into(),
            Given::Whole(whole) => whole.into(),
            Given::Number(number) => number.into(),
            Given::Numbers(numbers) => numbers.into(),
            Given::Amount(amount) => amount.into(),
            Given::Amounts(amounts) => amounts.into(),
            Given::Color(color) => hex(color).into(),
            Given::Text(text) => text.into(),
            Given::Texts(texts) => texts.into(),
        }
    }
}

impl From<Amount> for Value {
    fn from(amount: Amount) -> Self {
        match amount {
            Amount::Units(number) => number.into(),
            Amount::Percent(_) => amount.to_string().into(),
        }
    }
}

/// Formats a colour in sRGB as `#rrggbb`.
pub fn hex(srgb: Vec3) -> String {
    let byte = |channel: f32| (channel.clamp(0.0, 1.0) * 255.0).round() as u8;
    let [r, g, b] = srgb.to_array().map(byte);
    format!("#{r:02x}{g:02x}{b:02x}")
}

impl<T: Into<Self>> From<Vec<T>> for Value {
    fn from(list: Vec<T>) -> Self {
        Self::List(list.into_iter().map(Node::new).collect())
    }
}

impl<const N: usize> From<[(&str, Self); N]> for Value {
    /// A table.
    fn from(entries: [(&str, Self); N]) -> Self {
        let entries = entries.into_iter();
        Self::Table(entries.map(|(k, v)| (k.into(), Node::new(v))).collect())
    }
}

/// Position of a value in the tree, as the child index at each level from the root.
pub(crate) type Place = Vec<usize>;

/// All integers up to this are exact in f64.
const MOST_WHOLE: f64 = (1_u64 << 53) as f64;

impl Number {
    /// The number as an integer, if it has no fraction. Both 5 and 5.0 give 5.
    pub(crate) fn as_whole(&self) -> Option<i64> {
        let is_whole = self.value.fract() == 0.0 && self.value.abs() <= MOST_WHOLE;
        self.whole.or(is_whole.then_some(self.value as i64))
    }

    /// A number written like `like`. It is an integer if `like` is an integer and the value has no fraction.
    pub(crate) fn like(value: f64, like: &Self) -> Self {
        let is_whole = value.fract().abs() <= 0.0 && value.abs() < MOST_WHOLE;
        let whole = (like.whole.is_some() && is_whole).then_some(value as i64);
        Self { value, whole }
    }
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        Self { value, whole: None }
    }
}

impl From<i64> for Number {
    fn from(whole: i64) -> Self {
        Self {
            value: whole as f64,
            whole: Some(whole),
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

/// Numbers are equal if they have the same value and are both integers or both not.
impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.value.total_cmp(&other.value).is_eq() && self.whole == other.whole
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.whole {
            Some(whole) => write!(f, "{whole}"),
            None => write!(f, "{:?}", self.value),
        }
    }
}

impl Node {
    /// Creates a node from a value, without a source position.
    pub fn new(value: impl Into<Value>) -> Self {
        Self {
            value: value.into(),
            origin: Origin::Program,
        }
    }

    /// The same node, in which all values have another source position.
    #[must_use]
    pub fn said(self, origin: &Origin) -> Self {
        self.with_origins(&|_| origin.clone())
    }

    /// The same node, in which positions in the document's own file become positions in `file`.
    #[must_use]
    #[doc(hidden)]
    pub fn of_file(self, file: &Arc<Path>) -> Self {
        self.with_origins(&|origin| match origin {
            Origin::Text { line, column } => Origin::Elsewhere {
                file: Arc::clone(file),
                line,
                column,
            },
            other => other,
        })
    }

    fn with_origins(self, change: &dyn Fn(Origin) -> Origin) -> Self {
        let below = |node: Self| node.with_origins(change);
        let value = match self.value {
            Value::List(list) => Value::List(list.into_iter().map(below).collect()),
            Value::Table(entries) => {
                let entries = entries.into_iter().map(|(key, node)| (key, below(node)));
                Value::Table(entries.collect())
            }
            other => other,
        };
        Self {
            value,
            origin: change(self.origin),
        }
    }

    /// The value at a place, for editing.
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

    /// The entries of a list; empty for other values.
    pub fn items(&self) -> &[Self] {
        match &self.value {
            Value::List(list) => list,
            _ => &[],
        }
    }

    /// The child with an index.
    pub(crate) fn child(&self, index: usize) -> Option<&Self> {
        match &self.value {
            Value::List(list) => list.get(index),
            Value::Table(entries) => entries.get(index).map(|(_, node)| node),
            _ => None,
        }
    }

    /// The value of a key, if the value is a table with that key.
    pub fn get(&self, key: &str) -> Option<&Self> {
        match &self.value {
            Value::Table(entries) => entries
                .iter()
                .find(|(name, _)| **name == *key)
                .map(|(_, node)| node),
            _ => None,
        }
    }

    /// Returns the `name` of an entry of a list.
    pub fn name(&self) -> Option<&str> {
        self.get("name")?.text()
    }

    /// Returns the default name of a part without a `name`: after its shape or its mesh file.
    pub fn model(&self) -> Option<String> {
        if let Some(mesh) = self.get("mesh") {
            let stem = Path::new(mesh.text()?).file_stem()?;
            return Some(stem.to_string_lossy().into_owned());
        }
        let shape = self.get("shape")?;
        let spec = shape.get("name").unwrap_or(shape).text()?;
        spec.split('?').next().map(str::to_owned)
    }

    /// The text, if the value is a text.
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }
}
