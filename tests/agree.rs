//! Every strategy against the exact reference: on a corpus of scenes, on random ones, and on those that once were wrong.

mod common;

#[path = "agree/corpus.rs"]
mod corpus;
#[path = "agree/near_caps.rs"]
mod near_caps;
#[path = "agree/random.rs"]
mod random;
#[path = "agree/regressions.rs"]
mod regressions;
