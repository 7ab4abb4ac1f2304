//! A value on a sweep axis, as the experiment's file writes it. The value keeps its type in records and charts.

use std::collections::BTreeMap;
use std::fmt;

use cutaway::scene::Amount;
use cutaway_io::document::Value;
use serde::{Deserialize, Serialize};

/// A value of an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Parameter {
    /// True or false.
    Flag(bool),
    /// A whole number, written without a decimal point.
    Whole(i64),
    /// A number with a decimal point.
    Number(f64),
    /// A text.
    Text(String),
}

/// The values of the sweep axes, by axis name.
pub type Parameters = BTreeMap<String, Parameter>;

impl Parameter {
    /// Converts a value of a document; `None` for lists and tables.
    pub fn of(value: &Value) -> Option<Self> {
        match value {
            Value::Flag(flag) => Some(Self::Flag(*flag)),
            Value::Number(number) => Some(match number.whole {
                Some(whole) => Self::Whole(whole),
                None => Self::Number(number.value),
            }),
            Value::Text(text) => Some(Self::Text(text.to_string())),
            Value::Date(_) | Value::List(_) | Value::Table(_) => None,
        }
    }

    /// The value as a number for a chart, without a percent sign.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Flag(_) => None,
            Self::Whole(whole) => Some(*whole as f64),
            Self::Number(number) => Some(*number),
            Self::Text(text) => match Amount::parse(text).ok()? {
                Amount::Units(number) | Amount::Percent(number) => Some(number),
            },
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => flag.fmt(f),
            Self::Whole(whole) => whole.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Text(text) => text.fmt(f),
        }
    }
}
