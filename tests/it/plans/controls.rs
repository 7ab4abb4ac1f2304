//! Every check is able to fail: each test here plants a fault and demands that it is found.

mod frames;
mod plans;
mod planted;
