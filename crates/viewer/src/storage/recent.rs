//! The list of recently opened files: a small text file per user, with one file per line, the newest first.
//!
//! The list is read again before it is written, because another window may have changed it. It is written completely or not at all. Windows
//! that write at the same time take turns by locking a file next to the list. A window waits at most 0.1 s for the lock.
//!
//! Cannot: store a name with a line break or, on systems other than Unix, a name that is not Unicode.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs, thread};

use cutaway::{Error, Result};
use cutaway_cli::write_file;

/// Maximum number of files kept.
const MOST: usize = 8;

/// Maximum number of attempts to take the lock, and the delay after each attempt.
const TRIES: usize = 20;
const BETWEEN_TRIES: Duration = Duration::from_millis(5);

/// The recently opened files.
#[derive(Clone, Debug)]
pub struct Recent {
    file: PathBuf,
    paths: Vec<PathBuf>,
}

impl Recent {
    /// Default path of the list: in `$XDG_STATE_HOME`, or else in `~/.local/state`; `None` if there is no home directory.
    pub fn usual_file() -> Option<PathBuf> {
        let folder = |name: &str| {
            env::var_os(name)
                .map(PathBuf::from)
                .filter(|f| f.is_absolute())
        };
        let state = folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")));
        Some(state?.join("cutaway/recent"))
    }

    /// Reads the list from a file; if there is no such file, the list is empty.
    pub fn read(file: impl Into<PathBuf>) -> Self {
        let file = file.into();
        let paths = lines_of(&file);
        Self { file, paths }
    }

    /// The files, the newest first.
    pub fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Puts a file at the front of the list.
    ///
    /// # Errors
    ///
    /// The list cannot be written.
    pub fn add(&mut self, path: &Path) -> Result<()> {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.change(|paths| {
            paths.retain(|held| *held != path);
            paths.insert(0, path);
            paths.truncate(MOST);
        })
    }

    /// Removes a file from the list.
    ///
    /// # Errors
    ///
    /// The list cannot be written.
    pub fn forget(&mut self, path: &Path) -> Result<()> {
        self.change(|paths| paths.retain(|held| held != path))
    }

    fn change(&mut self, change: impl FnOnce(&mut Vec<PathBuf>)) -> Result<()> {
        if let Some(folder) = self.file.parent() {
            fs::create_dir_all(folder).map_err(|e| {
                let help = "create the folder, or set $XDG_STATE_HOME to a writable folder";
                Error::file(folder, format!("cannot be created: {e}"), help)
            })?;
        }
        let _lock = locked(&self.file.with_extension("lock"));
        let mut paths = lines_of(&self.file);
        change(&mut paths);
        self.paths = paths;
        let bytes: Vec<u8> = self.paths.iter().flat_map(|path| line_of(path)).collect();
        write_file(&self.file, &bytes)
    }
}

/// Takes the lock that makes windows take turns; `None` if it stays taken, in which case the list is written all the same.
fn locked(file: &Path) -> Option<fs::File> {
    let file = fs::File::create(file).ok()?;
    for _ in 0..TRIES {
        if file.try_lock().is_ok() {
            return Some(file);
        }
        thread::sleep(BETWEEN_TRIES);
    }
    None
}

/// The line of the list for a file; empty for a name with a line break.
fn line_of(path: &Path) -> Vec<u8> {
    #[cfg(unix)]
    let name = std::os::unix::ffi::OsStrExt::as_bytes(path.as_os_str()).to_vec();
    #[cfg(not(unix))]
    let name = path.to_string_lossy().into_owned().into_bytes();
    match name.contains(&b'\n') {
        true => Vec::new(),
        false => [name, b"\n".to_vec()].concat(),
    }
}

/// The files in a stored list.
fn lines_of(file: &Path) -> Vec<PathBuf> {
    let text = fs::read(file).unwrap_or_default();
    let lines = text.split(|byte| *byte == b'\n');
    let lines = lines.map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    let named = lines.filter(|line| !line.trim_ascii().is_empty());
    named.filter_map(path_of).take(MOST).collect()
}

/// The file that a line of the list names.
fn path_of(line: &[u8]) -> Option<PathBuf> {
    #[cfg(unix)]
    let name: Option<&OsStr> = Some(std::os::unix::ffi::OsStrExt::from_bytes(line));
    #[cfg(not(unix))]
    let name = std::str::from_utf8(line).ok().map(OsStr::new);
    name.map(PathBuf::from)
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
    #[test]
    fn windows_that_write_at_once_lose_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("recent");
        thread::scope(|scope| {
            for window in 0..4 {
                let mut recent = Recent::read(&file);
                scope.spawn(move || {
                    for number in 0..2 {
                        let path = format!("/a/{window}-{number}.stl");
                        recent.add(Path::new(&path)).expect("written");
                    }
                });
            }
        });
        assert_eq!(Recent::read(&file).paths().len(), MOST);
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_no_unicode_is_found_again() {
        use std::os::unix::ffi::OsStrExt;

        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("recent");
        let name = Path::new(OsStr::from_bytes(b"/a/caf\xe9 .stl"));
        let mut recent = Recent::read(&file);
        recent.add(name).expect("written");
        recent.add(Path::new("/a/two\nlines.stl")).expect("written");
        assert_eq!(Recent::read(&file).paths(), [name]);
    }
}
