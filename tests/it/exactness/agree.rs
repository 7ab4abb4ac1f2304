//! Every strategy against the exact reference: on a corpus of scenes, on random ones, and on those that once were wrong.

mod corpus;
mod near_caps;
mod random;
mod regressions;
