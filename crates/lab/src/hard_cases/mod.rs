//! Hard cases: scenes with a known answer, and the expected result of every strategy.
//!
//! A [`Case`] consists of scenes and an [`Expected`] result for each [method](cutaway::strategies::Method): no errors, errors within
//! theoretical bounds, a refusal, or a failure with its reason. [`found`] runs the table [`cases`], as does
//! `cargo test -p cutaway-tests --test it hard_cases::`. [`list`] names tests of what pictures cannot show: all fifty numbers are tested.
//!
//! [`random`] makes random scenes, and reduces those that are drawn wrong to their simplest form.
//!
//! Each case is a scene file in this crate's folder `hard-cases`, with a table `[case]` of expected results (format: see `files.rs`), so
//! that any case can be drawn: `cutaway compare experiments/hard-cases/16-hollow.toml`. [`scenes`] and [`meshes`] serve tests, and
//! panic on invalid input. A case costs one exact image for each of its pictures and a frame for each method; only the session keeps
//! data between cases.

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
pub use found::{
    CaseFound, CaseOutcome, CaseSelection, caps_px, check_ids, found, pictures, tallied,
};
pub use listed::{Listed, list};
pub use methods::usual_methods;
pub use question::{Judged, Question, class_of, is_wrong};
