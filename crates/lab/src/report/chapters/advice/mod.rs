//! Which strategy to use: for what one needs, for what one has, and at some points.

pub(super) mod answers;
pub(super) mod best;
pub(super) mod cards;
pub(super) mod inputs;
pub(super) mod outside;
pub(super) mod reasons;
