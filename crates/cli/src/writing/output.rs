//! Output of results: checked before the work starts, written completely or not at all.
//!
//! A file is written next to its destination under a temporary name and then renamed. A reader never finds a partial file, an older file
//! survives a failure, and processes that write the same file do not interfere: the last to finish wins, on one machine or on
//! several that share a folder. Devices and pipes cannot be replaced by renaming; they are written directly.

use std::collections::BTreeSet;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use cutaway::{Error, Result};
use cutaway_io::load::place_of;

use super::places::is_special;

/// A destination.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// Standard output.
    Stdout,
    File(PathBuf),
}

impl Output {
    /// Checks the destination given by an option's value. `extensions` are the allowed ones; an empty list allows any.
    pub(crate) fn checked(option: &str, value: &str, extensions: &[&str]) -> Result<Self> {
        if value == "-" {
            return Ok(Self::Stdout);
        }
        let culprit = || format!("{option} {value}");
        let path = PathBuf::from(value);
        let place = place_of(&path);
        if place.is_dir() || value.is_empty() || value.ends_with(std::path::MAIN_SEPARATOR) {
            let help = "give the name of a file, or `-` for standard output";
            return Err(Error::input(culprit(), "it is a folder", help));
        }
        let extension = path.extension().map(|e| e.to_ascii_lowercase());
        let known = |e: &&str| extension.as_ref().is_some_and(|have| have == e);
        if !extensions.is_empty() && !is_special(&place) && !extensions.iter().any(known) {
            let list: Vec<String> = extensions.iter().map(|e| format!(".{e}")).collect();
            return Err(Error::input(
                culprit(),
                "the extension is not a format that can be written here",
                format!("let the name end in {}", list.join(" or ")),
            ));
        }
        check_folder(&culprit(), folder_of(&place))?;
        Ok(Self::File(path))
    }

    /// Writes all bytes.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<()> {
        match self {
            Self::Stdout => write_stdout(bytes),
            Self::File(path) => write_file(path, bytes),
        }
    }

    /// The file, if it is one.
    pub(crate) fn path(&self) -> Option<&Path> {
        match self {
            Self::Stdout => None,
            Self::File(path) => Some(path),
        }
    }
}

/// Checks a folder into which several files are to be written; the folder is created later if it is missing.
pub(crate) fn checked_folder(option: &str, path: &Path) -> Result<()> {
    let culprit = format!("{option} {}", path.display());
    let place = place_of(path);
    if place.exists() && !place.is_dir() {
        let help = "give the name of a folder; it is created if it is missing";
        return Err(Error::input(culprit, "it is a file, not a folder", help));
    }
    check_folder(&culprit, &place)
}

/// Writes text or bytes to standard output. A closed pipe, as after `head`, is not an error.
pub(crate) fn write_stdout(bytes: &[u8]) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Error::input(
            "standard output",
            format!("cannot be written: {e}"),
            "check where it is redirected",
        )),
        _ => Ok(()),
    }
}

/// Writes a file completely or not at all, creating its folder. Until it is complete, and after a failure, readers find the old file.
///
/// # Errors
///
/// A path that cannot be written, or a full disk.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    begun_with(path, bytes)?.place()
}

/// A complete file, not yet at its destination.
pub(crate) fn begun_with(path: &Path, bytes: &[u8]) -> Result<Pending> {
    let (pending, mut file) = Pending::begin(path)?;
    file.write_all(bytes).map_err(|e| pending.failed(&e))?;
    Ok(pending)
}

/// Unfinished files, to be removed when Ctrl-C ends the process without running destructors.
static PENDING: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn pending_files() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all unfinished files, before the process ends at once.
pub(crate) fn remove_pending() {
    for beside in &*pending_files() {
        // An error cannot be reported any more.
        let _ = fs::remove_file(beside);
    }
}

/// A file that is written step by step next to its destination and renamed at the end. If it is dropped before that, the file and the
/// folders created for it are removed.
pub(crate) struct Pending {
    /// Destination, as given by the user.
    path: PathBuf,
    place: PathBuf,
    beside: PathBuf,
    /// Folders created for it, the innermost first.
    made: Vec<PathBuf>,
    is_placed: bool,
}

impl Pending {
    /// Begins a file, creating its folder. Write through the handle and close it before [`Pending::place`].
    pub(crate) fn begin(path: &Path) -> Result<(Self, fs::File)> {
        // A symbolic link is followed: the file that it points to is replaced, not the link.
        let place = place_of(path);
        let path = path.to_owned();
        let fault = |e: std::io::Error| cannot_write(&path, &e);
        if is_special(&place) {
            let file = fs::OpenOptions::new().write(true).open(&place);
            let file = file.map_err(fault)?;
            let pending = Self {
                path,
                beside: place.clone(),
                place,
                made: Vec::new(),
                is_placed: true,
            };
            return Ok((pending, file));
        }
        let folder = folder_of(&place);
        let missing = folder.ancestors().take_while(|above| !above.exists());
        let made = missing.map(Path::to_owned).collect();
        fs::create_dir_all(folder).map_err(fault)?;
        let (file, beside) = unnamed(&place, folder).map_err(fault)?;
        pending_files().insert(beside.clone());
        let pending = Self {
            path,
            place,
            beside,
            made,
            is_placed: false,
        };
        Ok((pending, file))
    }

