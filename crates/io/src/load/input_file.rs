//! Reads files. Errors name the file, and unpacking is limited to a size that fits into memory.
//!
//! A model may come from an untrusted source, and a few kilobytes of gzip may unpack to any size. So the limit is checked while unpacking.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use cutaway::error::{Error, Result};
use flate2::read::MultiGzDecoder;

use super::files::{Disk, Files, MOST_BYTES};

/// Largest accepted ratio of unpacked to packed bytes. The highest ratio among real meshes was 23, and a flat grid reaches perhaps 100.
/// Only files made for that purpose reach the gzip maximum of 1032.
const MOST_RATIO: u64 = 250;

/// Unpacked size in bytes up to which the ratio is not checked. Small files are harmless, and test files often repeat a single value.
const RATIO_COUNTS_FROM: u64 = 64 << 20;

/// Refuses a path on disk that is not a regular file, and a file that is too long.
pub fn check(path: &Path) -> Result<()> {
    Disk::length(path).map_err(|e| unreadable(path, &e))?;
    Ok(())
}

/// Returns the bytes of a file.
pub fn read<'a>(path: &Path, store: &'a dyn Files) -> Result<Cow<'a, [u8]>> {
    store.read(path).map_err(|e| unreadable(path, &e))
}

/// Returns the bytes of a file. Gzipped bytes are unpacked, whatever the file name.
pub(crate) fn read_unpacked<'a>(path: &Path, store: &'a dyn Files) -> Result<Cow<'a, [u8]>> {
    let bytes = read(path, store)?;
    if bytes.starts_with(&[0x1f, 0x8b]) {
        unpacked(path, &bytes).map(Cow::Owned)
    } else {
        Ok(bytes)
    }
}

/// Unpacks bytes from another source if they are gzipped. Errors name `path`.
pub fn unpack(path: &Path, bytes: Vec<u8>) -> Result<Vec<u8>> {
    match bytes.starts_with(&[0x1f, 0x8b]) {
        true => unpacked(path, &bytes),
        false => Ok(bytes),
    }
}

/// Returns the largest size, in bytes, to which `packed` bytes may unpack.
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
        let help = "if intended, unpack it with gunzip and give the result";
        return Err(Error::file(path, what, help));
    }
    Ok(bytes)
}

fn unreadable(path: &Path, e: &io::Error) -> Error {
    let help = match e.kind() {
        ErrorKind::NotFound => "check the path; in a scene file it is relative to that file",
        ErrorKind::PermissionDenied => "make the file readable",
        ErrorKind::IsADirectory | ErrorKind::InvalidInput => {
            "give a file name; save the output of a pipe to a file first"
        }
        ErrorKind::FileTooLarge => "split it into several files",
        ErrorKind::Unsupported => "without a file system, give the files as bytes",
        _ => "check that the path is a readable file",
    };
    let error = Error::file(path, format!("cannot be read: {e}"), help);
    match e.kind() {
        ErrorKind::NotFound => error.missing(),
        _ => error,
    }
}
