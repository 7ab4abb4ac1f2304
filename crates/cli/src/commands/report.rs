//! `report`: pages and tables of measured results. Needs no graphics adapter.

use std::path::{Path, PathBuf};

use clap::Args;
use cutaway::Result;
use cutaway_lab::experiment::Run;
use cutaway_lab::report::{PictureOptions, RecordedFolders, method_pages, pages};

use crate::console::{Console, ConsoleArgs};
use crate::verdict::Verdict;
use crate::writing::output::{Output, checked_folder, write_stdout};
use crate::writing::places::InputFiles;
use crate::writing::results::Results;

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway report target/measure
  cutaway report laptop/ server/ --out both/
  cutaway report target/measure --link
  cutaway report shared/mine --complete      # exit code 1 while shares are missing
  cutaway report target/measure --method planar
  cutaway report target/measure/peers        # what other tools found, alone

Writes report.html (one file, opens from disk, fetches nothing), report.md, report.csv (one row for each point and
strategy) and report.json (all records). With --method it writes method-NAME.html and method-NAME.md instead.";

/// Options of `report`.
#[derive(Args)]
pub(crate) struct ReportArgs {
    /// Folders of runs, as `cutaway measure --out DIR` writes them, or folders that contain only outside baselines
    #[arg(required = true, value_name = "DIR")]
    pub(crate) folders: Vec<PathBuf>,
    /// Folder for the report [default: the first folder]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Link to the picture files instead of embedding them
    #[arg(long)]
    pub(crate) link: bool,
    /// Report one method at all points: its errors, times, memory, and the points it refuses, with reasons
    #[arg(long, value_name = "NAME", conflicts_with = "link")]
    pub(crate) method: Option<String>,
    /// Exit with 1 if points that the experiments define are missing
    #[arg(long)]
    pub(crate) complete: bool,
    #[command(flatten)]
    pub(crate) console: ConsoleArgs,
}

/// Maximum number of missing points listed by name.
const MOST_NAMED: usize = 10;

/// The files of a report.
const NAMES: [&str; 4] = ["report.html", "report.md", "report.csv", "report.json"];

/// The files in the subfolders of a run's folder: records and their pictures. An earlier report may be in the folder itself.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let of = |folder: &Path| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.map(|e| e.path()).collect::<Vec<_>>()
    };
    // Other folders are unrelated, perhaps from an earlier report.
    let is_read =
        |path: &PathBuf| path.ends_with("peers") || path.join("experiment.json").is_file();
    let folders = of(folder).into_iter().filter(is_read);
    let records = folders.flat_map(|folder| of(&folder));
    let is_run = |path: &PathBuf| Run::is_file(path);
    let is_alone = !of(folder).iter().any(is_run);
    // A folder without a run may contain outside baselines.
    let is_baseline = |path: &PathBuf| is_alone && path.extension().is_some_and(|e| e == "json");
    let own = of(folder).into_iter();
    let own = own.filter(|path| {
        (is_run(path) || is_baseline(path)) && !NAMES.iter().any(|n| path.ends_with(n))
    });
    records.chain(own).filter(|path| path.is_file()).collect()
}

/// A method's file name without extension: `method-grid-256+vds-1024`.
fn stem_of(method: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '.' | '-' | '_');
    let letters = method.chars().map(|c| if is_plain(c) { c } else { '-' });
    format!("method-{}", letters.collect::<String>())
}

/// Runs `report`.
pub(crate) fn run(args: &ReportArgs) -> Result<Verdict> {
    let console = Console::new(args.console, 3);
    console.step("reading records");
    let out = args.out.as_ref().unwrap_or(&args.folders[0]);
    let names: Vec<String> = match &args.method {
        None => NAMES.map(str::to_owned).into(),
        Some(method) => ["html", "md"]
            .map(|e| format!("{}.{e}", stem_of(method)))
            .into(),
    };
    let inputs = InputFiles::default();
    inputs.add(args.folders.iter().flat_map(|folder| files_below(folder)));
    inputs.keep_from(names.iter().map(|name| ("--out", out.join(name))))?;
    let recorded = RecordedFolders::read(&args.folders)?;
    console.step("making pages");
    let texts = match &args.method {
        None => all_of(&recorded, args, out),
        Some(method) => {
            let pages = method_pages(&recorded, method)?;
            vec![pages.html, pages.markdown]
        }
    };
    checked_folder("--out", out)?;
    console.step("writing");
    let (mut written, mut results) = (String::new(), Results::default());
    for (name, text) in names.iter().zip(texts) {
        let path = out.join(name);
        written.push_str(&format!("{}\n", path.display()));
        results.add(&Output::File(path), text.into_bytes())?;
    }
    results.place()?;
    let verdict = completeness(&recorded, args, &console);
    drop(console);
    write_stdout(written.as_bytes())?;
    Ok(verdict)
}

/// Contents of the files named in [`NAMES`].
fn all_of(recorded: &RecordedFolders, args: &ReportArgs, out: &Path) -> Vec<String> {
    let options = PictureOptions {
        out: out.to_owned(),
        link: args.link,
        most_bytes: PictureOptions::MOST_BYTES,
    };
    let pages = pages(recorded, &options);
    vec![pages.html, pages.markdown, pages.csv, pages.json]
}

/// Warns of missing points.
fn completeness(recorded: &RecordedFolders, args: &ReportArgs, console: &Console) -> Verdict {
    let (there, asked, missing) = recorded.completeness();
    if missing.is_empty() {
        return Verdict::Done;
    }
    let named = missing[..missing.len().min(MOST_NAMED)].join(", ");
    let more = match missing.len().saturating_sub(MOST_NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let text = format!("{there} of {asked} points; missing: {named}{more}");
    if args.complete {
        console.failed(text);
        return Verdict::Failed;
    }
    console.note(text);
    Verdict::Done
}
