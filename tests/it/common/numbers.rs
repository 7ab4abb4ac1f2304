//! The numbers without a pattern that random scenes are made of.

#![allow(
    unused_imports,
    reason = "each test binary uses its own share of what is here"
)]

pub(crate) use cutaway::hard_cases::numbers::Numbers;
