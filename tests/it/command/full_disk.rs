//! Promise: of several results all are written or none. A limit on the length of files stands for a disk that is full.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![cfg(unix)]

use std::process::Command;

use crate::common::command::{Ran, Scratch};

/// Runs the command where no file takes more than so many blocks of 512 bytes; without the signal for that, a write is refused.
fn limited(folder: &Scratch, blocks: u32, line: &str) -> Ran {
    let program = env!("CARGO_BIN_EXE_cutaway-tested");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} {line}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script]).current_dir(folder.path(""));
    Ran::of(line, shell.output().unwrap())
}

#[test]
fn a_result_that_finds_no_room_leaves_no_other_behind() {
    let folder = Scratch::new("full-disk");
    for (blocks, line, culprit) in [
        // The second of each is the larger one.
        (
            200,
            "section shape:gears --section z=50% -o new/cut.dxf --json new/facts.json",
            "facts.json",
        ),
        (
            40,
            "render shape:cube --section z=50% --resolution 64,64 -o new/cut.png --layers new/cut.exr",
            "cut.exr",
        ),
        (40, "relief waves --maps new", "offset.png"),
        (
            40,
            "export shape:gears --section z=50% -o new/half.stl",
            "half.stl",
        ),
    ] {
        let ran = limited(&folder, blocks, line).exits(2);
        assert!(
            ran.stderr.contains(culprit) && ran.stderr.contains("help:"),
            "{}",
            ran.stderr
        );
        assert!(
            folder.files().is_empty(),
            "{line} left {:?}",
            folder.files()
        );
    }
    // The control: with room for all of it, all of it is there.
    let line = "section shape:gears --section z=50% -o new/cut.dxf --json new/facts.json";
    limited(&folder, 20_000, line).exits(0);
    for file in ["new/cut.dxf", "new/facts.json"] {
        assert!(folder.path(file).is_file(), "{file}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_takes_no_more_leaves_no_file_behind() {
    let folder = Scratch::new("full-stdout");
    let line = "section shape:cube --section z=50% -o cut.dxf --json - > /dev/full";
    let ran = limited(&folder, 20_000, line).exits(2);
    assert!(ran.stderr.contains("standard output"), "{}", ran.stderr);
    assert!(folder.files().is_empty(), "{:?}", folder.files());
}
