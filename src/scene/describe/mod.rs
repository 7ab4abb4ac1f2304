//! Descriptions of the values that users set by key; each value is declared once, at the field that holds it.
//!
//! ```
//! use cutaway::scene::describe::{Described, Given};
//! use cutaway::scene::style::Shadow;
//! let mut shadow = Shadow::default();
//! let strength = Shadow::FIELDS.iter().position(|f| f.key == "strength").ok_or("no such value")?;
//! assert!(shadow.set(strength, Given::Number(0.5)));
//! assert_eq!(shadow.strength, 0.5);
//! assert!(!shadow.set(strength, Given::Flag(true)));
//! assert_eq!(Shadow::FIELDS[strength].takes.to_string(), "number from 0 to 1");
//! # Ok::<(), &str>(())
//! ```
//!
//! `#[derive(Described)]` generates a struct's list of [`Field`]s, with access to the values by their index in that list. Scene-file
//! readers, the list of paths, help texts, range checks and the window's panels all use the list, so the documented range is the one that
//! is checked.
//!
//! Cost: a `match` for each access. Cannot: check ranges or constraints between several values, which file readers do; be derived in
//! a crate that renames this one.

mod leaf;
mod value_type;

pub use cutaway_derive::Described;
pub use leaf::{Factors, Given, Leaf, OrWord};
pub use value_type::ValueType;

/// Declaration of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Key in its table; empty if the values of `below` are placed directly in the table.
    pub key: &'static str,
    /// Description in one line.
    pub help: &'static str,
    /// Type and range.
    pub takes: ValueType,
    /// Unit of its numbers; empty if they have none.
    pub unit: &'static str,
    /// An example value, as TOML.
    pub example: &'static str,
    /// True if it can be animated.
    pub moves: bool,
    /// True if the value has forms that no [`ValueType`] describes.
    #[doc(hidden)]
    pub is_read_by_hand: bool,
    /// Declarations of the table's values, if the field is a table.
    pub below: &'static [Self],
}

impl Field {
    /// A value. Numbers and flags can be animated.
    pub const fn leaf(
        key: &'static str,
        help: &'static str,
        takes: ValueType,
        example: &'static str,
    ) -> Self {
        Self {
            key,
            help,
            takes,
            unit: "",
            example,
            moves: takes.is_numeric(),
            is_read_by_hand: false,
            below: &[],
        }
    }

    /// A table of values.
    pub const fn table(key: &'static str, help: &'static str, below: &'static [Self]) -> Self {
        Self {
            below,
            ..Self::leaf(key, help, ValueType::Table, "")
        }
    }

    /// The same field, with a unit.
    #[must_use]
    pub const fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// The same field, read by hand if `T` is.
    #[doc(hidden)]
    #[must_use]
    pub const fn read_as<T: Leaf>(self) -> Self {
        Self {
            is_read_by_hand: T::IS_READ_BY_HAND,
            ..self
        }
    }

    /// The same field, but not animatable.
    #[must_use]
    pub const fn fixed(self) -> Self {
        Self {
            moves: false,
            ..self
        }
    }
}

/// Access to values by their index in the list of declarations.
pub trait Described {
    /// The declarations.
    fn fields(&self) -> &'static [Field];

    /// Sets a value of the field's type; returns false and changes nothing for other types. The caller checks ranges.
    fn set(&mut self, field: usize, given: Given) -> bool;

    /// The value; `None` if it is not set or is a table.
    fn get(&self, field: usize) -> Option<Given>;

    /// The values in a field that is a table.
    fn below(&self, field: usize) -> Option<&dyn Described> {
        let _ = field;
        None
    }

    /// The values in a field that is a table, mutable.
    fn below_mut(&mut self, field: usize) -> Option<&mut dyn Described> {
        let _ = field;
        None
    }
}

/// The names of a list of named values.
#[doc(hidden)]
pub const fn words<T, const N: usize>(named: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut i = 0;
    while i < N {
        words[i] = named[i].0;
        i += 1;
    }
    words
}

/// The words of two lists, concatenated; `ALL` is their total number.
#[doc(hidden)]
pub const fn joined<const ALL: usize>(
    first: &[&'static str],
    then: &[&'static str],
) -> [&'static str; ALL] {
    assert!(
        first.len() + then.len() == ALL,
        "the lists have other lengths"
    );
    let mut words = [""; ALL];
    let mut i = 0;
    while i < ALL {
        words[i] = if i < first.len() {
            first[i]
        } else {
            then[i - first.len()]
        };
        i += 1;
    }
    words
}
