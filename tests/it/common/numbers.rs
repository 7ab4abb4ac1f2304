//! The numbers without a pattern that random scenes are made of.

pub(crate) use cutaway::hard_cases::numbers::Numbers;
