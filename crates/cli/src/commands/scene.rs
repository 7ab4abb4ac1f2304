//! `scene`: the values that a scene file can contain.

use clap::Args;
use cutaway::{Error, Result};
use cutaway_io::document::paths::{self, Path};
use serde_json::json;

use crate::verdict::Verdict;
use crate::writing::output::{Output, write_stdout};

pub(crate) const EXAMPLES: &str = "\
Examples:
  cutaway scene                 # everything
  cutaway scene camera          # what has a camera in its path
  cutaway render scene.toml --set camera.azimuth_deg=20 --set part.crank.material.color=#f80 -o other.png
  cutaway render bracket.stl --section x=50% --save bracket.toml -o cut.png     # the options as a file

A * stands for the name of an entry, or its number from 0. A value marked `moves` can be the target of a `[[key]]`; percentages
refer to the bounds or to their diagonal.";

/// Options of `scene`.
#[derive(Args)]
pub(crate) struct SceneCommandArgs {
    /// List only paths that contain this text
    part: Option<String>,
    /// The list as JSON
    #[arg(long, value_name = "FILE|-", help_heading = "Output")]
    json: Option<String>,
}

/// Runs `scene`.
pub(crate) fn run(args: &SceneCommandArgs) -> Result<Verdict> {
    let json = args.json.as_ref();
    let json = json
        .map(|v| Output::checked("--json", v, &[]))
        .transpose()?;
    let is_asked = |p: &&Path| args.part.as_ref().is_none_or(|part| has(&p.path, part));
    let asked: Vec<&Path> = paths::all().iter().filter(is_asked).collect();
    if let (true, Some(part)) = (asked.is_empty(), &args.part) {
        let help =
            "`cutaway scene` lists them all; names and numbers of parts and cuts are `*` there";
        return Err(Error::input(part, "no path contains this", help));
    }
    if let Some(output) = &json {
        let all: Vec<_> = (asked.iter())
            .map(|p| {
                json!({
                    "path": p.path,
                    "takes": p.takes.to_string(),
                    "unit": p.unit,
                    "moves": p.moves,
                    "example": p.example,
                    "help": p.help,
                })
            })
            .collect();
        output.write(format!("{:#}\n", json!(all)).as_bytes())?;
    }
    if json != Some(Output::Stdout) {
        write_stdout(listed(asked.into_iter()).as_bytes())?;
    }
    Ok(Verdict::Done)
}

/// Returns true if a path contains `part`, in which any name matches `*`: `part.0.scale`, `cut.front`.
fn has(path: &str, part: &str) -> bool {
    let part = part.to_lowercase();
    let (known, asked): (Vec<_>, Vec<_>) = (path.split('.').collect(), part.split('.').collect());
    let fits = |window: &[&str]| {
        let pairs = window.iter().zip(&asked).enumerate();
        let last = asked.len() - 1;
        asked.len() > 1
            && pairs
                .into_iter()
                .all(|(at, (k, a))| k == a || *k == "*" || (at == last && k.starts_with(a)))
    };
    path.contains(&part) || known.windows(asked.len()).any(fits)
}

/// The list, with the examples of `help scene`.
pub(crate) fn long_help() -> String {
    format!("{}\n{EXAMPLES}", listed(paths::all().iter()))
}

/// Two lines per path: the values that it takes, and its meaning.
fn listed<'a>(paths: impl Iterator<Item = &'a Path>) -> String {
    let mut text = String::new();
    for p in paths {
        let moves = if p.moves { ", moves" } else { "" };
        let (path, takes) = (&p.path, p.takes.with_unit(p.unit));
        text.push_str(&format!("{path}: {takes}{moves}\n"));
        text.push_str(&format!("    {}; {}\n", p.help, p.example));
    }
    text
}
