//! Tools that judge the strategies of [`cutaway`]: they compare each pixel with an exact reference, and measure times.
//!
//! [`exact`] computes what each pixel of a scene shows, in f64 and without a device; [`compare`](mod@compare) compares layers with it;
//! [`hard_cases`] has scenes with known answers; [`experiment`] sweeps parameters and keeps records, from which [`report`] makes pages.
//!
//! ```text
//! imports  exact <- compare <- hard_cases <- experiment <- report
//! ```
//!
//! `exact` and `compare` share only [`cutaway::scene`] and [`cutaway::layers`] with the strategies, so that they cannot repeat
//! errors of the strategies they judge. A test checks this by the imports in the source files.

pub mod compare;
pub mod exact;
pub mod experiment;
pub mod hard_cases;
pub mod report;

pub use compare::{Comparison, compare};
pub use exact::Exact;
