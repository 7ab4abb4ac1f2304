//! Promise: a frame leaves nothing behind: memory does not grow with the number of frames.
//!
//! The driver's is counted with it, for a driver may keep what it is given: see `src/gpu/uniforms.rs`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![cfg(target_os = "linux")]

use std::fs;
use std::process::Stdio;
use std::time::Duration;

use crate::common::command::Scratch;

/// Most that a frame may add: where llvmpipe kept copies of shaders it was 1 MB.
const MOST_KIB_PER_FRAME: f64 = 150.0;

/// The most memory that a command had at once, in KiB: what it had when it was last looked at.
fn peak_kib(folder: &Scratch, line: &str) -> f64 {
    let mut command = folder.command(line);
    let mut child = command.stderr(Stdio::null()).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = 0.0_f64;
    while child.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let kib = line.and_then(|l| l.split_whitespace().next()?.parse().ok());
        peak = kib.map_or(peak, |kib: f64| peak.max(kib));
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(child.wait().unwrap().success(), "{line}");
    peak
}

#[test]
fn memory_does_not_grow_with_the_number_of_frames() {
    let folder = Scratch::new("memory");
    for drawn_by in ["hardware", "compute"] {
        let of = |frames: u32| {
            let line = format!(
                "animate shape:cube --section z=50% --rasteriser {drawn_by} --turntable --frames {frames} --resolution 96,72 -o all.png"
            );
            peak_kib(&folder, &line)
        };
        // The first compiles shaders, which a cache of the driver then has.
        let [_, few, many] = [2, 20, 120].map(of);
        let grown = (many - few) / 100.0;
        assert!(
            grown < MOST_KIB_PER_FRAME,
            "{drawn_by}: {grown} KiB a frame, {few} to {many} KiB"
        );
    }
}
