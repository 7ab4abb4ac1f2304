//! All tests of the library and of the command but those of the architecture: one binary, so that it is linked once.

mod command;
mod common;
mod exactness;
mod measured;
mod meshes;
mod plans;
mod scenes;

mod embedding;
mod examples;
