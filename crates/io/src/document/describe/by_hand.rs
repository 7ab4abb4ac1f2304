//! Values that have several forms. Their readers take them directly from the table.

use cutaway::scene::describe::{Given, Leaf, ValueType};

/// Placeholder in a description for a value that has several forms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ByHand;

impl Leaf for ByHand {
    const TYPE: ValueType = ValueType::Other;
    const IS_READ_BY_HAND: bool = true;

    fn of(_: Given) -> Option<Self> {
        None
    }

    fn get(&self) -> Option<Given> {
        None
    }
}
