//! `report`: pages and tables of what was measured. Needs no graphics adapter.

use std::path::PathBuf;

use clap::Args;

use super::Verdict;
use super::console::{Console, ConsoleArgs};
use super::output::{checked_folder, write_file, write_stdout};
use crate::Result;
use crate::report::{PictureOptions, Recorded, pages};

pub(super) const EXAMPLES: &str = "\
Examples:
  cutaway report target/measure
  cutaway report laptop/ server/ --out both/
  cutaway report target/measure --link

Writes report.html (one file, opens from disk, fetches nothing), report.md, report.csv (one row for each point and
strategy) and report.json (all records).";

/// Options of `report`.
#[derive(Args)]
pub(super) struct ReportArgs {
    /// Folders of runs, as `cutaway measure --out DIR` writes them
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
    /// Folder for the report [default: the first folder]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave the pictures in their files, and link to them
    #[arg(long)]
    link: bool,
    #[command(flatten)]
    console: ConsoleArgs,
}

/// Runs `report`.
pub(super) fn run(args: &ReportArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 3);
    console.step("reading records");
    let recorded = Recorded::read(&args.folders)?;
    let out = args.out.as_ref().unwrap_or(&args.folders[0]);
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
    for (name, text) in [
        ("report.html", &pages.html),
        ("report.md", &pages.markdown),
        ("report.csv", &pages.csv),
        ("report.json", &pages.json),
    ] {
        let path = out.join(name);
        write_file(&path, text.as_bytes())?;
        written.push_str(&format!("{}\n", path.display()));
    }
    drop(console);
    write_stdout(written.as_bytes())?;
    Ok(Verdict::Done)
}
