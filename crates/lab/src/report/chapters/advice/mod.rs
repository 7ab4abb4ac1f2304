//! Which strategy to use: for what one needs, for what one has, and at some points.

pub(super) mod answers;
mod best;
pub(super) mod cards;
mod inputs;
pub(super) mod outside;
mod reasons;
