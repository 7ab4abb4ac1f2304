//! Files of the disk, written whole: into a file beside, which takes the place of the old one.

use std::io::Write;
use std::path::Path;

use cutaway::load::Disk;
use cutaway::{Error, Result};
use tempfile::Builder;

use crate::files::Store;

impl Store for Disk {
    fn write(&self, path: &Path, bytes: &[u8]) -> Result<()> {
        write_whole(path, bytes)
    }
}

/// Writes a file that is there whole or not at all.
///
/// # Errors
///
/// A folder that takes no file.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    // A link is followed: what it points to is replaced, not the link.
    let path = &std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    let fault = |e: std::io::Error| {
        Error::file(
            path,
            format!("cannot be written: {e}"),
            "check the folder's permissions and the room on the disk",
        )
    };
    let mut builder = Builder::new();
    // As any other file: the mask of the process decides.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = (builder.tempfile_in(folder.unwrap_or(Path::new(".")))).map_err(fault)?;
    file.write_all(bytes).map_err(fault)?;
    file.persist(path).map_err(|e| fault(e.error))?;
    Ok(())
}
