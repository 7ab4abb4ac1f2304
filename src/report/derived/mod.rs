//! Every number of a report that is in no record: worked out in one place each, and held by closed forms.
//!
//! | what | where |
//! |---|---|
//! | figures of a strategy at a point by name | [`Row`] |
//! | the front of error against cost, and the price of each tenfold | [`front`], [`steps`] |
//! | what a strategy costs in each situation, and who is the fastest exact one | [`Situation`], [`winner`] |
//! | who is exact wherever it drew, and cheapest, over the points of one input | [`advised`] |
//! | who draws broken meshes least wrong, and who says so | [`Harm`] |
//! | which strategies are the paper's path | [`papers`] |
//! | how often a strategy is exact, refused, overflowed | [`Standing`] |

mod advice;
mod broken;
mod front;
mod order;
mod paper;
mod row;
mod situation;
mod standing;

pub(super) use advice::{Advised, advised};
pub(super) use broken::{Harm, harms, has_defect, has_other_truth};
pub(super) use front::{Offer, Price, front, steps};
pub(super) use order::{natural, number_of};
pub(super) use paper::papers;
pub(super) use row::{Row, rows, rows_by_maker};
pub(super) use situation::{Kind, Situation, is_exact, winner};
pub(super) use standing::{Spread, Standing, standings};
