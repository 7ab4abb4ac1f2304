//! Files that were opened last, in a small text of the user: a line for each, the newest first.
//!
//! It is read again before it is written, for another window may have written it.

use std::path::{Path, PathBuf};
use std::{env, fs};

use cutaway::{Error, Result};

use crate::disk;

/// So many are kept.
const MOST: usize = 8;

/// The files that were opened last.
#[derive(Clone, Debug)]
pub struct Recent {
    file: PathBuf,
    paths: Vec<PathBuf>,
}

impl Recent {
    /// Where the text is: in `$XDG_STATE_HOME`, or in `~/.local/state`; nowhere without a home.
    pub fn usual_file() -> Option<PathBuf> {
        let folder = |name: &str| {
            env::var_os(name)
                .map(PathBuf::from)
                .filter(|f| f.is_absolute())
        };
        let state = folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")));
        Some(state?.join("cutaway/recent"))
    }

    /// Reads a text; one that is not there has no files.
    pub fn read(file: impl Into<PathBuf>) -> Self {
        let file = file.into();
        let paths = lines_of(&file);
        Self { file, paths }
    }

    /// The files, the newest first.
    pub fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Puts a file first.
    ///
    /// # Errors
    ///
    /// A text that cannot be written.
    pub fn add(&mut self, path: &Path) -> Result<()> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.change(|paths| {
            paths.retain(|held| *held != path);
            paths.insert(0, path);
            paths.truncate(MOST);
        })
    }

    /// Leaves a file out.
    ///
    /// # Errors
    ///
    /// A text that cannot be written.
    pub fn forget(&mut self, path: &Path) -> Result<()> {
        self.change(|paths| paths.retain(|held| held != path))
    }

    fn change(&mut self, change: impl FnOnce(&mut Vec<PathBuf>)) -> Result<()> {
        let mut paths = lines_of(&self.file);
        change(&mut paths);
        self.paths = paths;
        let lines = self
            .paths
            .iter()
            .map(|path| format!("{}\n", path.display()));
        let text: String = lines.collect();
        if let Some(folder) = self.file.parent() {
            fs::create_dir_all(folder).map_err(|e| {
                let help = "make the folder, or set $XDG_STATE_HOME to one that can be written";
                Error::file(folder, format!("cannot be made: {e}"), help)
            })?;
        }
        disk::write_whole(&self.file, text.as_bytes())
    }
}

/// The files that a text names.
fn lines_of(file: &Path) -> Vec<PathBuf> {
    let text = fs::read_to_string(file).unwrap_or_default();
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    lines.map(PathBuf::from).take(MOST).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_eight_are_kept_and_two_windows_lose_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("state/cutaway/recent");
        let mut recent = Recent::read(&file);
        assert!(recent.paths().is_empty(), "there is no text");
        let mut other = Recent::read(&file);
        other.add(Path::new("/a/other.stl")).expect("written");
        for number in [0, 1, 2, 3, 1] {
            let path = format!("/a/{number}.stl");
            recent.add(Path::new(&path)).expect("written");
        }
        let names = |recent: &Recent| -> Vec<String> {
            let names = recent.paths().iter().filter_map(|p| p.file_name());
            names.map(|n| n.to_string_lossy().into_owned()).collect()
        };
        assert_eq!(
            names(&recent),
            ["1.stl", "3.stl", "2.stl", "0.stl", "other.stl"]
        );
        recent.forget(Path::new("/a/3.stl")).expect("written");
        assert_eq!(names(&Recent::read(&file)).len(), 4, "and it is written");
        for number in 10..20 {
            let path = format!("/a/{number}.stl");
            recent.add(Path::new(&path)).expect("written");
        }
        assert_eq!(names(&recent).len(), MOST);
        assert_eq!(names(&recent)[0], "19.stl");
    }
}
