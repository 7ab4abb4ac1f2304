//! Recommendations of strategies: by question, by kind of input, and for given points.

pub(super) mod answers;
mod best;
pub(super) mod cards;
mod inputs;
pub(super) mod outside;
mod reasons;
