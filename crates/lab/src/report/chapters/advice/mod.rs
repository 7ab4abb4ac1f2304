//! Choice of a strategy: by need, by input, and at some points.

pub(super) mod answers;
mod best;
pub(super) mod cards;
mod inputs;
pub(super) mod outside;
mod reasons;
