//! The numbers without a pattern that random scenes are made of.

pub(crate) use cutaway_lab::hard_cases::numbers::Numbers;
