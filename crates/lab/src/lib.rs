//! What the strategies of [`cutaway`] are judged by: one exact reference, pixel by pixel, and the clock.
//!
//! [`exact`] works out what each pixel of a scene shows, in f64 and without a device; [`compare`](mod@compare) holds layers against it;
//! [`hard_cases`] are the scenes that must hold; [`experiment`] sweeps parameters and keeps records, of which [`report`] makes pages.
//!
//! ```text
//! imports  exact <- compare <- hard_cases <- experiment <- report
//! ```
//!
//! `exact` and `compare` share nothing with the strategies but [`cutaway::scene`] and [`cutaway::layers`], so that neither is wrong in the way
//! of what it judges. A test holds that against the source.

pub mod compare;
pub mod exact;
pub mod experiment;
pub mod hard_cases;
pub mod report;

pub use compare::{Comparison, compare};
pub use exact::Exact;
