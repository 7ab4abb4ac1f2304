//! Real meshes, which are not part of the repository: in `$CUTAWAY_DATA`, or in `../shared/data`. The suite must pass on a
//! machine that has only the repository, so where neither is there a test checks nothing, and the run says so.
//!
//! It says so once, past the harness, which holds back what passing tests print. Which tests it is about is written to the file that
//! `$CUTAWAY_NOT_CHECKED` names, a line each, for `scripts/test.sh` to count at the end. They are told apart by the names of their
//! threads, which one thread for all (`--test-threads=1`) does not have.

use std::fs::OpenOptions;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::sync::Once;

/// The folder of real meshes, if it is there.
pub(crate) fn data() -> Option<PathBuf> {
    let beside = super::root().join("../shared/data");
    let folder = std::env::var_os("CUTAWAY_DATA").map_or(beside, PathBuf::from);
    let there = folder.join("facts.json").is_file();
    if !there {
        say_not_checked(&folder);
    }
    there.then_some(folder)
}

fn say_not_checked(folder: &Path) {
    static SAID: Once = Once::new();
    let folder = folder.display();
    SAID.call_once(|| {
        let all = format!(
            "\nNOT CHECKED: there are no real meshes at {folder}: tests of them pass without a look\n\n"
        );
        stderr().write_all(all.as_bytes()).expect("stderr is open");
    });
    if let Some(list) = std::env::var_os("CUTAWAY_NOT_CHECKED") {
        let thread = std::thread::current();
        let line = format!("{} {folder}\n", thread.name().unwrap_or("main"));
        // In one go: other tests write to it too.
        let mut list = OpenOptions::new().append(true).create(true).open(list);
        let list = list.as_mut().expect("a file to write to");
        list.write_all(line.as_bytes()).expect("a line is written");
    }
}
