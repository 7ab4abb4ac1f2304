//! Environment of a run: the machine, its job and node in a cluster, the program's commit, and the time of day.
//!
//! Unknown values are left out, never guessed. The commit comes from `git` in the folder that the program was built from, if that folder
//! still exists and is unchanged since: for a program that was installed, or is older than its sources, there is no commit.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::SystemTime;

use cutaway_lab::experiment::{Invocation, Machine};
use sysinfo::{CpuRefreshKind, MemoryRefreshKind, RefreshKind, System};

use crate::input::shard::Shard;

/// The machine and its present load.
pub(super) fn machine() -> Machine {
    let facts = RefreshKind::nothing()
        .with_cpu(CpuRefreshKind::nothing())
        .with_memory(MemoryRefreshKind::nothing().with_ram());
    let system = System::new_with_specifics(facts).ok();
    let processor = system.as_ref().and_then(|s| s.cpus().first());
    let processor = processor.map(|p| p.brand().trim().to_owned());
    // Windows has no load average, and 0 would mean an idle machine.
    let load = System::load_average().ok().filter(|_| cfg!(unix));
    Machine {
        system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        processor: (processor.filter(|p| !p.is_empty())).unwrap_or_else(|| "unknown".to_owned()),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        memory: system.map(|s| s.total_memory()).filter(|bytes| *bytes > 0),
        load: load.map(|l| l.one),
    }
}

/// Environment variables with the job's identifier, by scheduler.
const JOBS: [&str; 6] = [
    "SLURM_JOB_ID",
    "PBS_JOBID",
    "LSB_JOBID",
    "AWS_BATCH_JOB_ID",
    "CI_JOB_ID",
    "HQ_JOB_ID",
];

/// Position in a cluster: job, share, and the node if either is known.
pub(super) fn place(shard: Option<Shard>) -> Invocation {
    let variables = JOBS.iter().filter_map(|name| std::env::var(name).ok());
    let job = variables.into_iter().find(|id| !id.is_empty());
    let is_one_of_many = job.is_some() || shard.is_some();
    Invocation {
        node: is_one_of_many.then(|| System::host_name().ok()).flatten(),
        job,
        shard: shard.map(|shard| shard.to_string()),
        ..Invocation::default()
    }
}

/// Source paths of the program, relative to the project folder.
const SOURCES: [&str; 8] = [
    "build.rs",
    "src",
    "shaders",
    "crates/io",
    "crates/lab",
    "crates/cli",
    "Cargo.toml",
    "Cargo.lock",
];

/// The commit that the program was built from, with `+` if the sources differ from it.
pub(super) fn commit() -> Option<String> {
    let project = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let program = std::env::current_exe().ok()?;
    let built = program.metadata().ok()?.modified().ok()?;
    let is_of_it = SOURCES
        .iter()
        .all(|name| changed(&project.join(name)).is_some_and(|at| at <= built));
    if !is_of_it {
        return None;
    }
    let git = |args: &[&str]| {
        let mut command = Command::new("git");
        let output = command.arg("-C").arg(project).args(args).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let status = git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat())?;
    Some(if status.is_empty() {
        commit
    } else {
        format!("{commit}+")
    })
}

/// Latest modification time of a file, or of the files in a folder.
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
    humantime::format_rfc3339_seconds(SystemTime::now()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_has_processors() {
        let machine = machine();
        assert!(
            machine.cores > 0 && !machine.system.is_empty(),
            "{machine:?}"
        );
    }
}
