//! Numbers: their range, their units, and how documents and readers have them.

pub(super) mod amount;
pub(super) mod decimals;
pub(super) mod length_unit;
#[doc(hidden)]
pub mod numbers;
#[doc(hidden)]
pub mod range;
