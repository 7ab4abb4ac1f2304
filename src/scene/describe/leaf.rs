//! Maps Rust types to value types.

use std::path::PathBuf;

use glam::{DVec2, DVec3, Vec3};

use super::ValueType;
use crate::scene::units::amount::Amount;

/// A value given for a field, of the field's type.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// True or false.
    Flag(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// Several numbers.
    Numbers(Vec<f64>),
    /// A number or a percentage.
    Amount(Amount),
    /// Several numbers or percentages.
    Amounts(Vec<Amount>),
    /// A colour, sRGB in 0..=1.
    Color(Vec3),
    /// A text or a keyword.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
}

/// A Rust type that holds one value.
pub trait Leaf: Sized {
    /// The type of the value.
    const TYPE: ValueType;

    /// True if the value has forms that no [`ValueType`] describes, so that its reader parses it directly from the table.
    const IS_READ_BY_HAND: bool = false;

    /// Converts a given value of that type; `None` for other types.
    fn of(given: Given) -> Option<Self>;

    /// The value, if there is one.
    fn get(&self) -> Option<Given>;

    /// Sets the value; if `given` has another type, changes nothing and returns false.
    fn set(&mut self, given: Given) -> bool {
        match Self::of(given) {
            Some(value) => {
                *self = value;
                true
            }
            None => false,
        }
    }
}

/// A value that may be missing.
impl<T: Leaf> Leaf for Option<T> {
    const TYPE: ValueType = T::TYPE;

    fn of(given: Given) -> Option<Self> {
        T::of(given).map(Some)
    }

    fn get(&self) -> Option<Given> {
        self.as_ref().and_then(T::get)
    }
}

/// Implements [`Leaf`] for a type that corresponds to one variant of [`Given`].
macro_rules! leaf {
    ($($type:ty, $takes:expr, $variant:ident, $from:expr, $to:expr;)*) => {$(
        impl Leaf for $type {
            const TYPE: ValueType = $takes;

            fn of(given: Given) -> Option<Self> {
                match given {
                    Given::$variant(value) => $from(value),
                    _ => None,
                }
            }

            fn get(&self) -> Option<Given> {
                Some(Given::$variant($to(self)))
            }
        }
    )*};
}

const ANY: f64 = f64::INFINITY;

leaf! {
    bool, ValueType::Flag, Flag, Some, |v: &Self| *v;
    f64, ValueType::Number(-ANY, ANY), Number, Some, |v: &Self| *v;
    f32, ValueType::Number(-ANY, ANY), Number, |v| Some(v as Self), |v: &Self| written(*v);
    u32, ValueType::Whole(0.0, u32::MAX as f64), Whole, |v| Self::try_from(v).ok(), |v: &Self| i64::from(*v);
    u64, ValueType::Whole(0.0, i64::MAX as f64), Whole, |v| Self::try_from(v).ok(), |v: &Self| i64::try_from(*v).unwrap_or(i64::MAX);
    i32, ValueType::Whole(i32::MIN as f64, i32::MAX as f64), Whole, |v| Self::try_from(v).ok(), |v: &Self| i64::from(*v);
    Vec3, ValueType::Color, Color, Some, |v: &Self| *v;
    Amount, ValueType::Amount(-ANY, ANY), Amount, Some, |v: &Self| *v;
    [Amount; 3], ValueType::Amounts, Amounts, |v: Vec<_>| v.try_into().ok(), |v: &Self| v.to_vec();
    DVec2, ValueType::Numbers(2, -ANY, ANY), Numbers, |v: Vec<_>| v.try_into().ok().map(<[f64; 2]>::into), |v: &Self| v.to_array().to_vec();
    DVec3, ValueType::Numbers(3, -ANY, ANY), Numbers, |v: Vec<_>| v.try_into().ok().map(<[f64; 3]>::into), |v: &Self| v.to_array().to_vec();
    String, ValueType::Text, Text, Some, Clone::clone;
    PathBuf, ValueType::File, Text, |v| Some(Self::from(v)), |v: &Self| v.display().to_string();
    Vec<String>, ValueType::Texts, Texts, Some, Clone::clone;
}

impl<const N: usize> Leaf for [f32; N] {
    const TYPE: ValueType = ValueType::Numbers(N, -ANY, ANY);

    fn of(given: Given) -> Option<Self> {
        match given {
            Given::Numbers(v) => v
                .iter()
                .map(|v| *v as f32)
                .collect::<Vec<_>>()
                .try_into()
                .ok(),
            _ => None,
        }
    }

    fn get(&self) -> Option<Given> {
        Some(Given::Numbers(self.map(written).to_vec()))
    }
}

/// Two counts of pixels or texels.
impl Leaf for [u32; 2] {
    const TYPE: ValueType = ValueType::Wholes(2, 0.0, u32::MAX as f64);

    fn of(given: Given) -> Option<Self> {
        match given {
            Given::Numbers(v) => v
                .iter()
                .map(|v| *v as u32)
                .collect::<Vec<_>>()
                .try_into()
                .ok(),
            _ => None,
        }
    }

    fn get(&self) -> Option<Given> {
        Some(Given::Numbers(self.map(f64::from).to_vec()))
    }
}

/// Factors along the three axes; may be given as one number for all.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors(pub DVec3);

impl Leaf for Factors {
    const TYPE: ValueType = ValueType::OneOrMore(&<f64 as Leaf>::TYPE, 3);

    fn of(given: Given) -> Option<Self> {
        DVec3::of(given).map(Self)
    }

    fn get(&self) -> Option<Given> {
        self.0.get()
    }
}

/// A value, or one of the keywords that its declaration lists.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq)]
pub enum OrWord<T> {
    /// A value.
    Value(T),
    /// A keyword.
    Word(String),
}

impl<T: Leaf> Leaf for OrWord<T> {
    const TYPE: ValueType = T::TYPE;

    fn of(given: Given) -> Option<Self> {
        match (T::of(given.clone()), given) {
            (Some(value), _) => Some(Self::Value(value)),
            (None, Given::Text(word)) => Some(Self::Word(word)),
            _ => None,
        }
    }

    fn get(&self) -> Option<Given> {
        match self {
            Self::Value(value) => value.get(),
            Self::Word(word) => Some(Given::Text(word.clone())),
        }
    }
}

/// The f64 with the same decimal notation as an f32: 0.1, not 0.10000000149.
fn written(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(f64::from(value))
}
