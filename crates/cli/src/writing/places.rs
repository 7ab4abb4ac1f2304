//! Checks that no result replaces an input or another result, before anything is drawn or written.
//!
//! Two names denote one file if they lead to it through `..`, symbolic links or hard links, even if a folder on the
//! path does not exist yet: names are compared by the paths that they will resolve to ([`place_of`]).

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use cutaway::{Error, Result};
use cutaway_io::load::place_of;
use same_file::is_same_file;

use super::output::Output;

/// The input files of a command, added by several threads.
#[derive(Debug, Default)]
pub(crate) struct InputFiles(Mutex<BTreeSet<PathBuf>>);

impl InputFiles {
    /// Adds input files.
    pub(crate) fn add(&self, files: impl IntoIterator<Item = PathBuf>) {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.extend(files);
    }

    /// All input files, sorted by name.
    pub(crate) fn all(&self) -> Vec<PathBuf> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        all.iter().cloned().collect()
    }

    /// Rejects outputs that would replace an input or one another. Each output is given by its option and its file.
    pub(crate) fn keep_from<'a>(
        &self,
        outputs: impl IntoIterator<Item = (&'a str, PathBuf)>,
    ) -> Result<()> {
        let inputs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut places = BTreeMap::new();
        for (option, path) in outputs {
            let place = place_of(&path);
            if is_special(&place) {
                continue;
            }
            let culprit = || format!("{option} {}", path.display());
            let is_there = place.exists();
            let replaced = inputs
                .iter()
                .find(|input| is_there && is_one_file(input, &place));
            if let Some(input) = replaced {
                let what = if *input == path {
                    "it is an input of this command, and would be overwritten".to_owned()
                } else {
                    format!(
                        "it is the input {}, which would be overwritten",
                        input.display()
                    )
                };
                let help = "write to another file: an output never replaces an input";
                return Err(Error::input(culprit(), what, help));
            }
            if let Some(first) = places.insert(place, option) {
                let what = format!("it is also the file of {first}");
                return Err(Error::input(culprit(), what, "give each its own name"));
            }
        }
        Ok(())
    }
}

/// Checks that results have different destinations: at most one goes to standard output, and no file replaces another.
pub(crate) fn no_place_twice(outputs: &[(&str, Option<&Output>)]) -> Result<()> {
    InputFiles::default().keep_from(paths_of(outputs))?;
    let taken: Vec<&str> = outputs
        .iter()
        .filter(|(_, o)| *o == Some(&Output::Stdout))
        .map(|(option, _)| *option)
        .collect();
    match taken.as_slice() {
        [_, second, ..] => Err(Error::input(
            format!("{second} -"),
            format!("standard output already carries {}", taken[0]),
            "write one of them to a file",
        )),
        _ => Ok(()),
    }
}

/// The outputs that are files.
pub(crate) fn paths_of<'a>(
    outputs: &[(&'a str, Option<&Output>)],
) -> impl Iterator<Item = (&'a str, PathBuf)> {
    outputs.iter().filter_map(|(option, output)| {
        let path = output.and_then(Output::path)?;
        Some((*option, path.to_owned()))
    })
}

/// Returns true if two names lead to one existing file, through symbolic or hard links. Compares file lengths first, which is cheap.
pub fn is_one_file(a: &Path, b: &Path) -> bool {
    let length = |path: &Path| fs::metadata(path).ok().map(|m| m.len());
    let lengths = (length(a), length(b));
    matches!(lengths, (Some(a), Some(b)) if a == b) && is_same_file(a, b).unwrap_or(false)
}

/// Returns true for a device or a pipe, which is never replaced.
pub(crate) fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_output_carries_one_result() {
        let (file, stdout) = (Output::File("a".into()), Output::Stdout);
        assert!(no_place_twice(&[("-o", Some(&file)), ("--json", Some(&stdout))]).is_ok());
        assert!(no_place_twice(&[("-o", None), ("--json", Some(&stdout))]).is_ok());
        let both = no_place_twice(&[("-o", Some(&stdout)), ("--json", Some(&stdout))]);
        assert!(both.unwrap_err().to_string().contains("--json -"));
    }

    #[test]
    fn no_result_replaces_another() {
        let plain = Output::File("a".into());
        for same in ["./a", "nowhere/../a", "no/where/.././../a"] {
            let other = Output::File(same.into());
            let message = no_place_twice(&[("-o", Some(&plain)), ("--json", Some(&other))])
                .unwrap_err()
                .to_string();
            assert!(message.contains("the file of -o"), "{message}");
        }
        let other = Output::File("b/a".into());
        assert!(no_place_twice(&[("-o", Some(&plain)), ("--json", Some(&other))]).is_ok());
        assert!(no_place_twice(&[("-o", None), ("--json", None)]).is_ok());
    }
}
