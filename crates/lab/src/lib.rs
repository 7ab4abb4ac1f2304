//! Tools that judge the strategies of [`cutaway`]: one exact reference, pixel by pixel, and the clock.
//!
//! [`exact`] works out what each pixel of a scene shows, in f64 and without a device; [`compare`](mod@compare) holds layers against it;
//! [`hard_cases`] are the scenes that must hold; [`experiment`] sweeps parameters and keeps records, of which [`report`] makes pages.
//!
//! ```text
//! imports  exact <- compare <- hard_cases <- experiment <- report
//! ```
//!
//! `exact` and `compare` share only [`cutaway::scene`] and [`cutaway::layers`] with the strategies, so that they do not share the errors
//! of what they judge. A test checks that against the source.

pub mod compare;
pub mod exact;
pub mod experiment;
pub mod hard_cases;
pub mod report;

pub use compare::{Comparison, compare};
pub use exact::Exact;
