//! Computes every number of a report that no record holds. Each is computed in one place, and tested against closed-form results.
//!
//! | value | computed by |
//! |---|---|
//! | the figures of a strategy at a point, by name | [`Row`] |
//! | the front of error against cost, and the price of each tenfold gain in accuracy | [`front`], [`steps`] |
//! | what a strategy costs in each situation | [`Situation`] |
//! | which strategies are exact wherever they drew, from the cheapest to the dearest | [`ranked`] |
//! | what all methods at some points cost, including wrong methods | [`candidates`] |
//! | the cost of a cutaway relative to the same picture without one, and of a style relative to plain light | [`variants`] |
//! | command line of a strategy, and its limits | [`usage`] |
//! | how wrong broken meshes are drawn, and how many wrong pixels are marked | [`Harm`] |
//! | which commands measured a run | [`invocations`] |
//! | which strategies follow the paper's method | [`papers`] |
//! | how often a strategy is exact, refuses, or overflows | [`StrategyTotals`] |

mod broken;
mod candidates;
mod front;
mod invocations;
mod order;
mod paper;
mod ranking;
mod row;
mod situation;
mod totals;
mod usage;
mod variants;

pub(super) use broken::{Harm, TOO_MUCH, harms, has_defect, has_other_truth};
pub(super) use candidates::{Candidate, candidates};
pub(super) use front::{Offer, StepPrice, front, steps};
pub(super) use invocations::invocations;
pub(super) use order::natural;
pub(super) use paper::papers;
pub(super) use ranking::{BETWEEN_RUNS, Ranked, ranked};
pub(super) use row::{Row, rows, rows_by_family};
pub(super) use situation::{CutSetKind, Situation, is_exact};
pub(super) use totals::{Spread, StrategyTotals, totals_of_strategies};
pub(super) use usage::{Usage, usage};
pub(super) use variants::{Variants, variants};