    /// Temporary path of the file until it is complete.
    pub(crate) fn beside(&self) -> &Path {
        &self.beside
    }

    /// Error for a failed write.
    pub(crate) fn failed(&self, e: &std::io::Error) -> Error {
        cannot_write(&self.path, e)
    }

    /// Flushes the file to disk: network file systems report a full disk only now.
    pub(crate) fn sync(&self) -> Result<()> {
        if self.is_placed {
            return Ok(());
        }
        let opened = fs::OpenOptions::new().append(true).open(&self.beside);
        let synced = opened.and_then(|file| file.sync_all());
        synced.map_err(|e| self.failed(&e))
    }

    /// Moves the complete file to its destination.
    pub(crate) fn place(self) -> Result<()> {
        self.sync()?;
        self.place_synced()
    }

    /// As [`Pending::place`], for a file that is already flushed to disk.
    pub(crate) fn place_synced(mut self) -> Result<()> {
        if self.is_placed {
            return Ok(());
        }
        fs::rename(&self.beside, &self.place).map_err(|e| self.failed(&e))?;
        self.is_placed = true;
        Ok(())
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        pending_files().remove(&self.beside);
        if !self.is_placed {
            // An earlier error is being reported; if the removal fails too, that error stays the more useful one.
            let _ = fs::remove_file(&self.beside);
            // A folder that is no longer empty stays.
            let _ = self.made.iter().try_for_each(fs::remove_dir);
        }
    }
}

/// Number of leading characters of the file name kept in its temporary name; each takes at most four bytes.
const MOST_OF_NAME: usize = 50;

/// Creates a file next to a path, under a name unique across processes; process ids alone repeat across machines and containers.
fn unnamed(path: &Path, folder: &Path) -> std::io::Result<(fs::File, PathBuf)> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut builder = tempfile::Builder::new();
    // Give the file the default permissions of the process's umask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // File systems allow names of at most 255 bytes.
    let begin: String = name.chars().take(MOST_OF_NAME).collect();
    let prefix = format!(".{begin}.");
    let file = builder.prefix(&prefix).suffix(".tmp").tempfile_in(folder)?;
    Ok(file.keep()?)
}

fn cannot_write(path: &Path, e: &std::io::Error) -> Error {
    Error::file(
        path,
        format!("cannot be written: {e}"),
        "check the folder's permissions and the free disk space",
    )
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Checks that files can be created in a folder, or that the folder can be created. The test file in an existing folder has no
/// name, so that nothing is left behind even if the process ends here.
pub(crate) fn check_folder(culprit: &str, folder: &Path) -> Result<()> {
    let there = folder
        .ancestors()
        .find(|a| a.as_os_str().is_empty() || a.exists());
    let there = there
        .filter(|a| !a.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let refuse = |what: String| {
        let help = "name a folder that you may write to";
        Err(Error::input(culprit, what, help))
    };
    if !there.is_dir() {
        return refuse(format!("{} is a file, not a folder", there.display()));
    }
    match tempfile::tempfile_in(there) {
        Ok(_) => Ok(()),
        Err(e) => refuse(format!(
            "nothing can be written to {}: {e}",
            there.display()
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("cutaway-output-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_file_is_replaced_whole_and_nothing_stays_behind() {
        let folder = scratch("whole");
        let path = folder.join("deep/er/out.json");
        for text in ["first", "2"] {
            write_file(&path, text.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        let left = fs::read_dir(path.parent().unwrap()).unwrap().count();
        assert_eq!(left, 1, "only the file itself");
        drop(Pending::begin(&folder.join("deep/too/deep/out.json")).unwrap());
        let left = fs::read_dir(folder.join("deep")).unwrap().count();
        assert_eq!(left, 1, "the folders of a file that is dropped are gone");
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn bad_destinations_are_refused_before_anything_is_made() {
        let folder = scratch("bad");
        let file = folder.join("file");
        fs::write(&file, "x").unwrap();
        let inside = file.join("out.png");
        for (value, said) in [
            (folder.to_str().unwrap(), "folder"),
            ("picture.gif", ".png"),
            ("picture", ".png"),
            (inside.to_str().unwrap(), "is a file"),
        ] {
            let message = Output::checked("--output", value, &["png"])
                .unwrap_err()
                .to_string();
            assert!(message.contains(said), "{message}");
            assert!(message.contains("--output"), "{message}");
        }
        assert!(
            checked_folder("--out", &file).is_err(),
            "a file is no folder"
        );
        assert!(!folder.join("new").exists(), "checking makes nothing");
        checked_folder("--out", &folder.join("new")).unwrap();
        assert!(!folder.join("new").exists(), "checking makes nothing");
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = scratch("link");
        let (target, link) = (folder.join("target"), folder.join("link"));
        fs::write(&target, "old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write_file(&link, b"new").unwrap();
        assert_eq!(fs::read_to_string(&target).unwrap(), "new");
        assert!(
            fs::symlink_metadata(&link).unwrap().is_symlink(),
            "the link is gone"
        );
        fs::remove_dir_all(folder).unwrap();
    }
}
