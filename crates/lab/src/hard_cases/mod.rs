//! Hard cases: scenes with a known answer, and what every strategy is expected to make of them.
//!
//! A [`Case`] is scenes and an [`Expected`] result for each [method](cutaway::strategies::Method): nothing wrong, errors within theory,
//! a refusal, or a failure with its reason. [`found`] runs the table [`cases`]; `cargo test -p cutaway-tests --test it hard_cases::` too.
//! What of a case is more than a picture is held by tests that [`list`] names, so that each of the fifty numbers has its keeper.
//!
//! [`random`] makes scenes without a pattern, and the simplest of those that come out wrong.
//!
//! Each case is a scene file in this crate's folder `hard-cases`, with a table `[case]` of expected results (its form: `files.rs`), so
//! that any case can be drawn: `cutaway compare experiments/hard-cases/16-hollow.toml`. What [`scenes`] and [`meshes`] build is for tests;
//! they panic where a word makes no sense. A case costs one exact image for each of its pictures and a frame for each method; nothing is
//! kept between cases but what the session keeps.

mod band;
mod case;
mod cases;
mod expected;
mod files;
mod found;
mod listed;
pub mod meshes;
mod methods;
pub mod numbers;
mod question;
pub mod random;
pub mod scenes;
pub mod tolerances;

pub use case::{Case, CasePicture, Form, Keeps};
pub use cases::cases;
pub use expected::{Expected, Tally};
pub use files::read;
pub use found::{Asked, CaseFound, Reached, caps_px, check_ids, found, pictures, tallied};
pub use listed::{Listed, list};
pub use methods::usual_methods;
pub use question::{Judged, Question, class_of, is_wrong};
