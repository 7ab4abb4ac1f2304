//! Sources of file contents: the disk, or memory, for a host without a disk such as a web page.
//!
//! Loaders and scene documents read whole files by path, through [`Files`]. Apart from that they only check whether a file exists. They
//! never list a folder. A host that has to fetch files first gets their names from [`Document::files`](crate::Document::files).
//!
//! Memory cost: one file for each reading thread. Bytes that are already in memory are borrowed, not copied.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::fs;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::place::walked;

/// Largest size in bytes of a file, and of the content of a packed file. It is enough for some 100 million triangles of binary STL, and the
/// data built from them still fits into a workstation's memory.
pub const MOST_BYTES: u64 = 8 << 30;

/// Files by path.
pub trait Files: fmt::Debug + Send + Sync {
    /// Returns the bytes of a file.
    ///
    /// # Errors
    ///
    /// The error's text is shown after `FILE: cannot be read:`, and its kind selects the help text. [`ErrorKind::NotFound`] means that
    /// there is no such file, [`ErrorKind::PermissionDenied`] that it may not be read.
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>>;

    /// Returns true if a file of this name exists.
    fn is_file(&self, path: &Path) -> bool;

    /// Returns true if `path` is by its text within the folder of the file `from`, but symbolic links lead out of that folder. A
    /// store without links keeps the default.
    fn leads_out(&self, _path: &Path, _from: &Path) -> bool {
        false
    }
}

/// The files on disk. Only regular files of up to 8 GiB are read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Disk;

impl Disk {
    /// The length of a regular file. Other kinds of file are refused, because reading a device or a pipe might never end.
    pub(super) fn length(path: &Path) -> io::Result<u64> {
        let metadata = fs::metadata(path)?;
        if !metadata.is_file() {
            return Err(match kind(&metadata) {
                "folder" => io::Error::new(ErrorKind::IsADirectory, "it is a folder"),
                kind => {
                    let what = format!("it is a {kind}, not a regular file");
                    io::Error::new(ErrorKind::InvalidInput, what)
                }
            });
        }
        if metadata.len() > MOST_BYTES {
            let what = format!("it has {} bytes, more than {MOST_BYTES}", metadata.len());
            return Err(io::Error::new(ErrorKind::FileTooLarge, what));
        }
        Ok(metadata.len())
    }
}

impl Files for Disk {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        let length = Self::length(path)?;
        let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
        // If a file grows while it is read, only the bytes up to the limit are read.
        fs::File::open(path)?
            .take(MOST_BYTES)
            .read_to_end(&mut bytes)?;
        Ok(bytes.into())
    }

    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }

    /// Follows links. If `from` itself is a link, both the link's folder and the folder of its target are accepted.
    fn leads_out(&self, path: &Path, from: &Path) -> bool {
        let folder = match from.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let own = folder.canonicalize().ok();
        let of_target = from.canonicalize().ok();
        let of_target = of_target.as_deref().and_then(Path::parent);
        let mut folders = own.iter().map(PathBuf::as_path).chain(of_target);
        let is_below = |path: PathBuf| folders.any(|folder| path.starts_with(folder));
        path.exists() && !path.canonicalize().is_ok_and(is_below)
    }
}

#[cfg(unix)]
fn kind(metadata: &fs::Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;

    let kind = metadata.file_type();
    if kind.is_dir() {
        "folder"
    } else if kind.is_fifo() {
        "pipe"
    } else if kind.is_socket() {
        "socket"
    } else {
        "device"
    }
}

#[cfg(not(unix))]
fn kind(metadata: &fs::Metadata) -> &'static str {
    if metadata.is_dir() {
        "folder"
    } else {
        "device"
    }
}

/// Files in memory. Names are compared after `.` and `..` are resolved. There is no current folder.
///
/// ```
/// use cutaway_io::document::Document;
/// use cutaway_io::load::{Assets, Memory};
/// use std::{path::Path, sync::Arc};
///
/// let mut files = Memory::default();
/// files.insert("scene.toml", b"[[part]]\nmesh = 'models/solid.obj'\n");
/// files.insert("models/solid.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
/// let document = Document::read_from(Path::new("scene.toml"), &files)?;
/// let scene = document.resolve(0.0, &mut Assets::from_files(Arc::new(files)))?;
/// assert_eq!(scene.parts[0].name, "solid");
/// # Ok::<(), cutaway::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Memory(BTreeMap<PathBuf, Cow<'static, [u8]>>);

impl Memory {
    /// Inserts a file, replacing any file with the same name.
    pub fn insert(&mut self, path: impl AsRef<Path>, bytes: impl Into<Cow<'static, [u8]>>) {
        self.0.insert(normal(path.as_ref()), bytes.into());
    }
}

impl<P: AsRef<Path>, B: Into<Cow<'static, [u8]>>> FromIterator<(P, B)> for Memory {
    fn from_iter<I: IntoIterator<Item = (P, B)>>(files: I) -> Self {
        let mut memory = Self::default();
        for (path, bytes) in files {
            memory.insert(path, bytes);
        }
        memory
    }
}

impl Files for Memory {
    fn read(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        let bytes = self.0.get(&normal(path)).ok_or_else(|| {
            io::Error::new(ErrorKind::NotFound, "it is not among the files in memory")
        })?;
        Ok(Cow::Borrowed(bytes))
    }

    fn is_file(&self, path: &Path) -> bool {
        self.0.contains_key(&normal(path))
    }
}

/// Prints only the names of the files, not their bytes.
impl fmt::Debug for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}

fn normal(path: &Path) -> PathBuf {
    walked(path, |place| place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_memory_are_compared_without_detours() {
        let files = Memory::from_iter(
            [("a/./b.obj", "b"), ("../c.obj", "c"), ("/d.obj", "d")]
                .map(|(name, text)| (name, text.as_bytes())),
        );
        for (name, text) in [
            ("a/b.obj", "b"),
            ("./a/x/../b.obj", "b"),
            ("a/../../c.obj", "c"),
            ("/a/../d.obj", "d"),
            ("/../d.obj", "d"),
        ] {
            let path = Path::new(name);
            assert_eq!(&*files.read(path).expect(name), text.as_bytes(), "{name}");
            assert!(files.is_file(path), "{name}");
        }
        for name in ["b.obj", "c.obj", "a", "d.obj", "../a/b.obj"] {
            let error = files.read(Path::new(name)).expect_err(name);
            assert_eq!(error.kind(), ErrorKind::NotFound, "{name}");
            assert!(!files.is_file(Path::new(name)), "{name}");
        }
    }
}
