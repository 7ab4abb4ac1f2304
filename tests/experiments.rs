//! Experiments as data: read or refused by name, expanded, run, kept, and held against what they expect.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[path = "common/command.rs"]
mod command;
mod common;

#[path = "experiments/curated.rs"]
mod curated;
#[path = "experiments/definitions.rs"]
mod definitions;
#[path = "experiments/drifts.rs"]
mod drifts;
#[path = "experiments/expectations.rs"]
mod expectations;
#[path = "experiments/order.rs"]
mod order;
#[path = "experiments/sittings.rs"]
mod sittings;

use std::path::Path;

use cutaway::Result;
use cutaway::experiment::Definition;
use cutaway::experiment::definition::{Asked, SceneRun};

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
