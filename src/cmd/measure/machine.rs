//! Where a run is made: the machine, the commit of the program, and the time of day.
//!
//! What cannot be told is left out, never guessed. On Linux `/proc` is asked; elsewhere only what the standard library knows. The
//! commit is asked of `git` in the folder that the program was built from, if that is still there and nothing in it has changed
//! since: a program that was installed, or is older than its sources, has none.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

use crate::experiment::Machine;

/// The machine, as busy as it is now.
pub(super) fn machine() -> Machine {
    let read =
        |file: &str| std::fs::read_to_string(Path::new("/proc").join(file)).unwrap_or_default();
    let after = |text: &str, key: &str| {
        let line = text.lines().find(|l| l.starts_with(key))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let memory = after(&read("meminfo"), "MemTotal");
    let kib = memory.and_then(|m| m.split_whitespace().next()?.parse::<u64>().ok());
    Machine {
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        processor: after(&read("cpuinfo"), "model name").unwrap_or_else(|| "unknown".to_owned()),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        memory: kib.map(|kib| kib * 1024),
        load: read("loadavg")
            .split(' ')
            .next()
            .and_then(|l| l.parse().ok()),
    }
}

/// The commit that the program was built from, with `+` where the sources differ from it.
pub(super) fn commit() -> Option<String> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
    let program = std::env::current_exe().ok()?;
    let built = program.metadata().ok()?.modified().ok()?;
    let is_of_it = ["src", "shaders", "Cargo.toml", "Cargo.lock"]
        .iter()
        .all(|name| changed(&sources.join(name)).is_some_and(|at| at <= built));
    if !is_of_it {
        return None;
    }
    let git = |args: &[&str]| {
        let mut command = Command::new("git");
        let output = command.arg("-C").arg(sources).args(args).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let status = git(&[
        "status",
        "--porcelain",
        "--",
        "src",
        "shaders",
        "Cargo.toml",
        "Cargo.lock",
    ])?;
    Some(if status.is_empty() {
        commit
    } else {
        format!("{commit}+")
    })
}

/// When a file, or the last of a folder, was changed.
fn changed(path: &Path) -> Option<SystemTime> {
    let own = path.metadata().ok()?;
    if !own.is_dir() {
        return own.modified().ok();
    }
    let entries: Vec<PathBuf> = std::fs::read_dir(path)
        .ok()?
        .flatten()
        .map(|e| e.path())
        .collect();
    entries.iter().filter_map(|e| changed(e)).max()
}

/// The time of day, UTC, by RFC 3339.
pub(super) fn now() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH);
    rfc_3339(seconds.map_or(0, |d| d.as_secs()))
}

/// Seconds since 1970 as a date and a time.
fn rfc_3339(seconds: u64) -> String {
    let (days, of_day) = (seconds / 86_400, seconds % 86_400);
    let is_leap = |y: u64| y.is_multiple_of(4) && (!y.is_multiple_of(100) || y.is_multiple_of(400));
    let (mut year, mut day) = (1970, days);
    while day >= 365 + u64::from(is_leap(year)) {
        day -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let months = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 0;
    while day >= months[month] {
        day -= months[month];
        month += 1;
    }
    let (hour, minute, second) = (of_day / 3600, of_day / 60 % 60, of_day % 60);
    format!(
        "{year:04}-{:02}-{:02}T{hour:02}:{minute:02}:{second:02}Z",
        month + 1,
        day + 1
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, date) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(rfc_3339(seconds), date);
        }
    }

    #[test]
    fn a_machine_has_processors() {
        let machine = machine();
        assert!(
            machine.cores > 0 && !machine.system.is_empty(),
            "{machine:?}"
        );
    }
}
