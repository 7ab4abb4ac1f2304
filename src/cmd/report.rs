//! `report`: pages and tables of what was measured. Needs no graphics adapter.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Verdict;
use super::console::{Console, ConsoleArgs};
use super::output::{checked_folder, write_file, write_stdout};
use super::places::InputFiles;
use crate::Result;
use crate::report::{PictureOptions, Recorded, pages};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway report target/measure
  cutaway report laptop/ server/ --out both/
  cutaway report target/measure --link
  cutaway report shared/mine --complete      # exit code 1 while shares are missing

Writes report.html (one file, opens from disk, fetches nothing), report.md, report.csv (one row for each point and
strategy) and report.json (all records).";

/// Options of `report`.
#[derive(Args)]
pub(super) struct ReportArgs {
    /// Folders of runs, as `cutaway measure --out DIR` writes them
    #[arg(required = true, value_name = "DIR")]
    pub(super) folders: Vec<PathBuf>,
    /// Folder for the report [default: the first folder]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Leave the pictures in their files, and link to them
    #[arg(long)]
    pub(super) link: bool,
    /// Exit code 1 where points are missing that the experiments ask for
    #[arg(long)]
    pub(super) complete: bool,
    #[command(flatten)]
    pub(super) console: ConsoleArgs,
}

/// Missing points that are named.
const MOST_NAMED: usize = 10;

/// The files of a report.
const NAMES: [&str; 4] = ["report.html", "report.md", "report.csv", "report.json"];

/// The files of the folders in a folder of a run: records and their pictures. Beside `run.json` an earlier report may be.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let of = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.map(|e| e.path()).collect::<Vec<_>>()
    };
    // Other folders are of something else, of an earlier report perhaps.
    let is_read =
        |path: &PathBuf| path.ends_with("peers") || path.join("experiment.json").is_file();
    let folders = of(folder).into_iter().filter(is_read);
    let records = folders.flat_map(|folder| of(&folder));
    let is_run = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("run.") && name.ends_with(".json")
    };
    let all = records.chain(of(folder).into_iter().filter(is_run));
    all.filter(|path| path.is_file()).collect()
}

/// Runs `report`.
pub(super) fn run(args: &ReportArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 3);
    console.step("reading records");
    let out = args.out.as_ref().unwrap_or(&args.folders[0]);
    let inputs = InputFiles::default();
    inputs.add(args.folders.iter().flat_map(|folder| files_below(folder)));
    inputs.keep_from(NAMES.map(|name| ("--out", out.join(name))))?;
    let recorded = Recorded::read(&args.folders)?;
    checked_folder("--out", out)?;
    console.step("making pages");
    let pages = pages(
        &recorded,
        &PictureOptions {
            out: out.clone(),
            link: args.link,
            most_bytes: PictureOptions::MOST_BYTES,
        },
    );
    console.step("writing");
    let mut written = String::new();
    let texts = [&pages.html, &pages.markdown, &pages.csv, &pages.json];
    for (name, text) in NAMES.into_iter().zip(texts) {
        let path = out.join(name);
        write_file(&path, text.as_bytes())?;
        written.push_str(&format!("{}\n", path.display()));
    }
    let (there, asked, missing) = recorded.completeness();
    let mut verdict = Verdict::Done;
    if !missing.is_empty() {
        let named = missing[..missing.len().min(MOST_NAMED)].join(", ");
        let more = match missing.len().saturating_sub(MOST_NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let text = format!("{there} of {asked} points; missing: {named}{more}");
        if args.complete {
            console.failed(text);
            verdict = Verdict::Failed;
        } else {
            console.note(text);
        }
    }
    drop(console);
    write_stdout(written.as_bytes())?;
    Ok(verdict)
}
