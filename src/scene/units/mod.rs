//! Numbers: their range, their units, and their formatting for documents and human readers.

pub(super) mod amount;
pub(super) mod decimals;
pub(super) mod length_unit;
#[doc(hidden)]
pub mod numbers;
#[doc(hidden)]
pub mod range;
