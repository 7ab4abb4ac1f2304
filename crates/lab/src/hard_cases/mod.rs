//! Hard cases: scenes with a known answer, and what every strategy is expected to make of them.
//!
//! A [`Case`] is scenes and, for each [method](cutaway::strategies::Method), what is [`Expected`] of it: nothing wrong, wrong within what theory allows, a refusal,
//! or a failure with its reason. [`cases`] is the table, [`found`] asks it of a session, and `cargo test -p cutaway-tests --test it hard_cases::` holds it.
//! What of a case is more than a picture is held by tests that [`list`] names, so that each of the fifty numbers has its keeper.
//!
//! [`random`] makes scenes without a pattern, and the simplest of those that come out wrong.
//!
//! Scenes are written in the source: their builders ([`scenes`], [`meshes`]) panic where a word makes no sense. A case costs one exact
//! image for each of its pictures and a frame for each method; nothing is kept between cases but what the session keeps.

mod band;
pub mod bumps;
mod case;
mod cases;
mod coarse;
mod expected;
mod failures;
mod found;
mod listed;
pub mod meshes;
mod methods;
pub mod numbers;
mod question;
pub mod random;
pub mod scenes;
pub mod solids;
pub mod tolerances;
mod user_cases;
pub mod users;
pub mod windings;

pub use case::{Case, Form, Keeps};
pub use cases::cases;
pub use expected::{Expected, Tally};
pub use found::{Asked, CaseFound, Reached, caps_px, check_ids, found, pictures, tallied};
pub use listed::{Listed, list};
pub use methods::usual_methods;
pub use question::{Judged, Question, class_of, is_wrong};
