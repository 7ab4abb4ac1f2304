//! Real meshes, which are not part of the repository: in `$CUTAWAY_DATA`, or in `../shared/data`. The suite must pass on a
//! machine that has only the repository, so where neither is there a test says so and checks nothing.

use std::path::PathBuf;

/// The folder of real meshes, if it is there.
pub(crate) fn data() -> Option<PathBuf> {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let folder = std::env::var_os("CUTAWAY_DATA").map_or(beside, PathBuf::from);
    let there = folder.join("facts.json").is_file();
    if !there {
        println!("no real meshes at {}: nothing to check", folder.display());
    }
    there.then_some(folder)
}
