//! Reading of files: an unreadable file is an error that names it, and unpacking is limited to the size that a machine can hold.
//!
//! A model comes from anywhere, and a few kilobytes of gzip can unpack to any size, so that is looked at while they are unpacked.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use cutaway::error::{Error, Result};
use flate2::read::MultiGzDecoder;

use super::files::{Disk, Files, MOST_BYTES};

/// Most bytes of a packed file for each of its own. Of the real meshes at hand the best packs 1 to 23, a flat grid perhaps 1 to 100;
/// what gzip can do at most, 1 to 1032, only files do that are made for it.
const MOST_RATIO: u64 = 250;

/// Unpacked size in bytes up to which the ratio is not checked: small files are harmless, and tests often use ones of one repeated value.
const RATIO_COUNTS_FROM: u64 = 64 << 20;

/// Refuses what on disk is no regular file, or too long.
pub fn check(path: &Path) -> Result<()> {
    Disk::length(path).map_err(|e| unreadable(path, &e))?;
    Ok(())
}

/// The bytes of a file.
pub fn read<'a>(path: &Path, store: &'a dyn Files) -> Result<Cow<'a, [u8]>> {
    store.read(path).map_err(|e| unreadable(path, &e))
}

/// The bytes of a file, unpacked if they are gzipped, whatever the name says.
pub(crate) fn read_unpacked<'a>(path: &Path, store: &'a dyn Files) -> Result<Cow<'a, [u8]>> {
    let bytes = read(path, store)?;
    if bytes.starts_with(&[0x1f, 0x8b]) {
        unpacked(path, &bytes).map(Cow::Owned)
    } else {
        Ok(bytes)
    }
}

/// Bytes from elsewhere, unpacked if they are gzipped; `path` is what errors call them.
pub fn unpack(path: &Path, bytes: Vec<u8>) -> Result<Vec<u8>> {
    match bytes.starts_with(&[0x1f, 0x8b]) {
        true => unpacked(path, &bytes),
        false => Ok(bytes),
    }
}

/// Returns the most bytes that `packed` packed bytes may unpack to.
pub(super) fn most_unpacked(packed: u64) -> u64 {
    packed
        .saturating_mul(MOST_RATIO)
        .clamp(RATIO_COUNTS_FROM, MOST_BYTES)
}

fn unpacked(path: &Path, packed: &[u8]) -> Result<Vec<u8>> {
    let most = most_unpacked(packed.len() as u64);
    let mut bytes = Vec::new();
    MultiGzDecoder::new(packed)
        .take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| {
            let what = format!("gzip: {e} after {} bytes", bytes.len());
            let help = "the archive is cut off or damaged: get it again";
            Error::file(path, what, help)
        })?;
    if bytes.len() as u64 > most {
        let limit = if most < MOST_BYTES {
            format!("{MOST_RATIO} bytes for each of its {}", packed.len())
        } else {
            format!("{MOST_BYTES} bytes")
        };
        let what = format!("gzip: it unpacks to more than {limit}");
        let help = "if that is meant, unpack it with gunzip and give the result";
        return Err(Error::file(path, what, help));
    }
    Ok(bytes)
}

fn unreadable(path: &Path, e: &io::Error) -> Error {
    let help = match e.kind() {
        ErrorKind::NotFound => "check the path; in a scene file it is relative to that file",
        ErrorKind::PermissionDenied => "make the file readable",
        ErrorKind::IsADirectory | ErrorKind::InvalidInput => {
            "give the name of a file; save what comes through a pipe to one first"
        }
        ErrorKind::FileTooLarge => "split it into several files",
        ErrorKind::Unsupported => "where there is no file system, give the files as bytes",
        _ => "check that it is a file that can be read",
    };
    let error = Error::file(path, format!("cannot be read: {e}"), help);
    match e.kind() {
        ErrorKind::NotFound => error.missing(),
        _ => error,
    }
}
