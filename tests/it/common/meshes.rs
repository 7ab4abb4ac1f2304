//! The meshes of the hard cases.

#![allow(
    unused_imports,
    reason = "each test binary uses its own share of what is here"
)]

pub(crate) use cutaway::hard_cases::meshes::*;
