//! Experiments as data: read or refused by name, expanded, run, kept, and held against what they expect.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;
use crate::common::command;

mod curated;
mod definitions;
mod drifts;
mod expectations;
mod invocations;
mod order;

use std::path::Path;

use cutaway::Result;
use cutaway_lab::experiment::Definition;
use cutaway_lab::experiment::definition::{Asked, SceneRun};

/// Reads an experiment that no file holds.
fn read(text: &str) -> Result<Definition> {
    Definition::read(Path::new("here/01-test.toml"), text)
}

/// The first run of an experiment, which asks about scenes.
fn scenes(definition: &Definition, is_quick: bool) -> SceneRun {
    match definition.runs[0].asked(is_quick) {
        Asked::Scenes(run) => run.clone(),
        other => panic!("{other:?} asks about no scenes"),
    }
}
